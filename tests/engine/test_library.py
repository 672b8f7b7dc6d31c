"""The library with real parts: memory, a store in a folder, an engine that computes."""

import asyncio
from pathlib import Path

import pytest

from nacreous.engine.files import file_key, table_key
from nacreous.errors import MissingError, SpecError, StoreError
from nacreous.formats.names import FormatName
from nacreous.formats.registry import write
from nacreous.tables.spec import LABELS
from nacreous.tables.tabulate import tabulate_table
from small_library import Rooms, opened, small_spec, small_work, together
from worker_engines import long_work

COMPANION = ".transmission.exr"


def test_a_file_is_computed_once_then_kept(tmp_path: Path) -> None:
    """Engine, then memory; in another process the store; each time the bytes that `write` makes."""
    (path, _) = write(tabulate_table(small_spec()), tmp_path / "film.exr")

    async def first() -> None:
        async with opened(tmp_path / "store") as rooms:
            computed, remembered = (
                await rooms.library.file(small_work()),
                await rooms.library.file(small_work()),
            )
            assert computed is remembered
            assert computed.payload == path.read_bytes()
            assert (rooms.library.misses, rooms.library.hits_memory, rooms.engine.computed) == (1, 1, 1)

    async def second() -> None:
        async with opened(tmp_path / "store") as rooms:
            assert (await rooms.library.file(small_work())).payload == path.read_bytes()
            assert (rooms.library.hits_store, rooms.engine.computed) == (1, 0)

    asyncio.run(first())
    asyncio.run(second())


def test_a_companion_is_stored_with_its_file(tmp_path: Path) -> None:
    """The texture of what is transmitted comes of the same computation."""

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            own = await rooms.library.file(small_work())
            companion = await rooms.library.file(small_work(), COMPANION)
            assert own.facts["files"] == [".exr", COMPANION]
            assert (companion.facts["suffix"], companion.facts["format"]) == (COMPANION, "exr")
            assert companion.payload != own.payload
            assert rooms.engine.computed == 1
            assert rooms.store.has(file_key(small_work(), COMPANION))

    asyncio.run(test())


def test_a_companion_that_there_is_not_costs_no_computation(tmp_path: Path) -> None:
    """Titanium transmits nothing, and its file in the store says so."""
    opaque = small_work(name="anodised-titanium")

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            with pytest.raises(MissingError, match="transmission"):
                await rooms.library.file(opaque, COMPANION)
            assert rooms.engine.computed == 1
            for ask in (
                rooms.library.file(opaque, COMPANION),
                rooms.library.table_file(opaque.id, COMPANION),
            ):
                with pytest.raises(MissingError, match="transmission"):
                    await ask
            assert rooms.engine.computed == 1

    asyncio.run(test())


def test_documents_of_different_stems_share_their_texture(tmp_path: Path) -> None:
    """A MaterialX document names the texture beside it; the texture is the table's own EXR."""

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            named = await rooms.library.file(small_work(FormatName.MATERIALX, "figure-3"))
            plain = await rooms.library.file(small_work(FormatName.MATERIALX))
            assert b'"figure-3.exr"' in named.payload
            assert f'"{small_work().id}.exr"'.encode() in plain.payload
            texture = await rooms.library.file(small_work())
            assert rooms.engine.computed == 2
        (path, _) = write(tabulate_table(small_spec()), tmp_path / "film.exr")
        assert texture.payload == path.read_bytes()

    asyncio.run(test())


def _damage(rooms: Rooms, folder: Path, key: str) -> None:
    path = folder / key
    assert rooms.store.has(key)
    stored = bytearray(path.read_bytes())
    stored[-5] ^= 1
    path.write_bytes(stored)


def test_a_damaged_entry_is_computed_again_once(tmp_path: Path) -> None:
    """One bit is found out, set aside and mended; nobody sees the bad bytes."""

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            good = (await rooms.library.file(small_work())).payload
            _damage(rooms, tmp_path, file_key(small_work()))
        for _ in range(2):
            async with opened(tmp_path) as rooms:
                assert (await rooms.library.file(small_work())).payload == good
                computed, quarantined = rooms.engine.computed, rooms.store.quarantined
                yield_to.append((computed, quarantined))

    yield_to: list[tuple[int, int]] = []
    asyncio.run(test())
    assert yield_to == [(1, 1), (0, 0)]


def test_what_cannot_be_stored_is_answered(tmp_path: Path) -> None:
    """A quota that holds no file is like a full disk: the answer is right, counted, and in memory."""

    async def test() -> None:
        async with opened(tmp_path, quota_bytes=10) as rooms:
            first = await rooms.library.file(small_work())
            assert await rooms.library.file(small_work()) is first
            assert (rooms.library.uncached, rooms.engine.computed) == (1, 1)
            assert list(rooms.store.keys("tables/")) == []
            assert (await rooms.library.record(small_work().id)).certificate == first.facts["certificate"]

    asyncio.run(test())


