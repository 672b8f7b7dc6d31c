"""Stacks: their limits, and what a sampled stack holds."""

from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from nacreous.errors import SpecError
from nacreous.optics.stack import GroupSpan, Layer, Stack, sample_stack

LAYER = {"material": {"n": 2.0}, "thickness_nm": 100}
GROUP = {"repeat": 3, "layers": [LAYER, {"material": "water", "thickness_nm": 50}]}


def stack(*layers: object, incident: object = "vacuum", substrate: object = "bk7") -> Stack:
    """Make a stack as a spec writes it."""
    return Stack.model_validate({"incident": incident, "substrate": substrate, "layers": list(layers)})


def layer(**changes: Any) -> dict[str, Any]:  # noqa: ANN401 - any wrong value
    """Write a layer with something changed."""
    return {**LAYER, **changes}


def test_sampling_keeps_the_order_and_expands_nothing() -> None:
    """Media run from the incident one inwards; a group's members stand there once."""
    sampled = sample_stack(stack(LAYER, GROUP, layer(thickness_nm=7, coherent=False)), [400.0, 500.0, 600.0])
    assert sampled.index.shape == (6, 3)
    np.testing.assert_allclose(sampled.index[:, 1].real, [1, 2, 2, 1.3368, 2, 1.5214], atol=1e-4)
    np.testing.assert_array_equal(sampled.thickness_nm, [100, 100, 50, 7])
    np.testing.assert_array_equal(sampled.coherent, [True, True, True, False])
    np.testing.assert_array_equal(sampled.thickness_sigma_nm, np.zeros(4))
    assert sampled.groups == (GroupSpan(first=1, stop=3, repeat=3),)
    assert sampled.index.dtype == np.complex128


def test_groups_follow_one_another() -> None:
    """Spans are positions among all layers, whatever stands between the groups."""
    assert [(g.first, g.stop) for g in sample_stack(stack(GROUP, LAYER, GROUP), [500.0]).groups] == [
        (0, 2),
        (3, 5),
    ]


@pytest.mark.parametrize("thickness_nm", [0, 1e-6, 1e8])
def test_the_limits_of_a_thickness_belong_to_it(thickness_nm: float) -> None:
    """0 is a layer that is absent."""
    assert Layer.model_validate(layer(thickness_nm=thickness_nm)).thickness_nm == thickness_nm


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (layer(thickness_nm=-1), "0, or a thickness"),
        (layer(thickness_nm=1e-40), "0, or a thickness"),
        (layer(thickness_nm=1e9), "0, or a thickness"),
        (layer(thickness_nm=float("nan")), "finite"),
        (layer(thickness_sigma_nm=-1), "greater than or equal"),
        (layer(thickness_sigma_nm=20.1), "fifth of thickness_nm, 20"),
        (layer(thickness_nm=0, thickness_sigma_nm=1), "fifth"),
        (layer(thickness_sigma_nm=1, coherent=False), "incoherent"),
        (layer(coherent=1), "boolean"),
        ({"material": "air"}, "required"),
        (7, "a layer"),
        ({**GROUP, "repeat": 0}, "greater than or equal"),
        ({**GROUP, "repeat": 1_000_001}, "less than or equal"),
        ({**GROUP, "repeat": 2.0}, "integer"),
        ({"repeat": 2, "layers": []}, "at least 1"),
        ({"repeat": 2, "layers": [GROUP]}, "group within a group"),
        ({"repeat": 2, "layers": [layer(coherent=False)]}, "coherent layers within a group"),
    ],
    ids=str,
)
def test_what_is_no_layer_is_refused(wrong: object, message: str) -> None:
    """Each limit in its own words."""
    with pytest.raises(ValidationError) as caught:
        stack(wrong)
    assert message in str([(error["msg"], error.get("ctx")) for error in caught.value.errors()])


@pytest.mark.parametrize(
    ("layers", "got"),
    [([], "none"), ([LAYER] * 65, "65 layers"), ([GROUP] * 33, "66 layers")],
)
def test_one_to_sixty_four_layers(layers: list[object], got: str) -> None:
    """A group's members count once, however often the group is repeated."""
    with pytest.raises(ValidationError, match=f"1 to 64 layers, got {got}"):
        stack(*layers)
    assert len(stack(*[LAYER] * 64).layers) == 64
    assert len(stack(*[GROUP] * 32).layers) == 32


@pytest.mark.parametrize(
    ("given", "field"),
    [
        ({"incident": "watre"}, "stack.incident"),
        ({"substrate": "main/Ag/Jonson"}, "stack.substrate"),
        (
            {"substrate": {"host": "air", "inclusion": "?", "fraction": 0.5, "rule": "bruggeman"}},
            "stack.substrate.inclusion",
        ),
    ],
)
def test_an_error_has_the_whole_path(given: dict[str, object], field: str) -> None:
    """The field is the one that the author of the spec wrote."""
    with pytest.raises(SpecError) as caught:
        sample_stack(stack(LAYER, **given), [500.0])
    assert caught.value.field == field


def test_an_error_within_a_group_has_the_whole_path() -> None:
    """Positions are those of the document, not of the sampled stack."""
    wrong = {"repeat": 2, "layers": [LAYER, layer(material="watre")]}
    with pytest.raises(SpecError, match=r"stack\.layers\.1\.layers\.1\.material: .*water"):
        sample_stack(stack(LAYER, wrong), [500.0])


@pytest.mark.parametrize("absorbing", [{"n": 1.5, "k": 1e-9}, "main/Ag/Johnson"])
def test_an_absorbing_incident_medium_is_refused(absorbing: object) -> None:
    """R and T of a wave that decays before it arrives have no common meaning (Born and Wolf, section 1.5)."""
    with pytest.raises(SpecError, match="does not absorb") as caught:
        sample_stack(stack(LAYER, incident=absorbing), [500.0, 600.0])
    assert caught.value.field == "stack.incident"
