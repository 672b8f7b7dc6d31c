"""Kernel sources with their includes expanded: the only reader of the `kernels` folder.

Includes are expanded here because a path with a space breaks ``-I`` on PoCL, and because the complete text is
what identifies a kernel in a table's provenance. ``#line`` directives keep the compiler's messages true.
"""

import functools
import hashlib
import re
from pathlib import Path

from nacreous.paths import KERNELS

__all__ = ["complete_source", "kernel_names", "kernels_hash"]

_INCLUDE = re.compile(r'#include "([a-z0-9_]+\.clh)"\s*')


def kernel_names() -> list[str]:
    """Names of all kernels: each is a file ``<name>.cl`` and the one function of that name in it."""
    return sorted(path.stem for path in KERNELS.glob("*.cl"))


def complete_source(kernel: str) -> str:
    """Text of a kernel file with every ``#include`` expanded in place, a header the first time only."""
    return _expand(f"{kernel}.cl", set())


def kernels_hash() -> str:
    """SHA-256, in hex, over the complete text of every kernel."""
    return _hash_of(tuple((file, file.stat().st_mtime_ns) for file in sorted(KERNELS.glob("*.cl*"))))


@functools.lru_cache(maxsize=1)
def _hash_of(_: tuple[tuple[Path, int], ...]) -> str:
    """Compute the hash for files as they are: it is asked for with every table."""
    digest = hashlib.sha256()
    for name in kernel_names():
        digest.update(complete_source(name).encode())
    return digest.hexdigest()


def _expand(file: str, seen: set[str]) -> str:
    """Expand a file; `seen` holds the headers that are in the text for certain.

    What a header brings in between ``#if`` and ``#endif`` may not be compiled, so it does not count as seen.
    """
    seen.add(file)
    lines = [f'#line 1 "{file}"']
    depth = -1 if file.endswith(".clh") else 0  # a header's own guard is no condition
    for number, line in enumerate((KERNELS / file).read_text(encoding="utf-8").splitlines(), 1):
        if not line.startswith("#"):
            lines.append(line)
            continue
        depth += line.startswith("#if") - line.startswith("#endif")
        included = _INCLUDE.fullmatch(line)
        if included is None:
            lines.append(line)
        elif included[1] in seen:
            lines.append("")
        else:
            text = _expand(included[1], set(seen) if depth > 0 else seen)
            lines += [text, f'#line {number + 1} "{file}"']
    return "\n".join(lines)
