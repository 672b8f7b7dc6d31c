"""Calls of both clients, each against a server of its own that answers as it is told."""

import asyncio
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from nacreous_client import AsyncClient, Client, Retry

from answering_server import AnsweringServer, answering

QUICK = Retry(attempts=3, first_s=0.001)


@pytest.fixture
def server() -> Iterator[AnsweringServer]:
    """Run the server."""
    with answering() as running:
        yield running


def _blocking(address: str, method: str, *arguments: object, **options: Any) -> object:  # noqa: ANN401 - of a Client
    with Client(address, **{"retry": QUICK, **options}) as service:
        return getattr(service, method)(*arguments)


def _awaited(address: str, method: str, *arguments: object, **options: Any) -> object:  # noqa: ANN401 - of a Client
    async def call() -> object:
        async with AsyncClient(address, **{"retry": QUICK, **options}) as service:
            return await getattr(service, method)(*arguments)

    return asyncio.run(call())


@pytest.fixture(params=[_blocking, _awaited], ids=["blocking", "awaited"])
def call(request: pytest.FixtureRequest) -> Callable[..., Any]:
    """Return what calls a method of one of the two clients, by its name."""
    return request.param
