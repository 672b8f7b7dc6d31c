"""What a call is made of, so that one definition serves blocking and awaited clients.

A call is a generator. It yields a `Request` and is sent the `Reply`, or has the failure raised in it; it
yields a `Pause` and goes on after it. Who runs it does the waiting: `Client` blocks, `AsyncClient` awaits.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Coroutine, Generator, Mapping
from dataclasses import dataclass, field
from functools import wraps
from http import HTTPStatus
from typing import Any, Concatenate, Generic, ParamSpec, Protocol, Self, TypeVar, overload

__all__ = [
    "CONTENT",
    "AwaitedRunner",
    "BlockingRunner",
    "Operation",
    "Pause",
    "Receiver",
    "Reply",
    "Request",
    "Steps",
]

P = ParamSpec("P")
T = TypeVar("T")

Headers = Mapping[str, str]
"""Names are found in any case."""

CONTENT = (HTTPStatus.OK, HTTPStatus.PARTIAL_CONTENT)
"""The answers that receivers are for; any other is a document of its own."""


class Receiver(Protocol):
    """Takes the body of an answer while it arrives."""

    def begin(self, status: int, headers: Headers) -> None:
        """Take note of what is about to arrive."""
        ...

    def feed(self, chunk: bytes) -> bool:
        """Take some bytes; tell whether more are wanted."""
        ...


@dataclass(frozen=True)
class Request:
    """A request.

    Parameters
    ----------
    method, path : str
        The path begins with a slash and is below the service's address.
    headers : mapping
    body : bytes
    receiver : Receiver, optional
        Takes the body of an answer 200 or 206; that of any other, or without one, is in the `Reply`.
    """

    method: str
    path: str
    headers: Headers = field(default_factory=dict)
    body: bytes = b""
    receiver: Receiver | None = None

    def __post_init__(self) -> None:
        if not self.path.startswith("/"):  # what would be put to the address might become another one
            raise ValueError(f"expected a path of the service, which begins with /, got {self.path!r}")


@dataclass(frozen=True)
class Pause:
    """A time to wait."""

    seconds: float


@dataclass(frozen=True)
class Reply:
    """An answer: its status, its headers, and its body unless a receiver has it."""

    status: int
    headers: Headers
    body: bytes = b""


Steps = Generator[Request | Pause, Any, T]
"""A call that ends with a T."""


class BlockingRunner(ABC):
    """Carries out calls and returns when they are done."""

    @abstractmethod
    def run(self, steps: Steps[T]) -> T:
        """Return what the call returns; raises what it raises."""


class AwaitedRunner(ABC):
    """Carries out calls while others are carried out as well."""

    @abstractmethod
    async def run(self, steps: Steps[T]) -> T:
        """Return what the call returns; raises what it raises."""


class Operation(Generic[P, T]):
    """A method, written once as steps: it blocks on a `BlockingRunner` and is awaited on an `AwaitedRunner`.

    Parameters
    ----------
    steps : callable
        The method as a generator function.
    """

    def __init__(self, steps: Callable[Concatenate[Any, P], Steps[T]]) -> None:
        self._steps = steps
        self.__doc__ = steps.__doc__

    @overload
    def __get__(self, runner: None, owner: type) -> Self: ...

    @overload
    def __get__(self, runner: BlockingRunner, owner: type) -> Callable[P, T]: ...

    @overload
    def __get__(self, runner: AwaitedRunner, owner: type) -> Callable[P, Coroutine[Any, Any, T]]: ...

    def __get__(self, runner: BlockingRunner | AwaitedRunner | None, owner: type) -> Any:
        if runner is None:
            return self

        @wraps(self._steps)
        def call(*arguments: P.args, **options: P.kwargs) -> Any:  # noqa: ANN401 - a T or a coroutine of it
            return runner.run(self._steps(runner, *arguments, **options))

        return call
