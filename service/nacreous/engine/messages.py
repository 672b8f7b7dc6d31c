"""What the supervisor and its worker say to each other, over two pipes.

A message is the length of its head (4 bytes, big-endian), the head, which is an object of JSON, and raw
bytes, whose lengths the head has. Nothing is pickled: reading what came over the pipe runs no code.
"""

import json
import struct
from asyncio import IncompleteReadError, StreamReader
from collections.abc import Mapping
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

_LENGTH = struct.Struct(">I")
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
    """What is said: its kind, further fields fit for JSON, and pieces of raw bytes."""

    kind: str
    fields: Mapping[str, Any]
    payloads: tuple[bytes, ...] = ()

    def pieces(self) -> tuple[bytes, ...]:
        """Return what goes through the pipe, piece after piece: a file of many megabytes is not copied."""
        head = {
            "kind": self.kind,
            "fields": dict(self.fields),
            "lengths": [len(each) for each in self.payloads],
        }
        text = json.dumps(head, separators=(",", ":")).encode()
        return (_LENGTH.pack(len(text)), text, *self.payloads)


def send(pipe: BinaryIO, message: Message) -> None:
    """Write a message and flush."""
    for piece in message.pieces():
        pipe.write(piece)
    pipe.flush()


def receive(pipe: BinaryIO) -> Message | None:
    """Read a message; nothing where the other side has closed the pipe."""
    length = pipe.read(_LENGTH.size)
    if len(length) < _LENGTH.size:
        return None
    kind, fields, lengths = _parsed(pipe.read(*_LENGTH.unpack(length)))
    return Message(kind, fields, tuple(pipe.read(size) for size in lengths))


async def read(stream: StreamReader) -> Message:
    """Read a message without holding up the event loop.

    Raises
    ------
    EOFError
        The other side has closed the pipe.
    ValueError
        What came is no message.
    """
    (length,) = _LENGTH.unpack(await stream.readexactly(_LENGTH.size))
    kind, fields, lengths = _parsed(await stream.readexactly(length))
    return Message(kind, fields, tuple([await _read_long(stream, size) for size in lengths]))


def _parsed(text: bytes) -> tuple[str, dict[str, Any], list[int]]:
    """Return the parts of a head; raises ValueError where it is none."""
    try:
        head = json.loads(text)
        return head["kind"], head["fields"], head["lengths"]
    except (KeyError, TypeError) as error:
        raise ValueError(f"expected the head of a message, got {text[:80]!r}") from error


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
    spec = work.spec.model_dump_json().encode()
    return Message("work", {"format": work.format, "stem": work.stem}, (spec,))


def work_of(message: Message) -> Work:
    """Return the work that is asked for."""
    spec = Spec.model_validate_json(*message.payloads)
    return Work(spec, FormatName(message.fields["format"]), message.fields["stem"])


def product_message(product: Product) -> Message:
    """Return what brings a product."""
    fields = {
        "id": product.id,
        "suffixes": [file.suffix for file in product.files],
        "certificate": dict(product.certificate),
        "seconds": product.seconds,
    }
    return Message("product", fields, tuple(file.payload for file in product.files))


def product_of(message: Message) -> Product:
    """Return the product that is brought."""
    fields = message.fields
    files = tuple(map(File, fields["suffixes"], message.payloads))
    return Product(fields["id"], files, fields["certificate"], fields["seconds"])


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
