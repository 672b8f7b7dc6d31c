"""clients/blender, installed into Blender from its archive and used through its operators."""

import json
import os
import re
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import nacreous
from blender_process import (
    ROOT,
    blender_jobs,
    blender_python,
    linear_pixels,
    packed_add_on,
    run_blender,
    sphere_cosines,
)
from lut_contract import CONTRACT_SPEC, POINTS, LookupTexture, write_contract_table

OPERATORS = ["create_material", "fetch_preset", "list_presets"]
FILES = {"R": "contract.exr", "T": "contract.transmission.exr", "uneven": "uneven.exr"}
UNEVEN = {"cos_theta": [0.0, 0.1, 0.3, 0.7, 1.0], "thickness_scale": [0.5, 0.6, 0.9, 1.5]}
SCALE, PIXELS = 0.83, 48
WRONG = {
    "missing.exr": "No such file",
    "text.exr": "not an EXR texture",
    "cut.exr": "ends too early",
    "half.exr": "ends too early",
    "rendered.exr": "not from Nacreous",
    "albedo.exr": "holds E_r of a rough surface",
    "contract.transmission.exr": "holds what is transmitted",
}
"""Files that hold no film's R, and what their message must say."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with right files and wrong ones."""
    folder = tmp_path_factory.mktemp("blender")
    path = write_contract_table(folder)
    (folder / "opaque.exr").write_bytes(path.read_bytes())
    (folder / "cut.exr").write_bytes(path.read_bytes()[:300])
    (folder / "half.exr").write_bytes(path.read_bytes()[:-1])
    (folder / "text.exr").write_text("no picture")
    write_without_attributes(folder / "rendered.exr")
    write_table(folder / "uneven.exr", {"table": UNEVEN})
    free = {"incident": "air", "substrate": "air", "layers": CONTRACT_SPEC["stack"]["layers"]}
    write_table(folder / "bubble.exr", {"stack": free})
    rough = {"surface": {"distribution": "ggx", "alpha_x": 0.2, "alpha_y": 0.2}}
    small = {"quantity": "albedo", "cos_theta": 4, "thickness_scale": 1}
    write_table(folder / "albedo.exr", rough | {"table": small})
    return folder


