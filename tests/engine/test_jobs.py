"""Jobs with real parts: every table is made or named, and no process has to live to the end."""

import asyncio
from pathlib import Path

import pytest

from nacreous.engine.files import table_key
from nacreous.engine.in_process import InProcessEngine
from nacreous.engine.job import JOBS, Manifest, manifest_key
from nacreous.engine.jobs import Job, JobLimits, JobState
from nacreous.engine.sweep import Sweep
from nacreous.engine.work import Product, Work, compute
from nacreous.errors import BusyError, MissingError, SpecError, UnavailableError
from nacreous.opencl.tiles import Observer
from small_library import Rooms, ended, opened, small_spec, small_sweep, small_work

TOO_THICK_NM = 5e6
"""Of a layer whose fringes no quadrature resolves: found out where its colour is computed."""


async def _done(rooms: Rooms, sweep: Sweep) -> Job:
    return await ended(rooms.jobs, (await rooms.jobs.add(sweep)).id)


async def _under_way(rooms: Rooms, job_id: str, tables: int = 1) -> None:
    """Return when so many tables of a job are finished."""
    async for job in rooms.jobs.events(job_id):
        if job.done >= tables:
            return


def test_a_job_makes_every_file_of_its_sweep(tmp_path: Path) -> None:
    """Each table in each format, the bytes that the work has by itself; the job has their names."""
    sweep = small_sweep(3, ("exr", "npz"))

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            await rooms.jobs.start()
            job = await _done(rooms, sweep)
            assert (job.state, job.done, job.total, job.failed) == (JobState.DONE, 3, 3, 0)
            works = [work for index in range(3) for work in sweep[index]]
            assert list(job.files) == [work.id + work.target.suffix for work in works]
            assert list(job.tables) == [sweep[index][0].id for index in range(3)]
            for work in works:
                stored = rooms.store.get(table_key(work.id, work.target.suffix))
                assert stored is not None
                assert stored.payload == compute(work).files[0].payload
                assert (await rooms.library.record(work.id)).spec == small_spec().model_copy(
                    update={"stack": work.spec.stack, "name": "", "description": "", "source": ""}
                )

    asyncio.run(test())


def test_a_job_is_added_once(tmp_path: Path) -> None:
    """Under way or done, the same sweep is the same job, in this process and the next."""

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            waiting = await rooms.jobs.add(small_sweep(2))
            assert await rooms.jobs.add(small_sweep(2)) == waiting
            await rooms.jobs.start()
            done = await ended(rooms.jobs, waiting.id)
            assert await rooms.jobs.add(small_sweep(2)) == done
        async with opened(tmp_path) as rooms:
            await rooms.jobs.start()
            assert await rooms.jobs.add(small_sweep(2)) == await rooms.jobs.get(waiting.id) == done
            assert [job async for job in rooms.jobs.events(done.id)] == [done]
            assert rooms.engine.computed == 0

    asyncio.run(test())


def test_tables_that_cannot_be_made_are_named_and_the_rest_goes_on(tmp_path: Path) -> None:
    """One film is too thick for a colour: the job is done, and says which and why."""
    document = {
        "base": small_spec().model_dump(mode="json"),
        "formats": ["exr"],
        "vary": {"stack.layers.0.thickness_nm": [100, TOO_THICK_NM, 120]},
    }

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            await rooms.jobs.start()
            job = await _done(rooms, Sweep.from_document(document))
            assert (job.state, job.done, job.failed) == (JobState.DONE, 2, 1)
            assert [failure.spec for failure in job.failures] == [1]
            works = [Sweep.from_document(document)[spec][0] for spec in job.specs]
            assert (job.specs, job.tables) == ((0, 2), tuple(work.id for work in works))
            assert job.failures[0].message.startswith("stack.layers: expected fringes that")
            document["vary"] = {"stack.layers.0.thickness_nm": [TOO_THICK_NM]}
            job = await _done(rooms, Sweep.from_document(document))
            assert (job.state, job.done, job.failed) == (JobState.FAILED, 0, 1)
            assert job.error == job.failures[0].message

    asyncio.run(test())


def test_a_cancelled_job_ends_and_stays_so(tmp_path: Path) -> None:
    """What is finished stays, what is not is not begun, in the next process neither; until it is added."""
    sweep = small_sweep(40)

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            await rooms.jobs.start()
            job_id = (await rooms.jobs.add(sweep)).id
            await _under_way(rooms, job_id)
            cancelled = await rooms.jobs.cancel(job_id)
            assert (cancelled.state, cancelled.done < 40) == (JobState.CANCELLED, True)
            assert await ended(rooms.jobs, job_id) == cancelled
            assert await rooms.jobs.cancel(job_id) == cancelled
        assert rooms.engine.computed <= cancelled.done + 1
        async with opened(tmp_path) as rooms:
            await rooms.jobs.start()
            assert await rooms.jobs.get(job_id) == cancelled
            job = await _done(rooms, sweep)
            assert (job.state, job.done) == (JobState.DONE, 40)
            assert rooms.engine.computed >= 38 - cancelled.done

    asyncio.run(test())


