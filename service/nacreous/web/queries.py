"""Query parameters: only those that a route knows, each at most once, refused in the words of a spec's.

An unknown parameter is refused with 422 like an unknown field of a spec: a link with a slip of the keyboard
must not answer with something else than was meant.
"""

from collections.abc import Sequence

from starlette.requests import Request

from nacreous.errors import SpecError
from nacreous.optics.value import did_you_mean, named, shown

__all__ = ["chosen_word", "query", "whole_number"]


def query(request: Request, known: Sequence[str] = ()) -> dict[str, str]:
    """Return the query parameters of a request; raises `SpecError`."""
    found: dict[str, str] = {}
    for name, value in request.query_params.multi_items():
        if name not in known:
            expected = f"one of the query parameters {', '.join(known)}" if known else "no query parameters"
            raise SpecError(named(name), expected, "an unknown one", did_you_mean(name, known))
        if name in found:
            raise SpecError(name, "one value", "two")
        found[name] = value
    return found


def whole_number(parameters: dict[str, str], name: str, default: int, most: int) -> int:
    """Return a parameter from 0 to `most`; raises `SpecError`."""
    text = parameters.get(name)
    if text is None:
        return default
    if not (text.isascii() and text.isdecimal() and len(text) <= 12 and int(text) <= most):
        raise SpecError(name, f"a whole number from 0 to {most:,}", shown(text))
    return int(text)


def chosen_word(parameters: dict[str, str], name: str, words: Sequence[str]) -> str:
    """Return a parameter that is one of some words, the first of them where it is left out; see `query`."""
    text = parameters.get(name, words[0])
    if text not in words:
        raise SpecError(name, f"one of {', '.join(words)}", shown(text), did_you_mean(text, words))
    return text
