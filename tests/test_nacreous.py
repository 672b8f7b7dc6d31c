"""The package's public names, as a program that imports it sees them."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray

import nacreous


def test_import_needs_nothing() -> None:
    """Neither a device nor a heavy library: other programs import nacreous to ask for its version."""
    script = "import sys, nacreous; print(*{name.split('.')[0] for name in sys.modules})"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert {"numpy", "pydantic", "pyopencl", "xarray", "OpenEXR"}.isdisjoint(done.stdout.split())


def test_every_public_name_is_there() -> None:
    """What `dir` lists can be had, and nothing else."""
    assert dir(nacreous) == sorted(nacreous.__all__)
    assert all(getattr(nacreous, name) is not None for name in nacreous.__all__)
    with pytest.raises(AttributeError, match="no attribute 'tabulat'"):
        nacreous.tabulat  # type: ignore[attr-defined]  # noqa: B018


def test_a_table_is_made_written_and_verified(tmp_path: Path) -> None:
    """The four lines that the documentation begins with; R + T = 1 without absorption."""
    fractions: list[float] = []
    table = nacreous.tabulate(nacreous.preset("paper/figure-3"), observer=fractions.append)
    assert isinstance(table, xarray.Dataset)
    assert table["R_s"].dims == ("thickness_scale", "cos_theta", "wavelength_nm")
    np.testing.assert_allclose(table["R_s"] + table["T_s"], 1, atol=2e-5)
    assert all(0 <= fraction <= 1 for fraction in fractions)
    assert fractions
    (path, _) = nacreous.write(table, tmp_path / "film.exr")
    assert nacreous.verify(path).good


def test_an_observer_can_cancel() -> None:
    """What it raises ends the computation."""

    class Cancelled(Exception):  # noqa: N818 - not an error
        pass

    def cancel(fraction: float) -> None:
        raise Cancelled(fraction)

    with pytest.raises(Cancelled):
        nacreous.tabulate(nacreous.preset("paper/figure-3"), observer=cancel)


def test_a_mapping_stands_for_a_spec() -> None:
    """What is in a TOML document can be passed as it is; anything else is told what is expected."""
    film = {"material": {"n": 2.0}, "thickness_nm": 420}
    stack = {"incident": "air", "substrate": {"n": 1.5}, "layers": [film]}
    fields = {"stack": stack, "table": {"cos_theta": 4}}
    table = nacreous.tabulate(fields)
    xarray.testing.assert_identical(table, nacreous.tabulate(nacreous.Spec.model_validate(fields)))
    with pytest.raises(nacreous.errors.SpecError, match=r"stack: expected a value, got nothing"):
        nacreous.tabulate({})
    with pytest.raises(nacreous.errors.SpecError, match=r"expected a nacreous\.Spec or a mapping .*got str"):
        nacreous.tabulate("soap-bubble")  # type: ignore[arg-type]