def test_a_table_in_hand_is_given_up_with_its_job(tmp_path: Path) -> None:
    """What waits for the engine when its job is cancelled is never computed, and others go on."""

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            await rooms.engine.stop()
            await rooms.jobs.start()
            left = await rooms.jobs.add(small_sweep(3, ("npz",)))
            async for job in rooms.jobs.events(left.id):
                if job.state is JobState.RUNNING:
                    break
            await rooms.jobs.cancel(left.id)
            await rooms.engine.start()
            assert (await _done(rooms, small_sweep(2))).done == 2
            assert rooms.engine.computed == 2

    asyncio.run(test())


def test_a_job_can_be_cancelled_in_another_process(tmp_path: Path) -> None:
    """Several servers share one store: the one that computes finds it in the manifest."""

    async def test() -> None:
        async with opened(tmp_path) as works, opened(tmp_path) as other:
            await works.jobs.start()
            job_id = (await works.jobs.add(small_sweep(2_000))).id
            await _under_way(works, job_id)
            await other.jobs.cancel(job_id)
            assert (await ended(works.jobs, job_id)).state is JobState.CANCELLED
            assert (await ended(other.jobs, job_id)).state is JobState.CANCELLED

    asyncio.run(test())


def test_a_stopped_job_goes_on_in_the_next_process(tmp_path: Path) -> None:
    """Nothing is made twice, and nothing is left out."""

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            await rooms.jobs.start()
            job_id = (await rooms.jobs.add(small_sweep(20))).id
            watching = asyncio.create_task(ended(rooms.jobs, job_id))
            await _under_way(rooms, job_id, 3)
        assert not (await watching).ended
        before = rooms.engine.computed
        async with opened(tmp_path) as rooms:
            await rooms.jobs.start()
            job = await ended(rooms.jobs, job_id)
            assert (job.state, job.done) == (JobState.DONE, 20)
            assert before + rooms.engine.computed == 20

    asyncio.run(test())


def test_a_full_store_stops_a_job_that_can_go_on_later(tmp_path: Path) -> None:
    """It fails with the store's reason; with more room the next process, or the next who adds it, ends it."""
    sweep = small_sweep(3)

    async def test() -> None:
        async with opened(tmp_path, quota_bytes=100) as rooms:
            await rooms.jobs.start()
            job = await _done(rooms, sweep)
            assert (job.state, job.done) == (JobState.FAILED, 0)
            assert "quota" in job.error
            assert "quota" in (await _done(rooms, sweep)).error
            assert list(rooms.store.keys("tables/")) == []
        async with opened(tmp_path) as rooms:
            await rooms.jobs.start()
            assert (await ended(rooms.jobs, job.id)).state is JobState.DONE

    asyncio.run(test())


def test_the_last_state_is_never_lost(tmp_path: Path) -> None:
    """Who reads slowly misses what was in between; every reader sees progress only grow, and the end."""

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            await rooms.jobs.start()
            slow = rooms.jobs.events((await rooms.jobs.add(small_sweep(5))).id)
            first = await anext(slow)
            quick = [job async for job in rooms.jobs.events(first.id)]
            rest = [job async for job in slow]
            assert rest == quick[-1:]
            assert quick[-1].state is JobState.DONE
            assert [job.done for job in quick] == sorted(job.done for job in quick)
            fractions = [job.fraction for job in quick]
            assert fractions == sorted(fractions)
            assert (fractions[0], fractions[-1]) == (0, 1)

    asyncio.run(test())


def test_jobs_take_turns(tmp_path: Path) -> None:
    """A small job does not wait for the end of a large one."""

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            large = await rooms.jobs.add(small_sweep(60))
            await rooms.jobs.start()
            small = await _done(rooms, Sweep.of(small_spec("anodised-titanium"), ["exr"]))
            assert small.state is JobState.DONE
            assert not (await rooms.jobs.get(large.id)).ended

    asyncio.run(test())


def test_one_table_of_all_jobs_is_in_the_engines_queue(tmp_path: Path) -> None:
    """With a queue of one, requests are never refused because of jobs."""

    async def test() -> None:
        async with opened(tmp_path, engine=InProcessEngine(queue_length=1)) as rooms:
            await rooms.jobs.start()
            ids = [(await rooms.jobs.add(small_sweep(count))).id for count in (4, 5, 6)]
            for place in range(5):
                work = small_work(name="anodised-titanium", overrides=[f"table.cos_theta={place + 10}"])
                assert (await rooms.library.file(work)).payload
            jobs = [await ended(rooms.jobs, job_id) for job_id in ids]
            assert [job.state for job in jobs] == [JobState.DONE] * 3

    asyncio.run(test())


