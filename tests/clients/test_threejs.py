"""The three.js package, built by npm and run in Chromium, against the lookup of clients/README.md."""

import json
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import nacreous
from lut_contract import CONTRACT_SPEC, POINTS, LookupTexture, write_contract_table
from web_page import WebPage, chromium, open_page

if TYPE_CHECKING:
    from playwright.sync_api import Browser

SOURCE = Path(__file__).parents[2] / "clients" / "threejs"
SIZE = 64
"""Width of a picture of a sphere, in pixels."""


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Copy the package, install what its lock file names, build it and look at its types."""
    npm = shutil.which("npm")
    if npm is None:
        pytest.skip("npm is missing: install the package npm, or Node.js 20")
    folder = tmp_path_factory.mktemp("threejs") / "package"
    shutil.copytree(SOURCE, folder, ignore=shutil.ignore_patterns("node_modules", "dist", "public"))
    _npm(npm, folder, "ci", "--no-audit", "--no-fund")
    _npm(npm, folder, "run", "build")
    _npm(npm, folder, "run", "typecheck")
    return folder


def _npm(npm: str, folder: Path, *command: str) -> None:
    done = subprocess.run([npm, *command], cwd=folder, capture_output=True, text=True, check=False)
    if "ENOTFOUND" in done.stderr or "ECONNREFUSED" in done.stderr:
        pytest.skip("npm reaches no registry, so three and vite are missing")
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.fixture(scope="module")
def tables(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write the contract table, one with unequal steps, and files that are no lookup textures of a film."""
    folder = tmp_path_factory.mktemp("tables")
    write_contract_table(folder)
    nacreous.write(nacreous.tabulate(UNEQUAL), folder / "unequal.exr")
    nacreous.write(nacreous.tabulate(ALBEDO), folder / "albedo.exr")
    nacreous.write(nacreous.tabulate(THINNER), folder / "thinner.exr")
    wide = CONTRACT_SPEC | {"colour": {"space": "ACEScg"}}
    nacreous.write(nacreous.tabulate(wide), folder / "acescg.exr")
    _write_foreign_exr(folder / "foreign.exr")
    (folder / "text.exr").write_text("not a picture, though of this name")
    whole = (folder / "contract.exr").read_bytes()
    (folder / "half-a-header.exr").write_bytes(whole[:1000])
    (folder / "half-the-pixels.exr").write_bytes(whole[:-200])
    return folder


UNEQUAL = CONTRACT_SPEC | {
    "table": CONTRACT_SPEC["table"]
    | {"cos_theta": [0.0, 0.05, 0.15, 0.2, 0.4, 0.45, 1.0], "thickness_scale": [0.5, 0.6, 0.9, 1.5]}
}
THINNER = CONTRACT_SPEC | {
    "stack": CONTRACT_SPEC["stack"] | {"layers": [{"material": {"n": 2.0}, "thickness_nm": 150}]}
}
ALBEDO = CONTRACT_SPEC | {
    "surface": {"distribution": "ggx", "alpha_x": 0.3, "alpha_y": 0.3},
    "table": {"quantity": "albedo", "wavelength_nm": {"start": 400, "stop": 700, "step": 50}, "cos_theta": 4},
}


def _write_foreign_exr(path: Path) -> None:
    import OpenImageIO

    picture = OpenImageIO.ImageBuf(OpenImageIO.ImageSpec(4, 4, 3, OpenImageIO.FLOAT))
    assert picture.write(str(path))


@pytest.fixture(scope="module")
def browser() -> Iterator["Browser"]:
    """Start one browser for all pages."""
    with chromium() as started:
        yield started


