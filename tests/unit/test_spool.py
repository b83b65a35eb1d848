"""Long answers lie in files whose sum is bounded, and nothing is left of them."""

import errno
import fcntl
import io
import shutil
import subprocess
import sys
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import IO

import orjson
import pytest

from backend.batches.table import ColumnPages
from backend.errors import BusyError, CostLimitError, TooManyRequestsError
from backend.gate.budget import Budget
from backend.http import spool
from backend.http.spool import MAX_IN_MEMORY, Spool, SpoolFile
from backend.pieces import render_to, write_json
from tests.servers import loops
from tests.servers.process import HANG_TIMEOUT, ROOT

MEGABYTE = 1_000_000
LONG = MAX_IN_MEMORY + 1
OTHER = """
import sys, time
from pathlib import Path
from backend.gate.budget import Budget
from backend.http.spool import Spool
file = Spool(Path(sys.argv[1]), Budget("space", 1e9)).file("one", 5)
file.path.write_bytes(b"begun")
print("there", flush=True)
time.sleep(1000)
"""


async def told(content: bytes, path: Path | None) -> bytes:
    return render_to(lambda file: file.write(content), path)


def rendering(spool: Spool, content: bytes, size: float, client: str = "one") -> bytes | SpoolFile:
    async def rendered() -> bytes | SpoolFile:
        with spool.reserved(client, size) as write:
            return await write(partial(told, content))

    return loops.run(rendered)


def read(file: SpoolFile) -> bytes:
    async def pieces() -> bytes:
        return b"".join([piece async for piece in file.pieces()])

    return loops.run(pieces)


def long_answer(spool: Spool, size: float = LONG, client: str = "one") -> SpoolFile:
    file = rendering(spool, b"text", size, client)
    assert isinstance(file, SpoolFile)
    return file


def test_a_short_answer_stays_in_memory(tmp_path: Path) -> None:
    folder = tmp_path / "spool"
    assert rendering(Spool(folder, Budget("space", 100 * MEGABYTE)), b"short", MAX_IN_MEMORY) == b"short"
    assert not folder.exists()


def test_a_long_one_lies_in_a_file_until_it_is_closed_or_forgotten(tmp_path: Path) -> None:
    folder = tmp_path / "spool"
    content = bytes(range(256)) * 4000
    spool = Spool(folder, Budget("space", 100 * MEGABYTE))
    for end in (lambda file: file.close(), lambda _: None):
        file = rendering(spool, content, LONG)
        assert isinstance(file, SpoolFile)
        assert file.size == len(content)
        assert read(file) == content
        assert list(folder.iterdir()) == [file.path]
        end(file)
        del file
        assert not list(folder.iterdir())


def test_a_second_attempt_leaves_nothing_of_the_first(tmp_path: Path) -> None:
    file = tmp_path / "answer"
    file.write_bytes(b"a worker died in the middle of a longer one")
    assert render_to(lambda opened: opened.write(b"again"), file) == b""
    assert file.read_bytes() == b"again"
    with pytest.raises(FileNotFoundError):  # a file that is gone is not made again: nobody would remove it
        render_to(lambda _: None, tmp_path / "gone")


def test_the_sum_is_bounded_and_shared(tmp_path: Path) -> None:
    spool = Spool(tmp_path, Budget("space", 100 * MEGABYTE))
    with pytest.raises(CostLimitError, match="30 MB would be needed, and the limit is 25 MB: ask for fewer"):
        long_answer(spool, 30 * MEGABYTE)
    with pytest.raises(CostLimitError, match="limit is 25 MB: a shorter road"):
        spool.file("one", 30 * MEGABYTE, advice="a shorter road")
    held = [long_answer(spool, 25 * MEGABYTE) for _ in range(2)]
    with pytest.raises(TooManyRequestsError):
        long_answer(spool, 1 * MEGABYTE + LONG)
    others = [long_answer(spool, 25 * MEGABYTE, "two") for _ in range(2)]
    with pytest.raises(BusyError):
        long_answer(spool, 25 * MEGABYTE, "three")
    held.pop().close()
    long_answer(spool, 25 * MEGABYTE, "three").close()
    assert len(list(tmp_path.iterdir())) == 3
    for other in others:
        other.close()


