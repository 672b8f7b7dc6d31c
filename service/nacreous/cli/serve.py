"""``nacreous serve``: the HTTP service, in this process until it is told to stop."""

from typing import TYPE_CHECKING, Annotated

import typer

from nacreous.errors import SpecError

if TYPE_CHECKING:
    from nacreous.web.settings import Settings

__all__ = ["serve"]


def serve(
    host: Annotated[str | None, typer.Option(help="Address to listen on, 127.0.0.1 without one.")] = None,
    port: Annotated[int | None, typer.Option(help="Port to listen on, 8000 without one; 0: any.")] = None,
    store: Annotated[
        str | None,
        typer.Option(metavar="DIR|URL", help="Where finished tables are kept: s3://bucket/prefix."),
    ] = None,
) -> None:
    """Serve tables, presets and materials over HTTP.

    Everything else is set by NACREOUS_ variables of the environment, which docs/service.md lists. SIGTERM
    ends it once the requests that run are answered.
    """
    from nacreous.web.server import serve as run

    given = {"host": host, "port": port, "store": store}
    run(_settings({name: value for name, value in given.items() if value is not None}))


def _settings(given: dict[str, str | int]) -> "Settings":
    """Return the settings; raises `SpecError` that names the option or variable that is wrong."""
    from pydantic import ValidationError

    from nacreous.tables.spec_document import spec_error
    from nacreous.web.settings import Settings

    try:
        return Settings(**given)  # type: ignore[arg-type]
    except ValidationError as error:
        wrong = spec_error(error)
        name, *rest = wrong.field.split(".")
        if name == "api_keys":  # what was given is a secret, right or wrong
            expected = "keys of 16 to 512 characters, with commas between"
            raise SpecError("NACREOUS_API_KEYS", expected, "something else", "unset it for no key") from None
        named = f"--{name}" if name in given else f"NACREOUS_{name.upper()}"
        raise SpecError(".".join([named, *rest]), wrong.expected, wrong.got, wrong.remedy) from None
