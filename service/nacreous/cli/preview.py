"""``nacreous preview``: a picture of what a film looks like."""

from pathlib import Path
from typing import Annotated

import typer

from nacreous.cli.arguments import Assignments, SpecOrPreset

__all__ = ["preview"]


def preview(
    spec: SpecOrPreset,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="FILE.png", help="Picture to write.")
    ] = None,
    assignments: Assignments = None,
) -> None:
    """Draw a film: swatch, spectra, chromaticity.

    The swatch runs over angle and thickness, and so does the path of the chromaticity: angle 0 at the left,
    thickness upwards. The files of `nacreous tabulate --format exr` have grazing incidence, cos_theta = 0, at
    the left, and the first thickness in the top row.

    A rough surface, that of a spec with [surface] or with the quantity albedo or bsdf, adds its lobes in the
    plane of incidence, at 0, 30 and 60 degrees, and the colour of its albedo over roughness.
    """
    import logging

    # What it has to say of its cache and of fonts is no concern of who wants a picture.
    logging.getLogger("matplotlib").setLevel(logging.ERROR)
    from nacreous.cli.output import check_folder, check_suffix, file_stem
    from nacreous.cli.preview_figure import draw
    from nacreous.cli.preview_tables import preview_tables
    from nacreous.cli.progress import progress
    from nacreous.tables.presets import load

    picture = output or Path(f"{file_stem(spec)}.preview.png")
    check_suffix(picture)
    check_folder(picture.parent)
    film = load(spec, assignments or ())
    with progress("tabulating") as observer:
        tables = preview_tables(film, observer)
    picture.parent.mkdir(parents=True, exist_ok=True)
    draw(tables, picture)
    print(picture)
