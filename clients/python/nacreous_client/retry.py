"""How often and how long a client waits before it calls again."""

import random
from dataclasses import dataclass

from nacreous_client.errors import ServiceError

__all__ = ["Patience", "Retry"]


@dataclass(frozen=True)
class Retry:
    """What a client does about a service that is busy, unavailable or out of reach.

    Every call may be repeated: a table and a job are named by what is in them, so to ask for one twice is to
    ask for it once.

    Parameters
    ----------
    attempts : int
        How often a call is made at most, while nothing comes of it. 1 repeats none.
    first_s : float
        What is waited before the second attempt; each further wait is twice as long.
    longest_s : float
        What is waited at most. A service that asks to be left alone for longer is not called again.
    """

    attempts: int = 5
    first_s: float = 0.25
    longest_s: float = 30.0

    def backoff_s(self, attempt: int) -> float:
        """Return what is waited after an attempt, counted from 1, where the service does not say.

        >>> [Retry().backoff_s(attempt) for attempt in (1, 2, 3)]
        [0.25, 0.5, 1.0]
        """
        return min(self.first_s * 2.0 ** (attempt - 1), self.longest_s)


class Patience:
    """What is left of the attempts of one call.

    Parameters
    ----------
    retry : Retry
    """

    def __init__(self, retry: Retry) -> None:
        self._retry = retry
        self._attempt = 0

    def renew(self) -> None:
        """Begin to count anew, because something has come of the last attempt."""
        self._attempt = 0

    def pause_s(self, failure: ServiceError) -> float:
        """Return how long to wait after a failure, or raise it where the call is given up.

        Up to a quarter is added by chance, so that clients that were refused together do not come back
        together.
        """
        self._attempt += 1
        if self._attempt >= self._retry.attempts or failure.retry_after_s > self._retry.longest_s:
            raise failure
        wait_s = max(failure.retry_after_s, self._retry.backoff_s(self._attempt))
        return wait_s * (1 + random.random() / 4)  # noqa: S311 - chance, not secrecy
