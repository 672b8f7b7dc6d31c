"""A stack of thin films between two half-spaces, and its refractive indices sampled over wavelength."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import BeforeValidator, Discriminator, Field, Tag, field_validator, model_validator

from nacreous.errors import SpecError
from nacreous.optics.material import Material
from nacreous.optics.refractive_index import refractive_index
from nacreous.optics.value import REFUSED, AsTuple, Number, StrictModel, form_tag, refusal

__all__ = ["MAX_LAYERS", "Group", "GroupSpan", "Layer", "SampledStack", "Stack", "all_layers", "sample_stack"]

MAX_LAYERS = 64
"""Layers of a stack, the members of a group counted once."""
MAX_REPEAT = 1_000_000
THICKNESS_NM = (1e-6, 1e8)
"""The least and the largest thickness of a layer that is there at all."""


class Layer(StrictModel):
    """One film.

    Parameters
    ----------
    material : Material
        What it consists of.
    thickness_nm : float
        Its thickness: 1e-6 to 1e8, or 0 for a layer that is absent.
    thickness_sigma_nm : float
        Standard deviation of the thickness over the surface, at most a fifth of it; R and T are averaged.
    coherent : bool
        False for a thick layer across which intensities are added instead of amplitudes.
    """

    material: Material
    thickness_nm: Number
    thickness_sigma_nm: Annotated[Number, Field(ge=0)] = 0.0
    coherent: bool = True

    @field_validator("thickness_nm")
    @classmethod
    def _check_thickness(cls, value: float) -> float:
        least, largest = THICKNESS_NM
        if value != 0 and not least <= value <= largest:
            raise refusal(f"0, or a thickness from {least:g} to {largest:g} nm", f"{value:g}")
        return value

    @model_validator(mode="after")
    def _check_spread(self) -> Self:
        # Five deviations below the mean the layer must still have a thickness.
        if self.thickness_sigma_nm > self.thickness_nm / 5:
            expected = f"at most a fifth of thickness_nm, {self.thickness_nm / 5:g}"
            raise refusal(expected, f"{self.thickness_sigma_nm:g}", field="thickness_sigma_nm")
        if self.thickness_sigma_nm and not self.coherent:
            remedy = "an incoherent layer has no fringes to average: leave thickness_sigma_nm out"
            raise refusal(
                "0 for an incoherent layer",
                f"{self.thickness_sigma_nm:g}",
                remedy,
                field="thickness_sigma_nm",
            )
        return self


def _member(value: object) -> object:
    """Refuse what a group may not hold before its fields are looked at one by one."""
    if isinstance(value, Group) or (
        isinstance(value, dict) and not value.keys().isdisjoint({"repeat", "layers"})
    ):
        raise refusal("a layer", "a group within a group", "write the inner group's layers out")
    return value


class Group(StrictModel):
    """A periodic group: its layers, in order, `repeat` times.

    Parameters
    ----------
    repeat : int
        How often the layers stand there; a thousand times cost about twice as much as once.
    layers : tuple of Layer
        One period, from the incident medium inwards; all of them coherent, and none a group itself.
    """

    repeat: Annotated[int, Field(ge=1, le=MAX_REPEAT)]
    layers: Annotated[
        tuple[Annotated[Layer, BeforeValidator(_member)], ...],
        Field(min_length=1, max_length=MAX_LAYERS),
        AsTuple,
    ]

    @model_validator(mode="after")
    def _check_coherence(self) -> Self:
        for position, layer in enumerate(self.layers):
            if not layer.coherent:
                remedy = "put the incoherent layer outside the group"
                raise refusal(
                    "coherent layers within a group", "false", remedy, field=f"layers.{position}.coherent"
                )
        return self


def _form(value: object) -> str | None:
    if isinstance(value, Layer | Group):
        return form_tag(type(value).__name__)
    if not isinstance(value, dict):
        return None
    return form_tag("Layer" if value.keys().isdisjoint({"repeat", "layers"}) else "Group")


LayerOrGroup = Annotated[
    Annotated[Layer, Tag(form_tag("Layer"))] | Annotated[Group, Tag(form_tag("Group"))],
    Discriminator(
        _form,
        custom_error_type=REFUSED,
        custom_error_message="expected {expected}",
        custom_error_context={"expected": "a layer (material, thickness_nm) or a group (repeat, layers)"},
    ),
]


def _not_too_many(layers: object) -> object:
    """Refuse more entries than there may be layers before any is looked at."""
    if isinstance(layers, list | tuple) and len(layers) > MAX_LAYERS:
        remedy = "write a periodic part as a group with repeat"
        raise refusal(f"1 to {MAX_LAYERS} layers", f"{len(layers)} layers", remedy)
    return layers


class Stack(StrictModel):
    """Layers between an incident medium, which must not absorb, and a substrate.

    Parameters
    ----------
    incident : Material
        The half-space that the light comes from; all angles are in it.
    substrate : Material
        The half-space below the layers.
    layers : tuple of Layer or Group
        From the incident medium inwards; 1 to 64 layers, a group's members counted once.
    """

    incident: Material
    substrate: Material
    layers: Annotated[tuple[LayerOrGroup, ...], AsTuple, BeforeValidator(_not_too_many)]

    @field_validator("layers")
    @classmethod
    def _check_count(cls, layers: tuple[Layer | Group, ...]) -> tuple[Layer | Group, ...]:
        count = sum(len(_members(entry)) for entry in layers)
        if count == 0:
            remedy = "for a bare interface give one layer with thickness_nm = 0"
            raise refusal(f"1 to {MAX_LAYERS} layers", "none", remedy)
        if count > MAX_LAYERS:
            remedy = "write a periodic part as a group with repeat"
            raise refusal(f"1 to {MAX_LAYERS} layers", f"{count} layers", remedy)
        return layers


def all_layers(stack: Stack) -> tuple[Layer, ...]:
    """Return the layers from the incident medium inwards, a group's members once."""
    return tuple(layer for entry in stack.layers for layer in _members(entry))


