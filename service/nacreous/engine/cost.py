"""What a work costs, estimated before anything is begun."""

from nacreous.engine.work import Work

__all__ = ["estimated_seconds"]


def estimated_seconds(work: Work) -> float:
    """Return about how long a work takes on two cores with AVX-512: rather too long than too short."""
    raise NotImplementedError
