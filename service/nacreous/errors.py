"""What can go wrong, said so that the reader can mend it.

These errors know nothing of HTTP or of exit codes: the command line and the service each map them once.
"""

import re

__all__ = [
    "BudgetError",
    "BusyError",
    "DeadlineError",
    "DeviceError",
    "FileFormatError",
    "LaterError",
    "MissingError",
    "NacreousError",
    "NumericalError",
    "SpecError",
    "StoreError",
    "UnavailableError",
    "reason",
    "without_user_info",
]

_USER_INFO = re.compile(r"(?<=://)(?:[^/:@]*:(?!\d+(?:/|$)).*|[^/?#]*)@")
"""Of an address, up to its last @, for a key of S3 may hold a slash; what a port follows is none."""


class NacreousError(Exception):
    """Any failure that Nacreous foresees; its text is one message for a person."""


class SpecError(NacreousError):
    """A field of a spec, an option or a file name is not usable.

    Parameters
    ----------
    field : str
        Dotted path of the field, such as ``"stack.layers.0.thickness_nm"``; empty for the whole document.
    expected, got : str
        What would have been right, and what came.
    remedy : str, optional
        What to do about it: one sentence.
    """

    def __init__(self, field: str, expected: str, got: str, remedy: str = "") -> None:
        self.field, self.expected, self.got, self.remedy = field, expected, got, remedy
        where = f"{field}: " if field else ""
        super().__init__(f"{where}expected {expected}, got {got}" + (f"; {remedy}" if remedy else ""))

    def under(self, field: str) -> "SpecError":
        """Return the same error one level further out: its field below `field`."""
        path = f"{field}.{self.field}" if self.field else field
        return type(self)(path, self.expected, self.got, self.remedy)


class BudgetError(NacreousError):
    """A table needs more bytes than it may have; raised before anything is allocated."""

    def __init__(self, what: str, needed_bytes: int, limit_bytes: int) -> None:
        self.needed_bytes, self.limit_bytes = needed_bytes, limit_bytes
        super().__init__(
            f"{what} needs {_size(needed_bytes)} and the limit is {_size(limit_bytes)}; "
            "use fewer samples on an axis, where the format leaves that to you, or raise NACREOUS_BYTE_BUDGET"
        )


def _size(count: int) -> str:
    """Return a number of bytes in the largest unit, up to MiB, that it fills."""
    if count < 2**10:
        return f"{count} bytes"
    return f"{count / 2**10:,.1f} KiB" if count < 2**20 else f"{count / 2**20:,.1f} MiB"


class DeviceError(NacreousError):
    """No OpenCL device can do the work; the text says what to install or to set."""


class NumericalError(NacreousError):
    """A computed value is not finite or breaks the law it must obey; nothing is stored."""


class FileFormatError(NacreousError):
    """A file cannot be read, or a table cannot be written in the format asked for."""


class MissingError(NacreousError):
    """What was asked for is not there: a table, a job, or a file that the table has no content for."""


class StoreError(NacreousError):
    """The store cannot be read or written; what is in it is as it was."""


class LaterError(NacreousError):
    """What was asked for cannot be had now, and could be later.

    Parameters
    ----------
    message : str
    retry_after_s : float
        When to ask again.
    """

    def __init__(self, message: str, retry_after_s: float) -> None:
        self.retry_after_s = retry_after_s
        super().__init__(message)


class BusyError(LaterError):
    """Too much is waiting already; nothing has been begun."""


class UnavailableError(LaterError):
    """The engine cannot compute this just now: it starts, has lost its worker twice, or is stopping."""


class DeadlineError(NacreousError):
    """A table took longer than it may; what computed it has been ended, and nothing is stored."""


def reason(error: Exception) -> str:
    """Return why something failed, without the number that the operating system gives it."""
    return getattr(error, "strerror", None) or str(error)


def without_user_info(url: str, text: str | None = None) -> str:
    """Return an address, or a text in which it may stand, without the name and the password before its host.

    Addresses are in messages, messages in logs, and logs in many hands.

    >>> without_user_info("s3://name:pass/word@bucket/prefix")
    's3://…@bucket/prefix'
    """
    found = _USER_INFO.search(url)
    return (text or url).replace(found[0], "…@") if found else text or url
