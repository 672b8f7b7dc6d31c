"""The two clients: one blocks, the other is awaited; what they can do is in `nacreous_client.operations`."""

import asyncio
import time
from collections.abc import Callable
from contextlib import closing
from functools import partial
from typing import Self, TypeVar

import httpx

from nacreous_client.errors import UnreachableError, without_user_info
from nacreous_client.operations import Operations
from nacreous_client.retry import Retry
from nacreous_client.steps import CONTENT, AwaitedRunner, BlockingRunner, Pause, Reply, Request, Steps

__all__ = ["AsyncClient", "Client"]

T = TypeVar("T")


class Client(Operations, BlockingRunner):
    """A service; calls return when they are done.

    Safe to be used from several threads. To be closed, or used as a context.
    """

    def __init__(self, url: str, key: str | None = None, retry: Retry | None = None) -> None:
        super().__init__(url, key, retry)
        self._http = httpx.Client(**self._options)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Close the connections."""
        self._http.close()

    def run(self, steps: Steps[T]) -> T:
        """Return what a call returns; raises what it raises."""
        with closing(steps):
            resume: Callable[[], Request | Pause] = partial(next, steps)
            try:
                while True:
                    resume = self._taken(steps, resume())
            except StopIteration as end:
                return end.value  # type: ignore[no-any-return]

    def _taken(self, steps: Steps[T], step: Request | Pause) -> Callable[[], Request | Pause]:
        if isinstance(step, Pause):
            time.sleep(step.seconds)
            return partial(next, steps)
        try:
            return partial(steps.send, self._sent(step))
        except Exception as error:  # noqa: BLE001 - the call says what is done about it
            return partial(steps.throw, _failure(error, self.address))

    def _sent(self, request: Request) -> Reply:
        url = self.address + request.path
        with self._http.stream(
            request.method, url, headers=request.headers, content=request.body or None
        ) as response:
            intake = _Intake(request, response)
            for chunk in response.iter_bytes():
                if not intake.feed(chunk):
                    break
        return intake.reply()


class AsyncClient(Operations, AwaitedRunner):
    """A service; calls are awaited under asyncio. Files are written as they arrive, without a thread.

    To be closed, or used as a context.
    """

    def __init__(self, url: str, key: str | None = None, retry: Retry | None = None) -> None:
        super().__init__(url, key, retry)
        self._http = httpx.AsyncClient(**self._options)

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.close()

    async def close(self) -> None:
        """Close the connections."""
        await self._http.aclose()

    async def run(self, steps: Steps[T]) -> T:
        """Return what a call returns; raises what it raises."""
        with closing(steps):
            resume: Callable[[], Request | Pause] = partial(next, steps)
            try:
                while True:
                    resume = await self._taken(steps, resume())
            except StopIteration as end:
                return end.value  # type: ignore[no-any-return]

    async def _taken(self, steps: Steps[T], step: Request | Pause) -> Callable[[], Request | Pause]:
        if isinstance(step, Pause):
            await asyncio.sleep(step.seconds)
            return partial(next, steps)
        try:
            return partial(steps.send, await self._sent(step))
        except Exception as error:  # noqa: BLE001 - the call says what is done about it
            return partial(steps.throw, _failure(error, self.address))

    async def _sent(self, request: Request) -> Reply:
        url = self.address + request.path
        async with self._http.stream(
            request.method, url, headers=request.headers, content=request.body or None
        ) as response:
            intake = _Intake(request, response)
            async for chunk in response.aiter_bytes():
                if not intake.feed(chunk):
                    break
        return intake.reply()


class _Intake:
    """Takes an answer: into the request's receiver, if there is one and the answer has what it is for."""

    def __init__(self, request: Request, response: httpx.Response) -> None:
        self._response = response
        self._receiver = request.receiver if response.status_code in CONTENT else None
        self._body = bytearray()
        if self._receiver is not None:
            self._receiver.begin(response.status_code, response.headers)

    def feed(self, chunk: bytes) -> bool:
        """Take bytes; tell whether more are wanted."""
        if self._receiver is not None:
            return self._receiver.feed(chunk)
        self._body += chunk
        return True

    def reply(self) -> Reply:
        """Return the answer."""
        return Reply(self._response.status_code, self._response.headers, bytes(self._body))


def _failure(error: Exception, address: str) -> Exception:
    """Return what a failure of the connection is to the caller; any other as it is."""
    if not isinstance(error, httpx.HTTPError):
        return error
    reason = str(error) or type(error).__name__
    unreached = isinstance(error, (httpx.ConnectError, httpx.ConnectTimeout))
    place = without_user_info(address)
    return UnreachableError(
        address, f"cannot reach {place}: {reason}" if unreached else f"{place} broke off: {reason}"
    )
