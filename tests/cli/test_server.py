"""``nacreous --server``: what a service computes is what this computer would have written."""

import json
import os
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import spec_texts
from answering_server import answering, json_answer, problem_answer
from nacreous.formats.names import FormatName
from nacreous.formats.registry import FORMATS
from served import serving

Run = Callable[..., subprocess.CompletedProcess[str]]

COLOURED = "wavelength_nm = { start = 380, stop = 780, step = 20 }\n"
FILM = f'name = "A film & its \\"label\\""\n{spec_texts.FILM}{COLOURED}'
ROUGH = f"{spec_texts.ROUGH}{COLOURED}"
KEY = "a-key-of-twenty-four-characters"
SMOOTH = [name for name in FORMATS if "fresnel" in FORMATS[name].quantities]
CASES = {
    "smooth": (FILM, [name for name in SMOOTH if name is not FormatName.SPECTRAL_EXR]),
    "spectra": (FILM, [FormatName.SPECTRAL_EXR]),
    "rough": (ROUGH, [FormatName.RGL_RGB, FormatName.EXR, FormatName.MBSDF]),
}
"""Every format of a smooth film, and of a rough one some that are sampled where their readers want it."""


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Run a service that wants a key, and makes a job of nothing."""
    with serving(tmp_path_factory.mktemp("service"), api_keys=KEY, synchronous_seconds=1000) as served:
        served.await_ready()
        yield served.url


@pytest.fixture
def ask(run: Run, server: str) -> Run:
    """Return what runs the program with the service and its key."""

    def run_with_server(*arguments: str) -> subprocess.CompletedProcess[str]:
        return run("--server", server, *arguments, env={**os.environ, "NACREOUS_SERVER_KEY": KEY})

    return run_with_server


def contents(folder: Path) -> dict[str, bytes]:
    """Return the files of a folder."""
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def records(done: subprocess.CompletedProcess[str]) -> list[dict[str, object]]:
    """Return what a run has printed of its files, without what depends on the run."""
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    return [{**line, "seconds": 0, "path": Path(line["path"]).name} for line in lines]


@pytest.mark.parametrize("case", CASES)
def test_files_are_the_local_ones_byte_for_byte(run: Run, ask: Run, tmp_path: Path, case: str) -> None:
    """Names, order, records and bytes, of a file whose name and label XML has to escape."""
    text, formats = CASES[case]
    (tmp_path / "my film & co.toml").write_text(text)
    options = [option for name in formats for option in ("--format", name)]
    local = run("tabulate", "my film & co.toml", *options, "-o", "local", "--json")
    remote = ask("tabulate", "my film & co.toml", *options, "-o", "remote", "--json")
    assert (local.returncode, remote.returncode, remote.stderr) == (0, 0, local.stderr)
    assert records(remote) == records(local)
    assert contents(tmp_path / "remote") == contents(tmp_path / "local")


def test_a_preset_with_an_assignment_is_the_local_one(run: Run, ask: Run, tmp_path: Path) -> None:
    """What is sent is the spec as it is read here; a MaterialX document names the textures beside it."""
    arguments = ("tabulate", "paper/figure-3", "--set", "table.cos_theta=8", "--format", "exr", "--format")
    local = run(*arguments, "materialx", "-o", "local")
    remote = ask(*arguments, "materialx", "-o", "remote")
    assert (local.returncode, remote.returncode) == (0, 0), remote.stderr
    assert remote.stdout == local.stdout.replace("local", "remote")
    assert contents(tmp_path / "remote") == contents(tmp_path / "local")
    assert b'"paper-figure-3.transmission.exr"' in contents(tmp_path / "remote")["paper-figure-3.mtlx"]


def test_what_an_earlier_table_has_left_is_removed(ask: Run, tmp_path: Path) -> None:
    """A stranger would take it for the transmission of this film; a file of somebody else stays."""
    (tmp_path / "film.toml").write_text(FILM)
    assert ask("tabulate", "film.toml", "--format", "exr").returncode == 0
    assert (tmp_path / "film.transmission.exr").exists()
    (tmp_path / "film.transmission.png").write_bytes(b"somebody's")
    silver = ("--set", 'stack.substrate="main/Ag/Johnson"')
    assert ask("tabulate", "film.toml", *silver, "--format", "exr", "--format", "png").returncode == 0
    written = {path.name for path in tmp_path.iterdir()}
    assert written == {"film.toml", "film.exr", "film.png", "film.transmission.png"}


def test_a_table_of_some_time_is_waited_for(run: Run, tmp_path: Path) -> None:
    """A service that lets nobody wait makes a job of every table; the files are the same."""
    with serving(tmp_path / "store", synchronous_seconds=0) as served:
        served.await_ready()
        (tmp_path / "film.toml").write_text(FILM)
        remote = run(
            "tabulate", "film.toml", "-o", "remote", env={**os.environ, "NACREOUS_SERVER": served.url}
        )
        assert any('"/v1/tables", "status": 202' in line for line in served.lines)
    run("tabulate", "film.toml", "-o", "local")
    assert (remote.returncode, remote.stderr) == (0, "")
    assert contents(tmp_path / "remote") == contents(tmp_path / "local")


@pytest.mark.parametrize(
    "arguments",
    [
        ("tabulate", "film.toml", "--set", "table.cos_theta=-1"),
        ("tabulate", "film.toml", "--set", 'stack.layers.0.material="watr"'),
        ("tabulate", "film.toml", "--format", "merl"),
        ("tabulate", "film.toml", "-o", "film.toml"),
        ("tabulate", "absent.toml"),
    ],
)
def test_a_wrong_spec_is_refused_in_the_same_words(
    run: Run, ask: Run, tmp_path: Path, arguments: tuple[str, ...]
) -> None:
    """One message and exit code 2, whoever has found it."""
    (tmp_path / "film.toml").write_text(FILM)
    local, remote = run(*arguments), ask(*arguments)
    assert (remote.returncode, remote.stdout, remote.stderr) == (2, "", local.stderr)


def test_a_table_beyond_the_budget_is_refused_by_the_service(ask: Run, tmp_path: Path) -> None:
    """Exit code 2, as here; nothing is written, not even the folder."""
    scales = "table.thickness_scale={start=0.5,stop=1.5,count=60000}"
    done = ask("tabulate", "paper/figure-3", "--set", "table.cos_theta=60000", "--set", scales, "-o", "out")
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1)
    assert done.stderr.count("MiB") == 2
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("status", "kind", "code"),
    [(400, "json", 2), (413, "budget", 2), (422, "format", 1), (500, "internal", 1), (504, "deadline", 1)],
)
def test_each_problem_has_its_exit_code(run: Run, status: int, kind: str, code: int) -> None:
    """2 where the input is wrong, 1 otherwise; the message is the service's."""
    with answering() as service:
        service.script("POST /v1/tables", problem_answer(status, kind, detail="what is wrong"))
        done = run("--server", service.address, "tabulate", "soap-bubble")
    assert (done.returncode, done.stdout, done.stderr) == (code, "", "nacreous: what is wrong\n")


