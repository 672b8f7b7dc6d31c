"""Kernel sources with their includes expanded: the only reader of the `kernels` folder.

Includes are expanded here because a path with a space breaks ``-I`` on PoCL, and because the complete text is
what identifies a kernel in a table's provenance. ``#line`` directives keep the compiler's messages true.
"""

import hashlib
import re

from nacreous.paths import KERNELS

__all__ = ["complete_source", "kernel_names", "kernels_hash"]

_INCLUDE = re.compile(r'#include "([a-z0-9_]+\.clh)"\s*')


def kernel_names() -> list[str]:
    """Names of all kernels: each is a file ``<name>.cl`` and the one function of that name in it."""
    return sorted(path.stem for path in KERNELS.glob("*.cl"))


def complete_source(kernel: str) -> str:
    """Text of a kernel file with every ``#include`` expanded in place.

    Include guards stay, so a header may appear more than once in the text.
    """
    return _expand(f"{kernel}.cl")


def kernels_hash() -> str:
    """SHA-256, in hex, over the complete text of every kernel."""
    digest = hashlib.sha256()
    for name in kernel_names():
        digest.update(complete_source(name).encode())
    return digest.hexdigest()


def _expand(file: str) -> str:
    lines = [f'#line 1 "{file}"']
    for number, line in enumerate((KERNELS / file).read_text(encoding="utf-8").splitlines(), 1):
        included = _INCLUDE.fullmatch(line)
        if included:
            lines += [_expand(included[1]), f'#line {number + 1} "{file}"']
        else:
            lines.append(line)
    return "\n".join(lines)