def test_a_store_that_cannot_be_reached_is_one_that_has_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where nobody listens at the S3 endpoint, tables are computed, answered and counted."""
    monkeypatch.setenv("AWS_ENDPOINT_URL", "http://127.0.0.1:9")
    monkeypatch.setenv("AWS_ACCESS_KEY_ID", "nobody")
    monkeypatch.setenv("AWS_SECRET_ACCESS_KEY", "nothing")
    monkeypatch.setenv("AWS_MAX_ATTEMPTS", "1")

    async def test() -> None:
        async with opened("s3://nowhere/store") as rooms:
            with pytest.raises(StoreError):
                await rooms.library.record(small_work().id)
            assert not await rooms.library.holds(small_work())
            assert (await rooms.library.file(small_work())).payload
            assert rooms.library.uncached == 1

    asyncio.run(test())


def test_a_spec_is_added_once(tmp_path: Path) -> None:
    """A spec and its certificate are kept, without its labels; what differs in labels alone is known."""

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            added = await rooms.library.add(small_spec(overrides=['name="mine"']))
            again = await rooms.library.add(small_spec(overrides=['name="yours"']))
            assert (added.created, again.created) == (True, False)
            assert added.id == again.id == small_work().id
            assert added.certificate == (await rooms.library.file(small_work())).facts["certificate"]
        async with opened(tmp_path) as rooms:
            record = await rooms.library.record(added.id)
            assert record.spec == small_spec().model_copy(update=dict.fromkeys(LABELS, ""))
            assert record.certificate == added.certificate

    asyncio.run(test())


def test_a_spectrum_without_colour_is_added_as_npz(tmp_path: Path) -> None:
    """Wavelengths that span no colour make no texture."""
    ultraviolet = small_spec("silica-on-silicon", ["table.wavelength_nm=[300, 340, 380]"])

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            added = await rooms.library.add(ultraviolet)
            assert rooms.store.has(table_key(added.id, ".npz"))
            with pytest.raises(SpecError):
                await rooms.library.table_file(added.id, ".exr")

    asyncio.run(test())


def test_an_evicted_file_is_computed_from_its_record(tmp_path: Path) -> None:
    """A link stays good as long as the record is there: the same bytes come again, in any format."""

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            added = await rooms.library.add(small_spec())
            texture = (await rooms.library.file(small_work())).payload
            rooms.store.delete(table_key(added.id, ".exr"))
        async with opened(tmp_path) as rooms:
            assert (await rooms.library.table_file(added.id, ".exr")).payload == texture
            assert (await rooms.library.table_file(added.id, ".csv")).facts["format"] == "csv"
            assert rooms.engine.computed == 2
            rooms.store.delete(table_key(added.id, ".spec"))
        async with opened(tmp_path) as rooms:
            assert (await rooms.library.table_file(added.id, ".exr")).payload == texture
            with pytest.raises(MissingError, match="send its spec"):
                await rooms.library.table_file(added.id, ".png")
            assert rooms.engine.computed == 0

    asyncio.run(test())


def test_a_record_that_has_gone_comes_back_with_its_spec(tmp_path: Path) -> None:
    """Whoever asks with the spec at hand mends what eviction has taken."""

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            added = await rooms.library.add(small_spec())
            rooms.store.delete(table_key(added.id, ".spec"))
        async with opened(tmp_path) as rooms:
            await rooms.library.file(small_work())
            assert (await rooms.library.record(added.id)).certificate == added.certificate
            assert rooms.engine.computed == 0

    asyncio.run(test())


def test_the_record_outlives_the_files_of_its_table(tmp_path: Path) -> None:
    """Eviction takes a table's files first: its record is the last that was used."""
    *tables, another = [
        small_work(overrides=[f"stack.layers.0.thickness_nm={nm}"]) for nm in range(100, 170, 10)
    ]

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            for work in tables:
                await rooms.library.file(work)
            size = rooms.store.size_bytes()
        async with opened(tmp_path, quota_bytes=size) as rooms:
            for work in tables:
                await rooms.library.file(work)
            assert rooms.library.hits_store == len(tables)
            await rooms.library.file(another)
            kept = set(rooms.store.keys("tables/"))
            assert any(file_key(work) not in kept for work in tables)
            for work in tables:
                assert table_key(work.id, ".spec") in kept or file_key(work) not in kept

    asyncio.run(test())


