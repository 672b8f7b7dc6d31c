"""Estimates of cost: more work never costs less, and what is known to be slow is told from what is not."""

import math
from itertools import pairwise

import pytest

from nacreous.engine.cost import estimated_seconds
from nacreous.engine.work import Work
from nacreous.errors import SpecError
from nacreous.formats.names import FormatName
from nacreous.tables.presets import preset, preset_names
from small_library import small_spec

BSDF = (
    "table.quantity=bsdf",
    'surface={distribution = "ggx", alpha_x = 0.2}',
    "table.roughness=[0.2]",
    "table.thickness_scale=1",
)
ALBEDO = ("table.quantity=albedo", "table.roughness=[0.1, 0.3]")
OPAQUE = "table.transmission=discard"


def seconds(name: str, *overrides: str, format: FormatName = FormatName.EXR) -> float:  # noqa: A002 - as Work has it
    """Return the estimate of a preset in a format."""
    return estimated_seconds(Work(preset(name, overrides), format))


@pytest.mark.parametrize("name", preset_names())
@pytest.mark.parametrize("quantity", [(), ALBEDO, BSDF, (*BSDF, OPAQUE)])
def test_every_work_has_an_estimate(name: str, quantity: tuple[str, ...]) -> None:
    """Of all presets and quantities in every format that can hold them: a positive number."""
    held = 0
    for chosen in FormatName:
        try:
            work = Work(preset(name, quantity), chosen)
        except SpecError:
            continue
        held += 1
        assert 0 < estimated_seconds(work) < math.inf
    assert held >= 4


MORE = {
    "angles": [f"table.cos_theta={count}" for count in (32, 64, 128, 512, 4096)],
    "scales": [
        f"table.thickness_scale={{start = 0.5, stop = 2, count = {count}}}" for count in (2, 32, 64, 1024)
    ],
    "wavelengths": [
        f"table.wavelength_nm={{start = 390, stop = 740, step = {step}}}" for step in (50, 10, 1)
    ],
    "thickness": [f"stack.layers.0.thickness_nm={nm}" for nm in (100, 1_000, 30_000)],
    "spread": [f"stack.layers.0.thickness_sigma_nm={nm}" for nm in (0, 5, 30, 200)],
    "precision": [f"accuracy.precision={name}" for name in ("single", "double")],
    "difference": ["table.cos_theta=256", *(f"accuracy.delta_e={delta}" for delta in (5, 1, 0.2))],
}


@pytest.mark.parametrize("growing", MORE)
@pytest.mark.parametrize("format", [FormatName.EXR, FormatName.NPZ, FormatName.CSV, FormatName.GLTF])
def test_more_of_anything_never_costs_less(growing: str, format: FormatName) -> None:  # noqa: A002 - as Work has it
    """Along each axis, with thickness, its spread, precision and the difference allowed."""
    base = "stack.layers.0.thickness_nm=2000"
    costs = [seconds("coated-lens", base, more, format=format) for more in MORE[growing]]
    assert all(less <= more for less, more in pairwise(costs))


@pytest.mark.parametrize("format", [FormatName.EXR, FormatName.NPZ])
def test_rough_surfaces_cost_more_with_their_axes(format: FormatName) -> None:  # noqa: A002 - as Work has it
    """Roughnesses of an albedo, directions of a bsdf, and an azimuth of the light."""
    rough = [f"table.roughness={{start = 0.05, stop = 1, count = {count}}}" for count in (2, 16, 64)]
    costs = [seconds("coated-lens", ALBEDO[0], more, format=format) for more in rough]
    assert costs == sorted(costs)
    directions = [f"table.phi={count}" for count in (2, 19, 181)]
    costs = [seconds("coated-lens", *BSDF, more, format=format) for more in directions]
    assert costs == sorted(costs)
    anisotropic = seconds("coated-lens", *BSDF, "surface.alpha_y=0.4", format=format)
    assert anisotropic > seconds("coated-lens", *BSDF, format=format)


def test_the_slow_is_told_from_the_quick() -> None:
    """Orders that were measured: a texture of milliseconds against works of many seconds."""
    quick = estimated_seconds(Work(small_spec(), FormatName.EXR))
    slow = {
        "a wide spread": seconds("soap-bubble", "stack.layers.0.thickness_sigma_nm=200"),
        "a small difference": seconds("soap-bubble", "accuracy.delta_e=0.2"),
        "volumes of refracted light": seconds("oil-on-water", *BSDF, format=FormatName.MBSDF),
        "five million lines": seconds(
            "coated-lens",
            "table.cos_theta=1024",
            "table.thickness_scale={start = 0.5, stop = 2, count = 64}",
            format=FormatName.CSV,
        ),
    }
    assert quick < 0.2
    assert {name: cost for name, cost in slow.items() if cost < 3} == {}


def test_a_wrong_material_is_an_error_of_the_spec() -> None:
    """The estimate samples the stack, and says what is wrong with it as the computation would."""
    with pytest.raises(SpecError, match=r"stack\.substrate"):
        seconds("silica-on-silicon", "table.wavelength_nm=[300, 5000]", format=FormatName.NPZ)