@pytest.fixture(scope="module")
def page(
    browser: "Browser", package: Path, tables: Path, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[WebPage]:
    """Open the page that the tests call, beside the built package and the tables."""
    site = tmp_path_factory.mktemp("site")
    (site / "package").symlink_to(package)
    (site / "tables").symlink_to(tables)
    (site / "page").symlink_to(Path(__file__).parent / "three_page")
    with open_page(browser, site, "page/index.html") as opened:
        yield opened


TABLE = "/tables/contract.exr"
TRANSMISSION = "/tables/contract.transmission.exr"


@pytest.mark.parametrize(
    ("file", "function"),
    [("contract.exr", "nacreousReflectance"), ("contract.transmission.exr", "nacreousTransmittance")],
)
def test_the_shader_reads_the_contract_table(page: WebPage, tables: Path, file: str, function: str) -> None:
    """R and T at every point are those of clients/README.md's lookup."""
    argument = {"paths": [TABLE, TRANSMISSION], "points": POINTS.tolist(), "functionName": function}
    got = np.array(page.call("readTable", argument))
    np.testing.assert_allclose(got, LookupTexture.read(tables / file).at(*POINTS.T), rtol=0, atol=1e-4)


def test_the_shader_reads_axes_of_unequal_steps(page: WebPage, tables: Path) -> None:
    """An axis whose samples are listed is interpolated between its neighbours: clients/README.md."""
    argument = {
        "paths": ["/tables/unequal.exr"],
        "points": POINTS.tolist(),
        "functionName": "nacreousReflectance",
    }
    texture = LookupTexture.read(tables / "unequal.exr")
    assert texture.axis_x["mapping"] == texture.axis_y["mapping"] == "explicit"
    got = np.array(page.call("readTable", argument))
    np.testing.assert_allclose(got, texture.at(*POINTS.T), rtol=0, atol=1e-4)


def test_a_table_says_what_it_is(page: WebPage, tables: Path) -> None:
    """The attributes of the file are those that OpenImageIO reads."""
    import OpenImageIO

    spec = OpenImageIO.ImageInput.open(str(tables / "contract.exr")).spec()
    said = page.call("describe", TABLE)
    assert (said["width"], said["height"]) == (spec.width, spec.height)
    assert said["quantity"] == "R"
    for name in ("id", "version"):
        assert said[name] == spec.getattribute(f"nacreous:{name}")
    for name, value in (("spec", said["spec"]), ("axis.x", said["axes"]["x"]), ("axis.y", said["axes"]["y"])):
        assert value == json.loads(spec.getattribute(f"nacreous:{name}"))


@pytest.mark.parametrize(
    ("file", "message"),
    [
        ("missing.exr", "the server answered 404"),
        ("text.exr", "expected an OpenEXR file"),
        ("half-a-header.exr", "the OpenEXR file is damaged: its header is cut off"),
        ("half-the-pixels.exr", "the OpenEXR file is damaged"),
        ("foreign.exr", "expected a lookup texture of Nacreous"),
        ("albedo.exr", "expected R or T of a smooth film, found E_r, an albedo"),
        ("acescg.exr", "expected colours in Rec.709"),
    ],
)
def test_other_files_are_refused(page: WebPage, file: str, message: str) -> None:
    """What is no lookup texture of a film is refused by a message that begins with its address."""
    said = page.call("refusal", f"/tables/{file}")
    assert said is not None
    assert said.startswith(f"/tables/{file}: {message}")


def test_exchanged_tables_are_refused(page: WebPage) -> None:
    """T in the place of R would be a film that shines where it should be clear."""
    assert page.call("exchanged", [TABLE, TRANSMISSION]) == "expected a table of R, found one of T"


def _sphere(page: WebPage, **argument: object) -> tuple[np.ndarray, np.ndarray]:
    """Colours (P, 3) of a sphere's pixels and their cosines n.v (P,), without the rim of a pixel or two."""
    return _ball(page.call("renderSphere", argument | {"size": SIZE}))


def _ball(pixels: list[list[float]]) -> tuple[np.ndarray, np.ndarray]:
    colours = np.array(pixels)
    centre = (np.arange(SIZE) + 0.5) / SIZE * 2 - 1
    radius2 = np.add.outer(centre**2, centre**2).ravel()
    inside = radius2 < 0.95
    return colours[inside], np.sqrt(1 - radius2[inside])


def _mean_relative_error(got: np.ndarray, expected: np.ndarray) -> float:
    return float(np.abs(got - expected).mean() / expected.mean())


@pytest.mark.parametrize(("green", "scale"), [(None, 0.8), (0.25, 0.6)])
def test_a_mirror_in_white_surroundings_is_the_film(
    page: WebPage, tables: Path, green: float | None, scale: float
) -> None:
    """A smooth sphere shows R(n.v), at one thickness or at that of a map from 0.5 to 0.9."""
    thickness = {"thicknessScale": scale} if green is None else {"thicknessScaleRange": [0.5, 0.9]}
    if green is not None:
        thickness["thicknessGreen"] = green
    colours, cos_theta = _sphere(page, paths=[TABLE], light="white", **thickness)
    expected = LookupTexture.read(tables / "contract.exr").at(cos_theta, np.full_like(cos_theta, scale))
    assert _mean_relative_error(colours, expected) < 0.01


def test_a_clone_looks_alike(page: WebPage) -> None:
    """A clone takes the film, the map and its range along."""
    look = {"paths": [TABLE], "light": "white", "thicknessGreen": 0.25, "thicknessScaleRange": [0.5, 0.9]}
    clone, _ = _sphere(page, **look, isClone=True)
    np.testing.assert_array_equal(clone, _sphere(page, **look)[0])


def test_another_table_takes_the_place_of_the_first_and_compiles_nothing(page: WebPage, tables: Path) -> None:
    """After `setFilm` the sphere shows R(n.v) of the second table, by the program of the first."""
    shown = page.call(
        "renderAnotherFilm", {"size": SIZE, "paths": [TABLE], "otherPaths": ["/tables/thinner.exr"]}
    )
    colours, cos_theta = _ball(shown["pixels"])
    expected = LookupTexture.read(tables / "thinner.exr").at(cos_theta, np.ones_like(cos_theta))
    assert _mean_relative_error(colours, expected) < 0.01
    assert shown["after"] == shown["before"]


def test_a_table_of_transmission_comes_with_another_film(page: WebPage) -> None:
    """A material that is to be seen through as well has another program."""
    shown = page.call(
        "renderAnotherFilm", {"size": SIZE, "paths": [TABLE], "otherPaths": [TABLE, TRANSMISSION]}
    )
    assert shown["after"]["version"] > shown["before"]["version"]


def test_light_from_behind_is_the_colour_of_transmission(page: WebPage, tables: Path) -> None:
    """White light behind a smooth sphere that nothing else lights is seen as T(n.v)."""
    colours, cos_theta = _sphere(page, paths=[TABLE, TRANSMISSION], light="behind")
    expected = LookupTexture.read(tables / "contract.transmission.exr").at(cos_theta, np.ones_like(cos_theta))
    assert _mean_relative_error(colours, expected) < 0.01


def test_what_lies_under_the_film_gets_what_it_lets_in(page: WebPage) -> None:
    """Over a white diffuse ground the film's R and the ground's 1 - R are white together."""
    colours, _ = _sphere(page, paths=[TABLE], light="white", metalness=0, color=0xFFFFFF)
    assert np.abs(colours - 1).mean() < 0.01


def test_a_lamp_sees_the_film_at_the_half_vector(page: WebPage, tables: Path) -> None:
    """At 90 degrees from the view the highlight is that of three's white mirror times R(cos 45 degrees)."""
    film, _ = _sphere(page, paths=[TABLE], light="lamp", roughness=0.2)
    mirror, _ = _sphere(page, paths=[TABLE], light="lamp", roughness=0.2, mirror=True)
    expected = LookupTexture.read(tables / "contract.exr").at(np.full(1, np.sqrt(0.5)), np.ones(1)) * mirror
    assert mirror.max() > 1
    assert _mean_relative_error(film, expected) < 0.01


TITANIUM = {
    "wavelength_nm": [380, 450, 500, 550, 600, 650, 700, 780],
    "n": [1.5, 1.7, 1.84, 1.92, 2.05, 2.2, 2.3, 2.6],
    "k": [2.1, 2.3, 2.4, 2.5, 2.7, 2.8, 2.95, 3.1],
}
"""Near that of P. B. Johnson and R. W. Christy, Phys. Rev. B 9, 5056 (1974); any metal would do."""

LIVE_FILMS: dict[str, dict[str, Any]] = {
    "on glass": {
        "layers": [{"material": {"n": 2.0}, "thickness_nm": 420}],
        "substrate": {"n": 1.5},
    },
    "on metal": {
        "layers": [{"material": {"n": 2.4}, "thickness_nm": 60}],
        "substrate": TITANIUM,
    },
    "metal between": {
        "layers": [
            {"material": {"n": 1.46}, "thickness_nm": 150},
            {"material": {"n": 0.2, "k": 3.4}, "thickness_nm": 20},
            {"material": {"n": 1.46}, "thickness_nm": 300},
        ],
        "substrate": TITANIUM,
    },
    "beyond the critical angle": {
        "incident": {"n": 1.5},
        "layers": [{"material": {"n": 1.2}, "thickness_nm": 300}],
        "substrate": {"n": 1.5},
    },
}


def _live(stack: dict[str, Any]) -> dict[str, Any]:
    """Return the film as `LiveFilm` takes it."""

    def index(material: dict[str, Any]) -> dict[str, Any]:
        return {("wavelengthNm" if key == "wavelength_nm" else key): value for key, value in material.items()}

    layers = [
        {"index": index(layer["material"]), "thicknessNm": layer["thickness_nm"]} for layer in stack["layers"]
    ]
    incident = stack.get("incident", {"n": 1.0})["n"]
    return {"incident": incident, "layers": layers, "substrate": index(stack["substrate"])}


@pytest.mark.parametrize("name", LIVE_FILMS)
def test_a_live_film_is_its_table(page: WebPage, name: str) -> None:
    """The film computed in the shader agrees with the texels of its table to 1e-3, 1e-4 in the mean."""
    stack = {"incident": {"n": 1.0}} | LIVE_FILMS[name]
    axes = {"cos_theta": 17, "thickness_scale": {"start": 0.5, "stop": 1.5, "count": 9}}
    wavelengths = {"wavelength_nm": {"start": 380, "stop": 780, "step": 5}}
    table = nacreous.tabulate({"stack": stack, "table": axes | wavelengths})
    scale, cosine = np.meshgrid(table.thickness_scale, table.cos_theta, indexing="ij")
    points = np.stack([cosine.ravel(), scale.ravel()], axis=1).tolist()
    got = np.array(page.call("readFilm", {"film": _live(stack), "points": points}))
    error = np.abs(got - np.asarray(table["R_rgb"]).reshape(-1, 3))
    assert error.max() < 1e-3
    assert error.mean() < 1e-4


def test_a_thick_metal_hides_what_lies_below(page: WebPage) -> None:
    """Behind 50 um of metal, where exp(-D) is 0 in single precision, glass and nothing reflect alike."""
    metal = {"index": {"n": 0.2, "k": 3.4}, "thicknessNm": 50_000}
    below = [
        page.call("readFilm", {"film": {"layers": [metal], "substrate": n}, "points": POINTS.tolist()})
        for n in (1.0, 1.5)
    ]
    assert np.isfinite(below).all()
    np.testing.assert_allclose(below[0], below[1], rtol=0, atol=1e-6)


def test_a_live_film_is_a_material(page: WebPage, tables: Path) -> None:
    """A sphere of the contract's film, computed in the shader, looks as that of its table."""
    film = {"layers": [{"index": 2.0, "thicknessNm": 420}], "substrate": 1.5}
    colours, cos_theta = _sphere(page, film=film, light="white")
    expected = LookupTexture.read(tables / "contract.exr").at(cos_theta, np.ones_like(cos_theta))
    assert _mean_relative_error(colours, expected) < 0.01


def test_the_colour_weights_are_those_of_colour_science() -> None:
    """src/colour-weights.json is what its script writes, from the CIE's data in colour-science."""
    script = SOURCE / "make_colour_weights.py"
    written = subprocess.run([sys.executable, script], capture_output=True, text=True, check=True).stdout
    assert json.loads(written) == json.loads((SOURCE / "src" / "colour-weights.json").read_text())


def test_the_lock_file_names_no_registry() -> None:
    """A lock file with addresses would install from one registry only."""
    assert "resolved" not in (SOURCE / "package-lock.json").read_text()


def test_the_page_keeps_to_its_origin(page: WebPage) -> None:
    """Nothing that was asked for above came from elsewhere, and no shader was complained about."""
    assert len(page.requests) > 1
    assert _strangers(page) == []
    # A missing table was asked for on purpose, and reading pixels back stalls the GPU.
    assert [text for text in page.complaints if "404" not in text and "ReadPixels" not in text] == []


def test_the_example_draws_its_spheres(browser: "Browser", package: Path) -> None:
    """The page of example/ loads the tables of its presets from its own folder and has nothing to say."""
    tables = package / "example" / "public" / "tables"
    tables.mkdir(parents=True)
    for preset in ("anodised-titanium", "morpho", "nacre", "oil-on-water", "beetle", "soap-bubble"):
        nacreous.write(nacreous.tabulate(nacreous.preset(preset)), tables / f"{preset}.exr")
    _npm(str(shutil.which("npm")), package, "run", "build:example")
    with open_page(browser, package / "example" / "dist", "index.html", width=240) as opened:
        opened.page.wait_for_selector("body[data-state=drawn]")
        assert opened.page.inner_text("#message") == ""
        assert _strangers(opened) == []


def _strangers(page: WebPage) -> list[str]:
    """Return what was asked for outside of the page's origin."""
    local = ("data:", "blob:", page.origin + "/")
    return [address for address in page.requests if not address.startswith(local)]