def test_words_of_the_service_become_the_message_of_a_spec_error(run: Run) -> None:
    """A service may know better: its field, what it expected and what it got are told as always."""
    told = {"field": "stack", "expected": "a film", "got": "none", "remedy": "give one"}
    with answering() as service:
        service.script("POST /v1/tables", problem_answer(422, "spec", detail="stack: …", **told))
        done = run("--server", service.address, "tabulate", "soap-bubble")
    assert (done.returncode, done.stderr) == (2, "nacreous: stack: expected a film, got none; give one\n")


def test_a_service_out_of_reach_is_named_with_what_to_do(run: Run) -> None:
    """The address, the system's reason, and how to start one; exit code 1, because the spec is right."""
    with answering() as service:
        address = service.address
    done = run("--server", address, "tabulate", "soap-bubble")
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (1, "", 1)
    assert f"cannot reach {address}: " in done.stderr
    assert "nacreous serve" in done.stderr


@pytest.mark.parametrize("address", ["http://anna:s3cret@127.0.0.1:9", "htp://anna:s3cret@host"])
def test_a_password_in_the_address_is_not_shown(run: Run, address: str) -> None:
    """Neither where nothing answers there, nor where it is no address at all."""
    done = run("--server", address, "tabulate", "soap-bubble")
    assert done.returncode in {1, 2}
    assert "…@" in done.stderr
    assert "s3cret" not in done.stderr


def test_another_program_at_the_address_is_told(run: Run) -> None:
    """Not every port is a service's."""
    with answering() as service:
        service.script("POST /v1/tables", json_answer({"hello": "world"}))
        done = run("--server", service.address, "tabulate", "soap-bubble")
    assert (done.returncode, done.stderr.count("\n")) == (1, 1)
    assert "expected an answer of a Nacreous service" in done.stderr


@pytest.mark.parametrize("key", [None, "another-key-of-some-length"])
def test_a_service_that_wants_a_key_says_so(run: Run, server: str, key: str | None) -> None:
    """The message names the variable that holds the key, and not the key."""
    environment = os.environ | ({} if key is None else {"NACREOUS_SERVER_KEY": key})
    done = run("--server", server, "tabulate", "soap-bubble", env=environment)
    assert (done.returncode, done.stderr.count("\n")) == (1, 1)
    assert "NACREOUS_SERVER_KEY" in done.stderr
    assert str(key) not in done.stderr


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--server", "localhost:8000", "tabulate", "soap-bubble"), "--server: expected an address such as"),
        (("--server", "http://localhost:8000", "verify", "film.exr"), "--server: expected a command"),
    ],
)
def test_a_wrong_server_is_a_wrong_option(run: Run, arguments: tuple[str, ...], message: str) -> None:
    """One message, exit code 2; a command that a service has no part in is not run as if it had."""
    done = run(*arguments)
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1)
    assert message in done.stderr


def test_the_environment_is_for_the_commands_that_can_ask(run: Run) -> None:
    """NACREOUS_SERVER may be set for good: what needs no service runs as without it."""
    done = run("schema", env={**os.environ, "NACREOUS_SERVER": "http://localhost:1"})
    assert (done.returncode, done.stdout) == (0, run("schema").stdout)


def test_presets_and_materials_are_those_of_the_service(run: Run, ask: Run) -> None:
    """The same version knows the same."""
    for arguments in (("presets",), ("presets", "--json"), ("materials", "search", "johnson", "ag")):
        assert ask(*arguments).stdout == run(*arguments).stdout
    shown = run("presets", "paper/figure-3", "--json").stdout
    assert json.loads(ask("presets", "paper/figure-3").stdout) == json.loads(shown)
