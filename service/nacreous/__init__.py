"""Tabulated BSDFs of thin-film interference, for renderers without spectral interference.

>>> import nacreous
>>> spec = nacreous.preset("soap-bubble")
>>> spec.stack.layers[0].thickness_nm
1000.0

``nacreous.tabulate(spec)`` computes the table, ``nacreous.write(table, "film.exr")`` writes it, and
``nacreous.verify("film.exr")`` reads it again. Nothing is imported before it is used: ``import nacreous``
needs no OpenCL device.
"""

from collections.abc import Callable, Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import xarray

    from nacreous import errors
    from nacreous.formats.registry import write
    from nacreous.formats.verify import verify
    from nacreous.tables.presets import preset
    from nacreous.tables.spec import Spec

    __version__: str

__all__ = ["Spec", "__version__", "errors", "preset", "tabulate", "verify", "write"]

_HOMES = {
    "Spec": "nacreous.tables.spec",
    "preset": "nacreous.tables.presets",
    "verify": "nacreous.formats.verify",
    "write": "nacreous.formats.registry",
}
"""The module of each public name that is not defined here."""


def tabulate(
    spec: "Spec | Mapping[str, Any]", *, observer: Callable[[float], None] | None = None
) -> "xarray.Dataset":
    """Compute a table.

    Parameters
    ----------
    spec : Spec or mapping
        A mapping holds the fields of a spec, as a TOML or JSON document does.
    observer : callable, optional
        Called with the fraction done, 0 to 1; what it raises ends the computation.

    Returns
    -------
    xarray.Dataset
        ``R_s, R_p, T_s, T_p`` over ``(thickness_scale, cos_theta, wavelength_nm)`` and the linear colours
        ``R_rgb``, ``T_rgb`` over ``(thickness_scale, cos_theta, channel)``; units and meanings are attributes
        of the arrays, provenance is in ``.attrs``.

    Raises
    ------
    SpecError
        The mapping is no spec. A material does not reach a wavelength, or absorbs in front of the stack.
    BudgetError, DeviceError, NumericalError
        The table is too large, there is no device, or a value breaks the law that it must obey.
    """
    from nacreous.tables.spec import Spec
    from nacreous.tables.tabulate import tabulate_table

    film = Spec.from_document(dict(spec)) if isinstance(spec, Mapping) else spec
    if not isinstance(film, Spec):
        from nacreous.errors import SpecError

        remedy = "nacreous.preset(name) and nacreous.Spec.from_file(path) give one"
        raise SpecError("", "a nacreous.Spec or a mapping of its fields", type(spec).__name__, remedy)
    return tabulate_table(film, observer=observer).to_xarray()


def __getattr__(name: str) -> Any:  # noqa: ANN401 - any public name
    if name == "__version__":
        return _version()
    if name == "errors":
        return import_module("nacreous.errors")
    if name in _HOMES:
        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f"module 'nacreous' has no attribute {name!r}")


def _version() -> str:
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version("nacreous")
    except PackageNotFoundError:  # a checkout that is on the path without being installed
        return "0+unknown"


def __dir__() -> list[str]:
    return sorted(__all__)
