"""What both engines promise: the same files as without one, errors as they are, a bounded queue."""

import asyncio
from collections.abc import Callable

import pytest

from nacreous.engine.engine import Engine, Readiness
from nacreous.engine.in_process import InProcessEngine
from nacreous.engine.work import Work, compute
from nacreous.engine.worker_engine import WorkerEngine, WorkerSettings
from nacreous.errors import BudgetError, BusyError, DeadlineError, SpecError, UnavailableError
from nacreous.formats.names import FormatName
from nacreous.tables.presets import preset
from worker_engines import begun, film_work, long_work, patiently, started

QUEUE_LENGTH = 2
Made = InProcessEngine | WorkerEngine


def in_process() -> InProcessEngine:
    """Return an engine that computes in this process."""
    return InProcessEngine(queue_length=QUEUE_LENGTH)


def with_worker() -> WorkerEngine:
    """Return an engine that computes in a process of its own."""
    return WorkerEngine(WorkerSettings(queue_length=QUEUE_LENGTH))


every_engine = pytest.mark.parametrize("make", [in_process, with_worker])


@every_engine
def test_a_product_is_that_of_a_plain_computation(make: Callable[[], Made]) -> None:
    """Files are the same, byte for byte, wherever they are computed; a stem is kept, and progress is told."""
    work = Work(preset("soap-bubble", ["table.cos_theta=16"]), FormatName.MATERIALX, "bubble")
    told: list[float] = []

    async def asked() -> None:
        engine: Engine = make()
        assert engine.state.readiness is Readiness.STOPPED
        await engine.start()
        product = await engine.compute(work, told.append)
        assert engine.state.readiness is Readiness.READY
        await engine.stop()
        plain = compute(work)
        assert product.files == plain.files
        assert (product.id, product.certificate) == (plain.id, plain.certificate)
        assert b"bubble.exr" in product.files[0].payload

    patiently(asked())
    assert told == sorted(told)


@every_engine
def test_errors_arrive_as_they_were_raised(make: Callable[[], Made], monkeypatch: pytest.MonkeyPatch) -> None:
    """A budget is exceeded, and an observer's name unknown, in the same words and with the same fields."""
    monkeypatch.setenv("NACREOUS_BYTE_BUDGET", "20k")
    unknown = Work(preset("soap-bubble", ["colour.observer=nobody"]), FormatName.EXR)

    async def asked() -> None:
        async with started(make()) as engine:
            for work, kind in ((film_work(size=64), BudgetError), (unknown, SpecError)):
                with pytest.raises(kind) as plain:
                    compute(work)
                with pytest.raises(kind) as told:
                    await engine.compute(work)
                assert str(told.value) == str(plain.value)
                assert vars(told.value) == vars(plain.value)
            assert (engine.computed, engine.restarts) == (0, 0)

    patiently(asked())


@every_engine
def test_who_comes_when_the_queue_is_full_is_told_to_come_again(make: Callable[[], Made]) -> None:
    """At most the queue's length waits; the rest hears so at once, and nothing of theirs is begun."""

    async def asked() -> None:
        async with started(make()) as engine:
            works = [film_work(400.0 + number) for number in range(5)]
            answers = await asyncio.gather(*(map(engine.compute, works)), return_exceptions=True)
            refused = [answer for answer in answers if isinstance(answer, BusyError)]
            assert len(refused) == len(works) - QUEUE_LENGTH - 1
            assert all(busy.retry_after_s >= 1 for busy in refused)
            assert engine.computed == QUEUE_LENGTH + 1

    patiently(asked())