def _members(entry: Layer | Group) -> tuple[Layer, ...]:
    return entry.layers if isinstance(entry, Group) else (entry,)


@dataclass(frozen=True)
class GroupSpan:
    """The layers `first` to `stop` - 1 of a sampled stack stand there `repeat` times."""

    first: int
    stop: int
    repeat: int


@dataclass(frozen=True, eq=False)
class SampledStack:
    """A stack as numbers: M layers at L wavelengths, groups not expanded.

    Parameters
    ----------
    wavelength_nm : float array, shape (L,)
    index : complex array, shape (M + 2, L)
        n + ik of the incident medium, of each layer and of the substrate.
    thickness_nm, thickness_sigma_nm : float array, shape (M,)
    coherent : bool array, shape (M,)
    groups : tuple of GroupSpan
        Over the layer positions 0 to M - 1, in order.
    """

    wavelength_nm: NDArray[np.float64]
    index: NDArray[np.complex128]
    thickness_nm: NDArray[np.float64]
    thickness_sigma_nm: NDArray[np.float64]
    coherent: NDArray[np.bool_]
    groups: tuple[GroupSpan, ...]


def sample_stack(stack: Stack, wavelength_nm: ArrayLike) -> SampledStack:
    """Evaluate every material of `stack` at the wavelengths.

    Raises
    ------
    SpecError
        A material is unknown, does not reach a wavelength, or absorbs in front of the stack; the field is
        the full path, such as ``stack.layers.0.material``.
    """
    wavelengths = np.array(wavelength_nm, np.float64, ndmin=1)
    layers = list(_paths(stack))
    sampled = [
        _incident(stack, wavelengths),
        *(_index(f"{path}.material", layer.material, wavelengths) for path, layer in layers),
        _index("stack.substrate", stack.substrate, wavelengths),
    ]
    return SampledStack(
        wavelength_nm=wavelengths,
        index=np.stack(sampled),  # (M + 2, L)
        thickness_nm=np.array([layer.thickness_nm for _, layer in layers]),
        thickness_sigma_nm=np.array([layer.thickness_sigma_nm for _, layer in layers]),
        coherent=np.array([layer.coherent for _, layer in layers]),
        groups=_groups(stack),
    )


def _paths(stack: Stack) -> Iterator[tuple[str, Layer]]:
    for position, entry in enumerate(stack.layers):
        path = f"stack.layers.{position}"
        if isinstance(entry, Layer):
            yield path, entry
        else:
            yield from ((f"{path}.layers.{inner}", layer) for inner, layer in enumerate(entry.layers))


def _groups(stack: Stack) -> tuple[GroupSpan, ...]:
    spans, first = [], 0
    for entry in stack.layers:
        stop = first + len(_members(entry))
        if isinstance(entry, Group):
            spans.append(GroupSpan(first, stop, entry.repeat))
        first = stop
    return tuple(spans)


def _index(path: str, material: Material, wavelength_nm: NDArray[np.float64]) -> NDArray[np.complex128]:
    try:
        return refractive_index(material, wavelength_nm)
    except SpecError as error:
        raise error.under(path) from None


def _incident(stack: Stack, wavelength_nm: NDArray[np.float64]) -> NDArray[np.complex128]:
    index = _index("stack.incident", stack.incident, wavelength_nm)
    if index.imag.any():
        worst = int(np.argmax(index.imag))
        got = f"k = {index.imag[worst]:.3g} at {wavelength_nm[worst]:g} nm"
        remedy = "angles are those of the incident medium, which must be transparent"
        raise SpecError("stack.incident", "a material that does not absorb (k = 0)", got, remedy)
    return index
