"""schemathesis over the whole OpenAPI document: whatever is sent, the answer is one that it describes.

In every run 2,000 cases at the edges of every schema. Where NACREOUS_SOAK is set at least 20,000: all edges,
random ones, and sequences in which what one request answers is what the next one asks for. Against the real
service, in processes of their own: schemathesis and Hypothesis warn of things that are errors here. The byte
budget is so small that whatever is computed is computed at once.
"""

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from served import Served, serving

TESTS = Path(__file__).parents[1]
CASES, SOAKED_CASES = 2_000, 20_000


@pytest.fixture
def served(tmp_path: Path) -> Iterator[Served]:
    """Return a service of small tables and short jobs, which ends without an unforeseen error."""
    pytest.importorskip("schemathesis")
    with serving(tmp_path / "store", byte_budget="1M", job_tables=4, deadline_seconds=10) as running:
        running.await_ready()
        yield running
        assert running.stop() == 0
        assert not [line for line in running.lines if "unforeseen" in line]


def test_every_answer_is_one_that_openapi_describes(served: Served) -> None:
    """No 5xx, no status, type, header or document that is not in the schema; 0 failures, every operation."""
    program = [sys.executable, "-m", "contract_cases", served.url, str(CASES)]
    done = subprocess.run(program, cwd=TESTS, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-6000:]
    report = json.loads(done.stdout)
    assert report["cases"] == CASES
    assert len(report["operations"]) >= 15
    assert {"200", "202", "404", "405", "413", "422"} <= report["statuses"].keys()
    assert not any(status.startswith("5") for status in report["statuses"])


@pytest.mark.skipif(not os.environ.get("NACREOUS_SOAK"), reason="takes long: set NACREOUS_SOAK=1")
def test_every_answer_to_20_000_cases(served: Served, tmp_path: Path) -> None:
    """The same, with all that schemathesis can think of."""
    program = [
        *(sys.executable, "-m", "schemathesis.cli", "run", f"{served.url}/openapi.json", "--no-color"),
        *("--seed", "1", "--max-examples", "400", "--request-timeout", "60", "--warnings", "off"),
        *("--exclude-checks", "positive_data_acceptance,use_after_free", "--suppress-health-check", "all"),
        *("--report", "json", "--report-json-path", "report.json"),
    ]
    environment = {**os.environ, "SCHEMATHESIS_HOOKS": str(TESTS / "schemathesis_hooks.py")}
    done = subprocess.run(program, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-8000:]
    report = json.loads((tmp_path / "report.json").read_text())
    assert report["test_cases"]["generated"] >= SOAKED_CASES
    assert report["operations"]["tested"] == report["operations"]["total"] >= 15
    assert report["failures"] == report["errors"] == []
