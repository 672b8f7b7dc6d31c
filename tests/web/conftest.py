"""One app for all tests of routes that change nothing of it."""

from collections.abc import Iterator
from typing import Any

import pytest

from running_app import RunningApp, running_app, settings_for


@pytest.fixture(scope="session")
def app(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningApp]:
    """Return an app with a store of its own, and no keys."""
    with running_app(settings_for(tmp_path_factory.mktemp("service"))) as running:
        yield running


@pytest.fixture(scope="session")
def film() -> dict[str, Any]:
    """Return the spec of a film that is computed at once."""
    return {
        "stack": {
            "incident": "air",
            "substrate": {"n": 1.5},
            "layers": [{"material": {"n": 2.0}, "thickness_nm": 420}],
        },
        "table": {"cos_theta": 8, "wavelength_nm": {"start": 400, "stop": 700, "count": 16}},
    }


@pytest.fixture(scope="session")
def table(app: RunningApp, film: dict[str, Any]) -> dict[str, Any]:
    """Return the answer to the film's spec."""
    answer = app.post("/v1/tables", json=film)
    assert answer.status_code in {200, 201}, answer.text
    return dict(answer.json())
