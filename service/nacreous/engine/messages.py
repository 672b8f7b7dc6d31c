"""What the supervisor and its worker say to each other, over two pipes.

A message is two big-endian numbers, the lengths of what follows (4 and 8 bytes), an object of JSON, and
raw bytes. Nothing is pickled: whatever came over the pipe, reading it runs no code.
"""

import json
import struct
from asyncio import IncompleteReadError, StreamReader
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, BinaryIO

from nacreous.engine.work import File, Product, Work
from nacreous.errors import (
    BudgetError,
    DeviceError,
    FileFormatError,
    MissingError,
    NumericalError,
    SpecError,
    StoreError,
)
from nacreous.formats.names import FormatName
from nacreous.tables.spec import Spec

__all__ = [
    "Message",
    "error_message",
    "error_of",
    "fault_message",
    "product_message",
    "product_of",
    "read",
    "receive",
    "send",
    "work_message",
    "work_of",
]

_LENGTHS = struct.Struct(">IQ")
_CHUNK_BYTES = 2**20

_CLASSES: Mapping[str, type[Exception]] = {
    kind.__name__: kind
    for kind in (
        BudgetError,
        DeviceError,
        FileFormatError,
        MissingError,
        NumericalError,
        SpecError,
        StoreError,
        RuntimeError,  # what nobody has foreseen
    )
}
"""The errors that cross; one of a class derived from these crosses as that class."""


@dataclass(frozen=True)
class Message:
    """What is said: its kind, further fields fit for JSON, and bytes."""

    kind: str
    fields: Mapping[str, Any]
    payload: bytes = b""

    def to_bytes(self) -> bytes:
        """Return the message as the pipe carries it."""
        head = json.dumps({"kind": self.kind, **self.fields}, separators=(",", ":")).encode()
        return b"".join((_LENGTHS.pack(len(head), len(self.payload)), head, self.payload))

    @classmethod
    def from_parts(cls, head: bytes, payload: bytes) -> "Message":
        """Return the message of a head and a payload; raises ValueError where the head is none."""
        fields = json.loads(head)
        if not isinstance(fields, dict) or not isinstance(fields.get("kind"), str):
            raise ValueError(f"expected a message, got {head[:80]!r}")  # noqa: TRY004 - of any bad content
        return cls(fields.pop("kind"), fields, payload)


def send(pipe: BinaryIO, message: Message) -> None:
    """Write a message and flush."""
    pipe.write(message.to_bytes())
    pipe.flush()


def receive(pipe: BinaryIO) -> Message | None:
    """Read a message; nothing where the other side has closed the pipe."""
    lengths = pipe.read(_LENGTHS.size)
    if len(lengths) < _LENGTHS.size:
        return None
    head, payload = _LENGTHS.unpack(lengths)
    return Message.from_parts(pipe.read(head), pipe.read(payload))


async def read(stream: StreamReader) -> Message:
    """Read a message without holding up the event loop.

    Raises
    ------
    IncompleteReadError
        The other side has closed the pipe.
    ValueError
        What came is no message.
    """
    head, payload = _LENGTHS.unpack(await stream.readexactly(_LENGTHS.size))
    return Message.from_parts(await stream.readexactly(head), await _read_long(stream, payload))


async def _read_long(stream: StreamReader, length: int) -> bytes:
    """Read many bytes in pieces: one piece would be copied again and again."""
    pieces: list[bytes] = []
    missing = length
    while missing:
        piece = await stream.read(min(missing, _CHUNK_BYTES))
        if not piece:
            raise IncompleteReadError(b"".join(pieces), length)
        pieces.append(piece)
        missing -= len(piece)
    return b"".join(pieces)


# ---- works and what comes of them --------------------------------------------------------------------------


def work_message(work: Work) -> Message:
    """Return what asks for a work."""
    return Message("work", {"format": work.format, "stem": work.stem}, work.spec.model_dump_json().encode())


def work_of(message: Message) -> Work:
    """Return the work that is asked for."""
    spec = Spec.model_validate_json(message.payload)
    return Work(spec, FormatName(message.fields["format"]), message.fields["stem"])


def product_message(product: Product) -> Message:
    """Return what brings a product."""
    fields = {
        "id": product.id,
        "files": [[file.suffix, len(file.payload)] for file in product.files],
        "certificate": dict(product.certificate),
        "seconds": product.seconds,
    }
    return Message("product", fields, b"".join(file.payload for file in product.files))


def product_of(message: Message) -> Product:
    """Return the product that is brought."""
    fields = message.fields
    files = tuple(_files(fields["files"], memoryview(message.payload)))
    return Product(fields["id"], files, fields["certificate"], fields["seconds"])


def _files(sizes: list[tuple[str, int]], payload: memoryview) -> Iterator[File]:
    begin = 0
    for suffix, size in sizes:
        yield File(suffix, bytes(payload[begin : begin + size]))
        begin += size


def error_message(error: Exception) -> Message:
    """Return what tells of an error: its class, its text, and its fields; the worker is fit for more."""
    return Message("error", _facts(error))


def fault_message(error: Exception, code: int) -> Message:
    """Return what tells of an error after which the worker is not to be trusted, with OpenCL's code of it."""
    return Message("fault", {**_facts(error), "code": code})


def _facts(error: Exception) -> dict[str, Any]:
    name = next(kind.__name__ for kind in type(error).__mro__ if kind.__name__ in _CLASSES)
    return {"class": name, "text": str(error), "fields": vars(error)}


def error_of(message: Message) -> Exception:
    """Return the error that is told of, of the same class, with the same text and fields.

    Examples
    --------
    >>> told = error_message(SpecError("stack.layers", "1 to 64 layers", "none"))
    >>> error_of(told).expected
    '1 to 64 layers'
    """
    kind = _CLASSES[message.fields["class"]]
    error = kind.__new__(kind, message.fields["text"])
    vars(error).update(message.fields["fields"])
    return error
