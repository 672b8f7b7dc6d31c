"""``nacreous materials``: the names that can stand for a refractive index, and what is behind them."""

from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated

import typer

from nacreous.cli.arguments import AsJson
from nacreous.cli.server import server_of

if TYPE_CHECKING:
    from nacreous.optics.catalogue import Listing

__all__ = ["materials"]

_SHOWN_NM = (400.0, 450.0, 500.0, 550.0, 600.0, 650.0, 700.0)


def materials() -> typer.Typer:
    """Return the group of commands."""
    group = typer.Typer(help="Find and show named materials.")
    group.callback(invoke_without_command=True)(_own)
    group.command()(search)
    group.command()(show)
    return group


def _own(context: typer.Context) -> None:
    """Named materials: the project's own, which are listed here, and refractiveindex.info."""
    if context.invoked_subcommand is None:
        from nacreous.optics.catalogue import describe_material
        from nacreous.optics.library import library_names

        _print([describe_material(name) for name in library_names()])


def search(
    context: typer.Context,
    text: Annotated[list[str], typer.Argument(help="Words, all of which must occur.")],
    *,
    as_json: AsJson = False,
) -> None:
    """Find materials whose name, description or citation holds every word."""
    from nacreous.cli.listing import print_json_lines

    found = _found(context, " ".join(text))
    if as_json:
        print_json_lines(map(asdict, found))
    else:
        _print(found)
        print(f"{len(found)} found")


def _found(context: typer.Context, text: str) -> "list[Listing]":
    if server := server_of(context):
        from nacreous.cli.remote_listings import search_service

        return search_service(server, text)
    from nacreous.optics.catalogue import search_materials

    return search_materials(text)


def _print(listings: "list[Listing]") -> None:
    from nacreous.cli.listing import print_columns

    print_columns(
        {"name": listing.name, "range": _range(listing), "description": _one_line(listing)}
        for listing in listings
    )


def _range(listing: "Listing") -> str:
    first, last = listing.range_nm
    return f"{first:g}-{last:g} nm"


def _one_line(listing: "Listing") -> str:
    text = listing.description or listing.citation
    return text if len(text) <= 100 else f"{text[:99]}…"


def show(
    name: Annotated[str, typer.Argument(help="A name, or a page such as main/Ag/Johnson.")],
    *,
    as_json: AsJson = False,
) -> None:
    """Show what is known about one material: its source, its range, and n and k in the visible."""
    from nacreous.cli.listing import print_columns, print_json_lines
    from nacreous.optics.catalogue import describe_material

    listing = describe_material(name)
    samples = _samples(listing)
    if as_json:
        print_json_lines([{**asdict(listing), "samples": samples}])
        return
    about = {"name": listing.name, "what": listing.description, "source": listing.citation}
    print_columns({"field": field, "text": text} for field, text in about.items() if text)
    print(f"range   {_range(listing)}\n")
    print_columns(
        {"nm": f"{at['wavelength_nm']:g} nm", "n": f"n {at['n']:.5g}", "k": f"k {at['k']:.5g}"}
        for at in samples
    )


def _samples(listing: "Listing") -> list[dict[str, float]]:
    """Return n and k at round wavelengths of the visible range, or at both ends where none is known."""
    from nacreous.optics.material import NamedMaterial
    from nacreous.optics.refractive_index import refractive_index

    first, last = listing.range_nm
    at_nm = [nm for nm in _SHOWN_NM if first <= nm <= last] or [first, last]
    index = refractive_index(NamedMaterial(name=listing.name), at_nm)
    return [
        {"wavelength_nm": nm, "n": float(n.real), "k": float(n.imag)}
        for nm, n in zip(at_nm, index, strict=True)
    ]
