"""schemathesis over the whole OpenAPI document: whatever is sent, the answer is one that it describes.

In every run 2,000 cases, drawn at random. Where NACREOUS_SOAK is set 20,000, also at the edges of every
schema, and in sequences in which what one request answers is what the next one asks for. Against the real
service, with a byte budget so small that whatever is computed is computed at once.

Two checks are left out. A spec may fit its schema and still be none: physics is not written in JSON Schema.
And DELETE of a job ends it, after which it is there to be looked at.
"""

import json
import os
import subprocess
from pathlib import Path

import pytest

from served import serving

SOAK = bool(os.environ.get("NACREOUS_SOAK"))
CASES = 20_000 if SOAK else 2_000
EXAMPLES_AN_OPERATION = 400 if SOAK else 75
"""Of each kind, right and wrong, for 15 operations; those at the edges come on top in a soak."""
PHASES = "examples,coverage,fuzzing,stateful" if SOAK else "examples,fuzzing"
LEFT_OUT = "positive_data_acceptance,use_after_free"
HOOKS = Path(__file__).parents[1] / "schemathesis_hooks.py"


def test_every_answer_is_one_that_openapi_describes(tmp_path: Path) -> None:
    """No 5xx that is not described, and no status, type, header or document that is not; 0 failures."""
    schemathesis = pytest.importorskip("schemathesis")
    assert schemathesis
    with serving(tmp_path / "store", byte_budget="1M", job_tables=4, deadline_seconds=10) as served:
        served.await_ready()
        done = run(f"{served.url}/openapi.json", tmp_path)
        report = json.loads((tmp_path / "report.json").read_text())
        assert done.returncode == 0, done.stdout[-8000:]
        assert report["test_cases"]["generated"] >= CASES
        assert report["operations"]["tested"] == report["operations"]["total"] >= 15
        assert report["failures"] == report["errors"] == []
        assert served.stop() == 0
    assert not [line for line in served.lines if "unforeseen" in line]


def run(location: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """Run schemathesis, which leaves a report in a folder."""
    program = [
        *("schemathesis", "run", location, "--no-color", "--seed", "1", "--request-timeout", "60"),
        *("--phases", PHASES, "--max-examples", str(EXAMPLES_AN_OPERATION)),
        *("--exclude-checks", LEFT_OUT, "--suppress-health-check", "all", "--warnings", "off"),
        *("--report", "json", "--report-json-path", str(folder / "report.json")),
    ]
    environment = {**os.environ, "SCHEMATHESIS_HOOKS": str(HOOKS)}
    return subprocess.run(program, cwd=folder, env=environment, capture_output=True, text=True, check=False)
