"""What the service counts, in the text that Prometheus reads; every app has a registry of its own."""

import asyncio
from collections.abc import Iterable, Iterator
from contextlib import suppress
from typing import TYPE_CHECKING

from prometheus_client import CollectorRegistry, Counter, Histogram
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily
from prometheus_client.exposition import CONTENT_TYPE_LATEST, generate_latest
from prometheus_client.metrics_core import Metric
from prometheus_client.registry import Collector

from nacreous.engine.engine import Readiness
from nacreous.errors import StoreError

if TYPE_CHECKING:
    from nacreous.web.service import Service

__all__ = ["CONTENT_TYPE_LATEST", "Metrics", "ServiceCollector"]

_SECONDS = (0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0, 30.0, 60.0)


class Metrics:
    """Requests by method, route and status, and how long they took."""

    def __init__(self) -> None:
        self.registry = CollectorRegistry(auto_describe=False)
        self._requests = Counter(
            "nacreous_requests",
            "Requests answered, by the template of their route.",
            ("method", "route", "status"),
            registry=self.registry,
        )
        self._seconds = Histogram(
            "nacreous_request_seconds",
            "Time from a request's header to the end of its answer.",
            ("route",),
            buckets=_SECONDS,
            registry=self.registry,
        )
        self._known: dict[tuple[str, str, int], tuple[Counter, Histogram]] = {}

    def observe(self, method: str, route: str, status: int, seconds: float) -> None:
        """Count one request."""
        key = (method, route, status)
        if key not in self._known:
            counter = self._requests.labels(method, route, str(status))
            self._known[key] = counter, self._seconds.labels(route)
        counter, histogram = self._known[key]
        counter.inc()
        histogram.observe(seconds)

    async def text(self) -> bytes:
        """Return all of it; the store's size may have to be asked for far away, so in a thread."""
        return await asyncio.to_thread(generate_latest, self.registry)


class ServiceCollector(Collector):
    """Reads the counters of the library, the engine and the store when they are asked for."""

    def __init__(self, service: "Service") -> None:
        self._service = service

    def describe(self) -> Iterable[Metric]:
        """Return nothing: names do not depend on what is collected."""
        return ()

    def collect(self) -> Iterator[Metric]:
        """Yield every figure."""
        yield from self._library()
        yield from self._engine()
        yield from self._store()

    def _library(self) -> Iterator[Metric]:
        library = self._service.library
        hits = CounterMetricFamily("nacreous_library_hits", "Files found, and where.", labels=["place"])
        hits.add_metric(["memory"], library.hits_memory)
        hits.add_metric(["store"], library.hits_store)
        yield hits
        yield CounterMetricFamily("nacreous_library_misses", "Files found nowhere.", value=library.misses)
        yield CounterMetricFamily(
            "nacreous_library_coalesced",
            "Requests that waited for another's computation.",
            value=library.coalesced,
        )
        yield CounterMetricFamily(
            "nacreous_library_uncached", "Files that the store could not keep.", value=library.uncached
        )

    def _engine(self) -> Iterator[Metric]:
        engine = self._service.engine
        state = GaugeMetricFamily(
            "nacreous_engine_state", "1 for the state that the engine is in.", labels=["state"]
        )
        for readiness in Readiness:
            state.add_metric([readiness.value], float(engine.state.readiness is readiness))
        yield state
        yield CounterMetricFamily("nacreous_engine_restarts", "Workers replaced.", value=engine.restarts)
        yield CounterMetricFamily("nacreous_engine_computed", "Works computed.", value=engine.computed)
        yield GaugeMetricFamily("nacreous_engine_queued", "Works that wait.", value=engine.queued)
        yield GaugeMetricFamily("nacreous_engine_busy", "Works being computed.", value=engine.busy)

    def _store(self) -> Iterator[Metric]:
        store = self._service.store
        yield CounterMetricFamily(
            "nacreous_store_evicted", "Entries removed to make room.", value=store.evicted
        )
        yield CounterMetricFamily(
            "nacreous_store_quarantined", "Damaged entries put aside.", value=store.quarantined
        )
        size = GaugeMetricFamily("nacreous_store_bytes", "Bytes that the store holds.")
        with suppress(StoreError):  # a store that cannot be read has no size; /readyz says why
            size.add_metric([], store.size_bytes())
        yield size
