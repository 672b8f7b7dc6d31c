"""The OpenAPI document, and every request that it shows: each is sent, and answered as it says."""

import json
from typing import Any

import pytest

from nacreous.web.answers import ProblemAnswer
from running_app import RunningApp


@pytest.fixture(scope="module")
def openapi(app: RunningApp) -> dict[str, Any]:
    """Return the document."""
    return dict(app.get("/openapi.json").json())


def examples(openapi: dict[str, Any]) -> list[tuple[str, str, str, Any]]:
    """Return route, media type, name and value of every example of a body."""
    return [
        (path, media_type, name, example["value"])
        for path, operations in openapi["paths"].items()
        for operation in operations.values()
        for media_type, content in operation.get("requestBody", {}).get("content", {}).items()
        for name, example in content.get("examples", {}).items()
    ]


def test_every_example_is_answered_as_it_says(app: RunningApp, openapi: dict[str, Any]) -> None:
    """2xx, with the fields that the schema of that answer has."""
    shown = examples(openapi)
    assert len(shown) >= 6
    for path, media_type, name, value in shown:
        content = value if isinstance(value, str) else json.dumps(value)
        answer = app.post(path, content=content, headers={"content-type": media_type})
        assert answer.is_success, f"{name}: {answer.text}"
        responses = openapi["paths"][path]["post"]["responses"]
        schema = responses[str(answer.status_code)]["content"]["application/json"]["schema"]
        component = openapi["components"]["schemas"][schema["$ref"].rpartition("/")[2]]
        assert answer.json().keys() <= component["properties"].keys()
        assert answer.json().keys() >= set(component["required"])


def test_every_reference_leads_somewhere(openapi: dict[str, Any]) -> None:
    """Each $ref names a component that is there, and each component is used."""
    named = {reference.rpartition("/")[2] for reference in references(openapi)}
    assert named == set(openapi["components"]["schemas"])


def references(part: object) -> list[str]:
    """Return every $ref below a part of a document."""
    if isinstance(part, list):
        return [found for entry in part for found in references(entry)]
    if not isinstance(part, dict):
        return []
    own = [part["$ref"]] if isinstance(part.get("$ref"), str) else []
    return own + [found for entry in part.values() for found in references(entry)]


def test_the_schema_of_a_spec_bounds_its_numbers(openapi: dict[str, Any]) -> None:
    """Bounds are under the names that JSON Schema has for them."""
    n = openapi["components"]["schemas"]["ConstantMaterial"]["properties"]["n"]
    assert (n["minimum"], n["maximum"]) == (1e-3, 1e3)


def test_problems_are_described(app: RunningApp, openapi: dict[str, Any]) -> None:
    """Every operation says that it answers problems, and one is what the schema says."""
    for operations in openapi["paths"].values():
        for operation in operations.values():
            assert "application/problem+json" in operation["responses"]["422"]["content"]
    ProblemAnswer.model_validate(app.get("/v1/tables/none").json())
