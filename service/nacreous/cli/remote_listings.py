"""What a service knows: its presets and materials, listed as those of this computer are."""

import json
from collections.abc import Callable, Iterable

from nacreous.cli.listing import Row
from nacreous.cli.server import Server
from nacreous.cli.service_calls import calling
from nacreous.optics.catalogue import Listing

__all__ = ["print_preset", "print_presets", "search_service"]


def print_presets(server: Server, print_rows: Callable[[Iterable[Row]], None]) -> None:
    """Print the service's presets."""
    with calling(server) as client:
        listed = client.presets()
    print_rows([{"name": each.name, "description": each.description} for each in listed])


def print_preset(server: Server, name: str) -> None:
    """Print the spec of one of the service's presets, as one line of JSON, which is a spec file as well."""
    with calling(server) as client:
        print(json.dumps(client.preset(name).spec, allow_nan=False))


def search_service(server: Server, text: str) -> list[Listing]:
    """Return the service's materials whose name, description or citation holds every word of `text`."""
    with calling(server) as client:
        found = client.materials(text)
    return [Listing(each.name, each.description, each.citation, each.range_nm) for each in found]