@pytest.fixture(scope="module")
def server(folder: Path) -> Iterator[str]:
    """Serve two presets by the routes of the service: a folder's index is the list."""
    presets = folder / "served" / "v1" / "presets"
    (presets / "paper").mkdir(parents=True)
    for name in ("film", "film.transmission", "paper/opaque"):
        source = folder / f"{name.replace('film', 'contract').removeprefix('paper/')}.exr"
        (presets / f"{name}.exr").write_bytes(source.read_bytes())
    (presets / "broken.exr").write_text("no picture")
    names = ["film", "paper/opaque", "../outside", "broken", "gone"]
    (presets / "index.html").write_text(json.dumps([{"name": name} for name in names]))
    command = [sys.executable, "-um", "http.server", "0", "--bind", "127.0.0.1"]
    with subprocess.Popen(
        command, cwd=folder / "served", stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as process:
        assert process.stdout is not None
        found = re.search(r"port (\d+)", process.stdout.readline())
        assert found
        yield f"http://127.0.0.1:{found[1]}"
        process.terminate()


@pytest.fixture(scope="module")
def answers(folder: Path, server: str) -> dict[str, Any]:
    """Return what one run of Blender answered to every job."""
    with socket.socket() as unused:  # an address where nobody listens
        unused.bind(("127.0.0.1", 0))
        closed = f"http://127.0.0.1:{unused.getsockname()[1]}"
    jobs = render_jobs(folder) | refusal_jobs(folder) | service_jobs(server, closed, folder / "fetched")
    jobs = {"install": {"job": "install", "archive": str(packed_add_on(folder))}} | jobs
    jobs |= {"uninstall": {"job": "uninstall"}}
    os.environ["NO_PROXY"] = "127.0.0.1"
    return dict(zip(jobs, blender_jobs(list(jobs.values()), folder), strict=True))


def render_jobs(folder: Path) -> dict[str, dict[str, Any]]:
    """Return the strips of each file, an opaque sphere, and two that transmit."""
    strips = {
        f"strip {name}": {
            "job": "read_strip",
            "path": str(folder / ("uneven.exr" if name == "uneven" else "contract.exr")),
            "output": "T" if name == "T" else "R",
            "points": POINTS.tolist(),
        }
        for name in FILES
    }
    sphere = {"job": "render_sphere", "thickness_scale": SCALE, "pixels": PIXELS}
    spheres = {
        f"sphere {name}": sphere | {"path": str(folder / f"{name}.exr"), "samples": samples}
        for name, samples in {"opaque": 1, "contract": 64, "bubble": 64}.items()
    }
    return {
        name: job | {"reader": "IMAGE", "picture": str(folder / f"{name}.exr")}
        for name, job in (strips | spheres).items()
    }


def refusal_jobs(folder: Path) -> dict[str, dict[str, Any]]:
    """Return the wrong files, and an uneven table for the shader that reads none."""
    wrong = {name: {"job": "refuse", "path": str(folder / name), "reader": "IMAGE"} for name in WRONG}
    return wrong | {"osl": {"job": "refuse", "path": str(folder / "uneven.exr"), "reader": "OSL"}}


def service_jobs(server: str, closed: str, folder: Path) -> dict[str, dict[str, Any]]:
    """Return what is asked of the service, in the order of the tests below."""
    fetch = {"job": "fetch_preset", "folder": str(folder), "server": server}
    return {
        "offline": {"job": "list_presets", "server": server, "online": False},
        "closed": {"job": "list_presets", "server": closed},
        "no list": {"job": "list_presets", "server": f"{server}/v1"},
        "scheme": {"job": "list_presets", "server": f"file://{folder}"},
        "list": {"job": "list_presets", "server": server},
        "film": fetch | {"preset": "film"},
        "paper": fetch | {"preset": "paper/opaque"},
        "outside": fetch | {"preset": "../outside"},
        "broken": fetch | {"preset": "broken"},
        "gone": fetch | {"preset": "gone"},
    }


def write_table(path: Path, changes: dict[str, Any]) -> None:
    """Tabulate the contract's film with other axes or a surface."""
    table = CONTRACT_SPEC["table"] | changes.pop("table", {})
    nacreous.write(nacreous.tabulate(CONTRACT_SPEC | changes | {"table": table}), path)


def write_without_attributes(path: Path) -> None:
    """Write a picture as any other program does."""
    import OpenImageIO

    buffer = OpenImageIO.ImageBuf(OpenImageIO.ImageSpec(4, 4, 3, OpenImageIO.FLOAT))
    assert buffer.write(str(path))


def test_the_manifest_is_what_blender_accepts(folder: Path) -> None:
    """Blender's own validation of extensions finds no fault with the archive."""
    packages = blender_python().parent.parent / "lib" / "python3.11" / "site-packages"
    validator = next(packages.glob("bpy/*/scripts/addons_core/bl_pkg/cli/blender_ext.py"))
    command = [blender_python(), validator, "validate", packed_add_on(folder)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "error" not in done.stdout.lower()


def test_the_add_on_comes_and_goes(answers: dict[str, Any]) -> None:
    """Enabled, all its operators are there; disabled, none of them, nor its panel and session."""
    assert answers["install"] == {"enabled": True, "operators": OPERATORS}
    gone = {"enabled": False, "operators": [], "session": False, "panels": False}
    assert answers["uninstall"] == gone


@pytest.mark.parametrize("name", FILES)
def test_the_image_nodes_read_the_contract(name: str, folder: Path, answers: dict[str, Any]) -> None:
    """In Cycles, even axes and uneven: rms within 1e-4 of the lookup, the mean error within 1 %."""
    assert answers["install"]["enabled"]
    got = linear_pixels(folder / f"strip {name}.exr")[0]
    expected = LookupTexture.read(folder / FILES[name]).at(*POINTS.T)
    assert np.sqrt(np.mean((got - expected) ** 2)) <= 1e-4
    assert np.abs(got - expected).mean() <= 0.01 * expected.mean()


def test_a_sphere_has_the_colour_of_each_angle(folder: Path, answers: dict[str, Any]) -> None:
    """A smooth opaque sphere in a white world reflects R at the pixel's own cosine: the mean within 1 %."""
    assert answers["install"]["enabled"]
    cos_theta, inside = sphere_cosines(PIXELS)
    expected = LookupTexture.read(folder / "opaque.exr").at(cos_theta[inside], np.full(inside.sum(), SCALE))
    got = linear_pixels(folder / "sphere opaque.exr")[inside]
    assert np.abs(got - expected.clip(min=0)).mean() <= 0.01 * expected.mean()


@pytest.mark.parametrize("name", ["contract", "bubble"])
def test_what_does_not_absorb_vanishes_in_a_white_world(
    name: str, folder: Path, answers: dict[str, Any]
) -> None:
    """R + T = 1 on both sides of the film, on solid glass and on a bubble: 1 to within 1 % of noise."""
    assert answers["install"]["enabled"]
    inside = sphere_cosines(PIXELS)[1]
    np.testing.assert_allclose(
        linear_pixels(folder / f"sphere {name}.exr")[inside].mean(axis=0), 1, rtol=0, atol=0.01
    )


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_file_gives_one_message_and_nothing_else(name: str, answers: dict[str, Any]) -> None:
    """A file that is no table of R is refused in one line that names the reason; no datablock is made."""
    assert WRONG[name] in answers[name]["message"]
    assert "\n" not in answers[name]["message"]
    assert answers[name]["made"] == []


def test_the_shader_refuses_uneven_axes(answers: dict[str, Any]) -> None:
    """clients/osl knows the ends of an axis alone; the message says what to choose instead."""
    assert "choose image nodes" in answers["osl"]["message"]
    assert answers["osl"]["made"] == []


def test_presets_are_listed(answers: dict[str, Any]) -> None:
    """The names of GET /v1/presets in their order, without one that would leave the folder."""
    assert answers["list"] == {"message": "", "names": ["film", "paper/opaque", "broken", "gone"]}


@pytest.mark.parametrize(
    ("job", "reason"),
    [
        ("offline", "allow online access"),
        ("closed", "Cannot reach"),
        ("no list", "404"),
        ("scheme", "Expected an address with http"),
        ("outside", "no name of a preset"),
        ("broken", "not an EXR texture"),
        ("gone", "404"),
    ],
)
def test_what_the_service_cannot_give_is_said(job: str, reason: str, answers: dict[str, Any]) -> None:
    """Each failure is one line with its reason; nothing is made, no list filled."""
    assert reason in answers[job]["message"]
    assert "\n" not in answers[job]["message"]
    assert not answers[job].get("made") and not answers[job].get("names")  # noqa: PT018 - either is absent


def test_a_fetched_preset_is_what_the_service_has(folder: Path, server: str, answers: dict[str, Any]) -> None:
    """R, and T where there is one, byte for byte; a slash in the name makes no folder."""
    assert server
    assert answers["film"]["message"] == answers["paper"]["message"] == ""
    assert any(made.startswith("materials ") for made in answers["film"]["made"])
    served = folder / "served" / "v1" / "presets"
    fetched = {path.name: path.read_bytes() for path in (folder / "fetched").iterdir()}
    assert fetched == {
        name.replace("/", "-"): (served / name).read_bytes()
        for name in ("film.exr", "film.transmission.exr", "paper/opaque.exr")
    }


def test_the_example_renders(tmp_path: Path) -> None:
    """example.py makes a picture of the size asked for, in which the films are not grey."""
    for name in ("soap-bubble", "anodised-titanium", "beetle"):
        nacreous.write(nacreous.tabulate(nacreous.preset(name)), tmp_path / f"{name}.exr")
    script, picture = ROOT / "clients" / "blender" / "example.py", tmp_path / "films.png"
    options = ("--tables", tmp_path, "--output", picture, "--width", "80", "--samples", "4")
    run_blender(script, tmp_path, *options)
    pixels = linear_pixels(picture)
    assert pixels.shape == (36, 80, 3)
    assert np.ptp(pixels, axis=2).max() > 0.3
