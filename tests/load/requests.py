"""A client that costs as little as it can: prepared bytes out, and answers counted by their length."""

import socket
import time
from collections.abc import Mapping

import httpx

__all__ = ["KeptConnection", "requests_per_second"]

CONNECTIONS = 8
"""Requests that are under way at a time, so that the server is never idle."""


class KeptConnection:
    """One connection on which one request is sent again and again."""

    def __init__(self, url: str, headers: Mapping[str, str], status: int) -> None:
        parsed = httpx.URL(url)
        lines = [f"GET {parsed.raw_path.decode()} HTTP/1.1", f"Host: {parsed.host}"]
        lines += [f"{name}: {value}" for name, value in headers.items()]
        self._request = ("\r\n".join(lines) + "\r\n\r\n").encode()
        self._expected = f"HTTP/1.1 {status} ".encode()
        self._socket = socket.create_connection((parsed.host, parsed.port or 80))
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._buffer = bytearray(2**20)
        self.received = 0

    def send(self) -> None:
        """Send the request."""
        self._socket.sendall(self._request)

    def receive(self) -> None:
        """Take the whole answer; raises `AssertionError` where it has another status."""
        head, view = b"", memoryview(self._buffer)
        while (end := head.find(b"\r\n\r\n")) < 0:
            count = self._socket.recv_into(view)
            assert count, "the connection was closed"
            head += view[:count]
        assert head.startswith(self._expected), head[:200]
        remaining = _length(head[:end]) - (len(head) - end - 4)
        self.received = _length(head[:end])
        while remaining > 0:
            remaining -= self._socket.recv_into(view)

    def close(self) -> None:
        """Close the connection."""
        self._socket.close()


def _length(head: bytes) -> int:
    for line in head.split(b"\r\n"):
        name, _, value = line.partition(b":")
        if name.lower() == b"content-length":
            return int(value)
    return 0


def requests_per_second(url: str, seconds: float, headers: Mapping[str, str], status: int = 200) -> float:
    """Ask for the same again and again for a while."""
    connections = [KeptConnection(url, headers, status) for _ in range(CONNECTIONS)]
    try:
        for connection in connections:
            connection.send()
        count, began = 0, time.perf_counter()
        while (elapsed := time.perf_counter() - began) < seconds:
            for connection in connections:
                connection.receive()
                connection.send()
            count += len(connections)
        for connection in connections:
            connection.receive()
        return count / elapsed
    finally:
        for connection in connections:
            connection.close()