def test_what_is_no_table_is_missing(tmp_path: Path) -> None:
    """Ids and suffixes that are none never reach the store's paths."""
    unknown = "ab" * 32

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            for table_id in (unknown, "../../etc/passwd", "", unknown.upper(), unknown + "0"):
                with pytest.raises(MissingError):
                    await rooms.library.record(table_id)
            for suffix in (".exr", ".foo", "/../x.exr", ".other.exr", ""):
                with pytest.raises(MissingError):
                    await rooms.library.table_file(unknown, suffix)
            assert rooms.engine.computed == 0

    asyncio.run(test())


def test_what_is_held_need_not_be_computed(tmp_path: Path) -> None:
    """In memory or in the store, a companion by its own name; a store that cannot be read holds nothing."""

    async def test() -> None:
        opaque = small_work(name="anodised-titanium")
        async with opened(tmp_path) as rooms:
            assert not await rooms.library.holds(small_work())
            await rooms.library.keep(small_work())
            await rooms.library.file(opaque)
            assert [await rooms.library.holds(small_work(), each) for each in ("", COMPANION)] == [True, True]
            assert [await rooms.library.holds(opaque, each) for each in ("", COMPANION)] == [True, False]
            assert not await rooms.library.holds(small_work(FormatName.NPZ))
            rooms.store.delete(file_key(opaque))
            assert await rooms.library.holds(opaque)
        async with opened(tmp_path) as rooms:
            assert await rooms.library.holds(small_work(), COMPANION)
            assert not await rooms.library.holds(opaque)

    asyncio.run(test())


def test_a_record_of_another_version_is_no_table(tmp_path: Path) -> None:
    """Where kernels or data have changed, the same spec has another id: nothing is passed off as the old."""

    async def test() -> None:
        old = "cd" * 32
        async with opened(tmp_path) as rooms:
            added = await rooms.library.add(small_spec())
            rooms.store.put(table_key(old, ".spec"), rooms.store.get(table_key(added.id, ".spec")))
            with pytest.raises(MissingError, match="version"):
                await rooms.library.table_file(old, ".exr")

    asyncio.run(test())


async def _all_asked(asked: list[asyncio.Task[object]]) -> None:
    """Return when every task has come to its first wait."""
    del asked
    await asyncio.sleep(0)


@pytest.mark.parametrize("begun", [False, True])
def test_one_of_200_cold_requests_that_stays_is_answered(tmp_path: Path, begun: bool) -> None:  # noqa: FBT001 - a case
    """199 of 200 go away, before the kernel runs or while it does: one run, and the last is answered."""

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            at_work = asyncio.Event()
            work = small_work()
            assert work.id  # known from here on, so that all of them ask in the same turn of the loop
            asked = [asyncio.create_task(rooms.library.file(work)) for _ in range(200)]
            await _all_asked(asked)
            if begun:
                watching = asyncio.create_task(rooms.library.keep(small_work(), lambda _: at_work.set()))
                await at_work.wait()
                watching.cancel()
            *leaving, staying = asked
            for task in leaving:
                task.cancel()
            assert (await staying).facts["id"] == small_work().id
            gone = await together(*leaving)
            assert all(isinstance(result, asyncio.CancelledError) for result in gone)
        assert (rooms.engine.computed, rooms.library.misses) == (1, 1)

    asyncio.run(test())


def test_what_all_have_left_is_finished_and_kept(tmp_path: Path) -> None:
    """A client that lost patience finds its table when it asks again."""

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            at_work = asyncio.Event()
            asked = asyncio.create_task(rooms.library.keep(small_work(), lambda _: at_work.set()))
            await at_work.wait()
            asked.cancel()
            await together(asked)
            await rooms.library.settle()
            assert rooms.store.has(file_key(small_work()))
            assert (await rooms.library.file(small_work())).payload
            assert (rooms.library.hits_store, rooms.engine.computed) == (1, 1)

    asyncio.run(test())


def test_what_waits_for_its_turn_is_given_up_with_its_last_caller(tmp_path: Path) -> None:
    """Requests that were left do not fill the engine's queue."""
    first, left = long_work(), small_work(name="anodised-titanium")

    async def test() -> None:
        async with opened(tmp_path) as rooms:
            at_work = asyncio.Event()
            keeping = asyncio.create_task(rooms.library.keep(first, lambda _: at_work.set()))
            await at_work.wait()
            asked = asyncio.create_task(rooms.library.file(left))
            while not rooms.engine.queued:
                await asyncio.sleep(0)
            asked.cancel()
            await together(keeping, asked)
            await rooms.library.settle()
            assert not rooms.store.has(file_key(left))

    asyncio.run(test())