def test_a_failure_leaves_nothing_and_a_full_disk_is_said(tmp_path: Path) -> None:
    spooled = Spool(tmp_path, Budget("space", 100 * MEGABYTE))

    async def fails(error: Exception) -> None:
        async def work(path: Path | None) -> bytes:
            assert path is not None
            assert list(tmp_path.iterdir()) == [path]
            raise error

        with spooled.reserved("one", LONG) as write:
            await write(work)

    for error, raised in (
        (OSError(errno.ENOSPC, "No space left on device"), BusyError),
        (OSError(errno.EIO, "Input/output error"), OSError),
        (ValueError("a bug"), ValueError),
    ):
        with pytest.raises(raised):
            loops.run(partial(fails, error))
        assert not list(tmp_path.iterdir())


def test_files_that_are_not_written_yet_count_on_the_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    size, spooled = 8 * MEGABYTE, Spool(tmp_path, Budget("space", 100 * MEGABYTE))
    free = spool.LEAST_FREE + 1.5 * size
    monkeypatch.setattr(shutil, "disk_usage", lambda _: SimpleNamespace(free=free))
    first = spooled.file("one", size)
    with pytest.raises(BusyError, match="disk"):
        spooled.file("two", size)
    first.path.write_bytes(bytes(size))  # now it is the disk that knows
    spooled.file("two", size).close()
    first.path.write_bytes(b"")
    first.close()
    spooled.file("two", size).close()


@pytest.mark.parametrize("removed", [False, True])
def test_a_file_that_a_starting_service_takes_for_a_dead_ones_is_given_up(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, removed: bool
) -> None:
    """Between its creation and its lock the other one has locked it, or removed it already."""
    locks, others = [], []

    def flock(file: IO[bytes], operation: int) -> None:
        locks.append(operation)
        if len(locks) == 1:
            (path,) = tmp_path.iterdir()
            others.append(path.open("rb"))
            real(others[0], fcntl.LOCK_EX)
            if removed:
                path.unlink()
                others[0].close()
        real(file, operation | fcntl.LOCK_NB)

    real = fcntl.flock
    monkeypatch.setattr(fcntl, "flock", flock)
    file = Spool(tmp_path, Budget("space", 100 * MEGABYTE)).file("one", LONG)
    others[0].close()
    assert list(tmp_path.iterdir()) == [file.path]
    assert all(operation & fcntl.LOCK_NB for operation in locks), "the event loop does not wait"
    file.close()
    assert not list(tmp_path.iterdir())


def test_what_a_killed_service_left_is_removed_and_nothing_else(tmp_path: Path) -> None:
    command = [sys.executable, "-c", OTHER, str(tmp_path)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, cwd=ROOT) as other:
        try:
            assert other.stdout is not None
            assert other.stdout.readline() == b"there\n"
            spool = Spool(tmp_path, Budget("space", 100 * MEGABYTE))
            own = long_answer(spool)
            spool.clear()
            assert len(list(tmp_path.iterdir())) == 2, "both are in use"
        finally:
            other.kill()
            other.wait(HANG_TIMEOUT)
    spool.clear()
    assert list(tmp_path.iterdir()) == [own.path]


def test_functions_in_json_are_called_one_after_the_other() -> None:
    called = []

    def later(value: object) -> object:
        called.append(value)
        return {"value": value, "none": {}}

    content = {"a": partial(later, 1), "b": [1, {"c": "ü"}], "d": {"e": partial(later, 2)}, "f": {}}
    sink = io.BytesIO()
    write_json(content, sink)
    assert orjson.loads(sink.getvalue()) == {
        "a": {"value": 1, "none": {}},
        "b": [1, {"c": "ü"}],
        "d": {"e": {"value": 2, "none": {}}},
        "f": {},
    }
    assert called == [1, 2]


@pytest.mark.parametrize("pages", [0, 1, 3])
def test_pages_become_columns(tmp_path: Path, pages: int) -> None:
    names, file = ["run", "reason"], tmp_path / "answer"
    file.touch()
    columns = ColumnPages(names, io.BytesIO())
    for page in range(pages):
        columns.add([orjson.dumps([page, -page])[1:-1], b'null,"a,b"'])
    expected = {
        "batch": "b",
        "columns": {
            "run": [value for page in range(pages) for value in (page, -page)],
            "reason": [None, "a,b"] * pages,
        },
    }
    assert orjson.loads(columns.assembled({"batch": "b"}, None)) == expected
    columns.assembled({"batch": "b"}, file)
    assert orjson.loads(file.read_bytes()) == expected