@every_engine
def test_who_is_gone_holds_up_nobody(make: Callable[[], Made]) -> None:
    """A caller that is cancelled while it waits gives up its place; one whose work is in hand, its answer."""

    async def asked() -> None:
        async with started(make()) as engine:
            in_hand = await begun(engine, long_work())
            waits, stays = (asyncio.create_task(engine.compute(film_work(t))) for t in (410.0, 411.0))
            await asyncio.sleep(0)
            assert (engine.busy, engine.queued) == (1, 2)
            waits.cancel()
            in_hand.cancel()
            await asyncio.wait([waits, in_hand])
            assert (engine.busy, engine.queued) == (1, 1)
            await stays
            assert (engine.busy, engine.queued, engine.computed) == (0, 0, 2)

    patiently(asked())


@every_engine
def test_a_stop_finishes_what_is_in_hand_and_refuses_what_waits(make: Callable[[], Made]) -> None:
    """Stopping is graceful: begun work is answered, waiting work and later work is refused."""

    async def asked() -> None:
        engine = make()
        await engine.start()
        in_hand = await begun(engine, long_work())
        waits = asyncio.create_task(engine.compute(film_work()))
        await asyncio.sleep(0)
        stopping = asyncio.create_task(engine.stop())
        with pytest.raises(UnavailableError):
            await waits
        assert not in_hand.done()
        assert (await in_hand).files
        await stopping
        assert engine.state.readiness is Readiness.STOPPED
        with pytest.raises(UnavailableError):
            await engine.compute(film_work())

    patiently(asked())


@every_engine
def test_a_drained_engine_ends_what_it_has_begun_and_takes_nothing_new(make: Callable[[], Made]) -> None:
    """Draining does not wait: what waits and what comes is refused, what is in hand is answered in full."""

    async def asked() -> None:
        async with started(make()) as engine:
            in_hand = await begun(engine, long_work())
            waits = asyncio.create_task(engine.compute(film_work()))
            await asyncio.sleep(0)
            engine.drain()
            assert engine.state.readiness is Readiness.STOPPED
            for refused in (waits, engine.compute(film_work())):
                with pytest.raises(UnavailableError):
                    await refused
            assert not in_hand.done()
            assert (await in_hand).files

    patiently(asked())


@every_engine
def test_who_waits_beyond_its_deadline_is_told_to_come_again(make: Callable[[], Made]) -> None:
    """Its turn must come within the time that the work may take; what is in hand goes on."""

    async def asked() -> None:
        async with started(make()) as engine:
            in_hand = await begun(engine, long_work())
            with pytest.raises(BusyError, match="takes very long"):
                await engine.compute(film_work(), deadline_s=1e-9)
            assert (engine.busy, engine.queued, in_hand.done()) == (1, 0, False)
            assert (await in_hand).files

    patiently(asked())


def hurried_in_process() -> InProcessEngine:
    """Return an engine in this process whose own deadline no work can keep."""
    return InProcessEngine(deadline_s=1e-9)


def hurried_with_worker() -> WorkerEngine:
    """Return an engine with a worker, whose own deadline no work can keep."""
    return WorkerEngine(WorkerSettings(deadline_s=1e-9))


@pytest.mark.parametrize("make", [hurried_in_process, hurried_with_worker])
def test_a_deadline_of_its_own_comes_before_the_engine_s(make: Callable[[], Made]) -> None:
    """A work that brings its deadline is computed within that; one that brings none, within the engine's."""

    async def asked() -> None:
        async with started(make()) as engine:
            with pytest.raises(DeadlineError, match="longer than 1e-09 s"):
                await engine.compute(film_work())
            assert (await engine.compute(film_work(), deadline_s=60.0)).files
            with pytest.raises(DeadlineError, match="longer than 2e-09 s"):
                await engine.compute(film_work(421.0), deadline_s=2e-9)

    patiently(asked())


def test_a_deadline_in_this_process_is_kept_between_tiles() -> None:
    """What takes too long is ended between two tiles, and the next work is done."""

    async def asked() -> None:
        async with started(InProcessEngine(deadline_s=0.0)) as engine:
            with pytest.raises(DeadlineError):
                await engine.compute(film_work())
            assert engine.busy == 0

    patiently(asked())
