"""What engines with one queue have in common."""

from nacreous.engine.turns import Turns

__all__ = ["QueuedEngine"]


class QueuedEngine:
    """An engine whose works take turns, and which counts them.

    Parameters
    ----------
    queue_length : int
        Works that may wait beside the one in hand.

    Attributes
    ----------
    computed, restarts : int
        Works done, and workers that have been replaced.
    """

    def __init__(self, queue_length: int) -> None:
        self._turns = Turns(queue_length)
        self.computed = self.restarts = 0

    @property
    def queued(self) -> int:
        """Works that wait."""
        return self._turns.queued

    @property
    def busy(self) -> int:
        """Works in hand: 0 or 1."""
        return self._turns.busy
