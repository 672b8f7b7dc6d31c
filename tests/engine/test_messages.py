"""Whatever crosses the pipe between supervisor and worker arrives as it was."""

import asyncio
import io

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nacreous.engine.messages import (
    Message,
    error_message,
    error_of,
    product_message,
    product_of,
    read,
    receive,
    send,
    work_message,
    work_of,
)
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
from nacreous.formats.registry import FORMATS
from nacreous.tables.presets import preset, preset_names

ERRORS = (
    BudgetError("a table", 2**40, 2**31),
    DeviceError("no device"),
    FileFormatError("no such channel"),
    MissingError("no transmission"),
    NumericalError("R + T is 1.2"),
    SpecError("stack.layers.0", "a layer", '"ångström"', "see the manual"),
    StoreError("the disk is full"),
    RuntimeError("KeyError: 'x'"),
)


def through_pipe(message: Message) -> Message:
    """Return what the worker reads of what the supervisor has sent, and that again the other way."""
    pipe = io.BytesIO()
    send(pipe, message)
    pipe.seek(0)
    received = receive(pipe)
    assert received is not None
    return asyncio.run(_read(b"".join(received.pieces())))


async def _read(data: bytes) -> Message:
    stream = asyncio.StreamReader()
    stream.feed_data(data)
    stream.feed_eof()
    return await read(stream)


@given(st.dictionaries(st.text(), st.floats(allow_nan=False) | st.text()), st.lists(st.binary()))
@settings(max_examples=50, deadline=None)
def test_a_message_arrives_as_it_was_sent(fields: dict[str, object], payloads: list[bytes]) -> None:
    """Fields keep every bit of their numbers, and bytes are bytes."""
    sent = Message("any", fields, tuple(payloads))
    assert through_pipe(sent) == sent


@pytest.mark.parametrize("error", ERRORS, ids=lambda error: type(error).__name__)
def test_an_error_arrives_with_its_class_text_and_fields(error: Exception) -> None:
    """What web and command line make of an error does not depend on the process that raised it."""
    told = error_of(through_pipe(error_message(error)))
    assert (type(told), str(told), vars(told)) == (type(error), str(error), vars(error))


def test_an_error_of_a_derived_class_arrives_as_its_base() -> None:
    """A class that the other side does not know crosses as the nearest one that it does."""

    class FigureError(NumericalError):
        """An error of a class of its own."""

    assert type(error_of(through_pipe(error_message(FigureError("no"))))) is NumericalError


@pytest.mark.parametrize("name", preset_names())
def test_a_work_arrives_with_the_same_id(name: str) -> None:
    """The spec's JSON has every digit: what the worker computes has the id that was asked for."""
    spec = preset(name)
    work = Work(spec, FormatName.NPZ if spec.table.quantity != "bsdf" else FormatName.EXR, "a/stem")
    told = work_of(through_pipe(work_message(work)))
    assert (told, told.id) == (work, work.id)


def test_every_format_has_a_name_that_crosses() -> None:
    """The registry's formats are all named by what the message carries."""
    assert {FormatName(str(name)) for name in FORMATS} == set(FORMATS)


def test_a_product_arrives_file_by_file() -> None:
    """Files are told apart by their lengths, empty ones too."""
    files = (File(".exr", b"one"), File(".transmission.exr", b""), File(".mtlx", bytes(range(256))))
    product = Product("ab" * 32, files, {"worst": 1.25e-7, "mean": None}, 0.25)
    assert product_of(through_pipe(product_message(product))) == product


@pytest.mark.parametrize("cut", [0, 3, 12, 20, -1])
def test_half_a_message_is_the_end(cut: int) -> None:
    """A pipe that is closed within a message is seen to be closed."""
    data = b"".join(Message("product", {"id": "ab"}, (b"payload",)).pieces())[:cut]
    with pytest.raises(EOFError):
        asyncio.run(_read(data))


@pytest.mark.parametrize("head", [b"[]", b"{}", b'{"kind": 1}', b"nothing", b"\xff"])
def test_a_head_that_is_none_is_refused(head: bytes) -> None:
    """What is no object of JSON with a kind is an error, and never run."""
    with pytest.raises(ValueError, match=r".*"):
        asyncio.run(_read(len(head).to_bytes(4, "big") + head))
