"""A lookup texture of Nacreous, as its file describes it: the table contract, clients/README.md."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .exr_header import NotAPictureError, text_attributes

TEXTURE_SUFFIX = ".exr"
TRANSMISSION_SUFFIX = ".transmission.exr"
SCENE_SPACE = "Rec.709"
"""Primaries of Blender's own scene-linear space."""
GLASS_IOR = 1.5
"""Where a substrate is named, not given by its index."""


class TextureError(ValueError):
    """The file is not a texture that this add-on reads; the message is for the artist."""


@dataclass(frozen=True)
class Axis:
    """An axis of the texture: the places of its texel centres, ascending.

    Parameters
    ----------
    values : tuple of float
        Of each texel; only the ends where all are evenly spaced.
    count : int
        Number of texels.
    """

    values: tuple[float, ...]
    count: int

    @classmethod
    def parse(cls, text: str, name: str) -> "Axis":
        """Read ``nacreous:axis.x`` or ``nacreous:axis.y``; raises `TextureError`."""
        axis = json.loads(text)
        if axis["name"] != name:
            raise TextureError(f"Expected an axis {name}, found {axis['name']}")
        explicit = axis["mapping"] == "explicit"
        values = tuple(map(float, axis["values"] if explicit else axis["range"]))
        if len(values) != (axis["count"] if explicit else 2):
            raise TextureError(f"The axis {name} has {axis['count']} texels and {len(values)} values")
        return cls(values, int(axis["count"]))

    @property
    def is_even(self) -> bool:
        """Whether the ends tell the place of every texel."""
        return len(self.values) == 2


@dataclass(frozen=True)
class LookupTexture:
    """The colour of R over cos_theta, from left to right, and thickness_scale, from the top row down.

    Parameters
    ----------
    path, transmission_path : Path
        Of R, and of T if there is such a file beside it.
    label : str
        Name of the spec.
    columns, rows : Axis
        ``cos_theta`` and ``thickness_scale``.
    colour_space : str
        As the file names it.
    stack : mapping
        The spec's stack.
    """

    path: Path
    transmission_path: Path | None
    label: str
    columns: Axis
    rows: Axis
    colour_space: str
    stack: Mapping[str, Any]

    @classmethod
    def read(cls, path: Path) -> "LookupTexture":
        """Read what the header says; raises `TextureError`."""
        attributes = _attributes(path)
        _require_reflection_of_a_film(path, attributes.get("quantity", ""))
        try:
            return cls._described(path, attributes)
        except TextureError as error:
            raise TextureError(f"{path.name}: {error}") from None
        except (KeyError, ValueError, TypeError) as error:
            raise TextureError(
                f"{path.name}: its attributes are not those of a lookup texture: {error}"
            ) from None

    @classmethod
    def _described(cls, path: Path, attributes: Mapping[str, str]) -> "LookupTexture":
        spec = json.loads(attributes["spec"])
        transmission = transmission_beside(path)
        return cls(
            path=path,
            transmission_path=transmission if transmission.is_file() else None,
            label=str(spec.get("name") or path.stem),
            columns=Axis.parse(attributes["axis.x"], "cos_theta"),
            rows=Axis.parse(attributes["axis.y"], "thickness_scale"),
            colour_space=attributes["colour.space"],
            stack=spec["stack"],
        )

    @property
    def is_free_standing(self) -> bool:
        """Whether the same medium lies on both sides, as with a soap bubble: light passes straight on."""
        return self.stack["incident"] == self.stack["substrate"]

    @property
    def substrate_ior(self) -> float:
        """Index of the substrate where the spec gives it by number, else that of common glass."""
        substrate = self.stack["substrate"]
        return float(substrate["n"]) if isinstance(substrate, dict) and "n" in substrate else GLASS_IOR


def transmission_beside(path: Path) -> Path:
    """Return where Nacreous writes the colour of T."""
    return path.with_name(path.name.removesuffix(TEXTURE_SUFFIX) + TRANSMISSION_SUFFIX)


def _attributes(path: Path) -> dict[str, str]:
    """Return the attributes of Nacreous, without their prefix."""
    try:
        found = text_attributes(path)
    except OSError as error:
        raise TextureError(f"Cannot read {path}: {error.strerror}") from None
    except NotAPictureError as error:
        raise TextureError(f"{path.name} is not an EXR texture: {error}") from None
    prefix = "nacreous:"
    return {name.removeprefix(prefix): value for name, value in found.items() if name.startswith(prefix)}


def _require_reflection_of_a_film(path: Path, quantity: str) -> None:
    match quantity:
        case "R":
            return
        case "":
            raise TextureError(f"{path.name} is not from Nacreous: it has no attribute nacreous:quantity")
        case "T":
            raise TextureError(f"{path.name} holds what is transmitted: choose the file of R beside it")
    raise TextureError(
        f"{path.name} holds {quantity} of a rough surface: choose a texture of the quantity fresnel"
    )