def test_a_table_of_a_job_has_the_deadline_of_jobs(tmp_path: Path) -> None:
    """Nobody waits for it as for a request: the engine's own deadline, which no table keeps, is not its."""

    async def test() -> None:
        for limits, state in ((JobLimits(), JobState.DONE), (JobLimits(deadline_s=2e-9), JobState.FAILED)):
            async with opened(
                tmp_path / state, limits=limits, engine=InProcessEngine(deadline_s=1e-9)
            ) as rooms:
                await rooms.jobs.start()
                job = await _done(rooms, small_sweep(1))
                assert job.state is state
                assert ("2e-09 s" in job.error) == (state is JobState.FAILED)

    asyncio.run(test())


def test_jobs_and_their_manifests_are_bounded(tmp_path: Path) -> None:
    """So many wait, so many manifests of ended ones are kept, and so many tables are in one."""
    limits = JobLimits(tables=3, waiting=2, kept=2)

    async def test() -> None:
        async with opened(tmp_path, limits=limits) as rooms:
            with pytest.raises(SpecError, match="at most 3 tables"):
                await rooms.jobs.add(small_sweep(4))
            ids = [(await rooms.jobs.add(small_sweep(count))).id for count in (1, 2)]
            with pytest.raises(BusyError):
                await rooms.jobs.add(small_sweep(3))
            await rooms.jobs.start()
            for job_id in ids:
                await ended(rooms.jobs, job_id)
            ids.append((await _done(rooms, small_sweep(3))).id)
            ids.append((await _done(rooms, small_sweep(2, ("npz",)))).id)
            await rooms.jobs.stop()
            kept = {key.removeprefix(JOBS) for key in rooms.store.keys(JOBS)}
            assert kept == set(ids[-2:])
            with pytest.raises(MissingError):
                await rooms.jobs.get(ids[0])

    asyncio.run(test())


def test_a_manifest_of_another_version_ends(tmp_path: Path) -> None:
    """Its tables would have other ids: it is told to be sent again; what is no manifest is left alone."""

    async def test() -> None:
        old = "ab" * 32
        async with opened(tmp_path) as rooms:
            job = await rooms.jobs.add(small_sweep(2))
            manifest = rooms.store.get(manifest_key(job.id))
            assert manifest is not None
            document = Manifest.from_entry(manifest).document
            past = Job(old, JobState.QUEUED, 2, job.created)
            rooms.store.put(manifest_key(old), Manifest(past, document).to_entry())
            rooms.store.put(JOBS + "cd" * 32, type(manifest)({}, b'{"job": {}}'))
            rooms.store.put(JOBS + "notes", type(manifest)({}, b"not a manifest"))
        async with opened(tmp_path) as rooms:
            await rooms.jobs.start()
            assert (await ended(rooms.jobs, job.id)).state is JobState.DONE
            assert "version" in (await rooms.jobs.get(old)).error

    asyncio.run(test())


def test_what_is_no_job_is_missing(tmp_path: Path) -> None:
    """Ids that are none never reach the store's paths."""

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            for job_id in ("ab" * 32, "../secret", "", "AB" * 32):
                for ask in (rooms.jobs.get, rooms.jobs.cancel, lambda name: anext(rooms.jobs.events(name))):
                    with pytest.raises(MissingError):
                        await ask(job_id)

    asyncio.run(test())


class RefusingEngine(InProcessEngine):
    """Notes that it has refused a table so often that a ready engine would be given up."""

    def __init__(self) -> None:
        super().__init__()
        self.refused, self.has_refused = 0, asyncio.Event()

    async def compute(
        self, work: Work, observer: Observer | None = None, deadline_s: float | None = None
    ) -> Product:
        """Compute, or note that it cannot be."""
        try:
            return await super().compute(work, observer, deadline_s)
        except UnavailableError:
            self.refused += 1
            if self.refused == 4:
                self.has_refused.set()
            raise


def test_an_engine_that_is_not_ready_is_waited_for(tmp_path: Path) -> None:
    """A job that is resumed before the engine has started loses no table to that, however long it takes."""

    async def test() -> None:
        engine = RefusingEngine()
        async with opened(tmp_path, engine=engine) as rooms:
            await engine.stop()
            await rooms.jobs.start()
            running = asyncio.create_task(_done(rooms, small_sweep(2)))
            await engine.has_refused.wait()
            await engine.start()
            job = await running
            assert (job.done, job.failed) == (2, 0)

    asyncio.run(test())
