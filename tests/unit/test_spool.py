"""Long answers lie in files whose sum is bounded, and nothing is left of them."""

import errno
import io
import shutil
import subprocess
import sys
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import orjson
import pytest

from backend.errors import BusyError, CostLimitError, TooManyRequestsError
from backend.http import spool
from backend.http.spool import MOST_OF_CLIENT, SHORT, Spool, SpoolFile
from backend.jobs.sweep.table import ColumnPages
from backend.pieces import rendered, write_json
from tests.servers import loops
from tests.servers.process import HANG_TIMEOUT, ROOT

MEGABYTE = 1_000_000
LONG = SHORT + 1
OTHER = """
import sys, time
from pathlib import Path
from backend.http.spool import Spool
file = Spool(Path(sys.argv[1]), 10**9).file("one", 5)
file.path.write_bytes(b"begun")
print("there", flush=True)
time.sleep(1000)
"""


async def told(content: bytes, path: Path | None) -> bytes:
    return rendered(lambda file: file.write(content), path)


def rendering(spool: Spool, content: bytes, size: float, client: str = "one") -> bytes | SpoolFile:
    return loops.run(lambda: spool.render(client, size, partial(told, content)))


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
    assert rendering(Spool(folder, 100 * MEGABYTE), b"short", SHORT) == b"short"
    assert not folder.exists()


def test_a_long_one_lies_in_a_file_until_it_is_closed_or_forgotten(tmp_path: Path) -> None:
    folder = tmp_path / "spool"
    content = bytes(range(256)) * 4000
    spool = Spool(folder, 100 * MEGABYTE)
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
    assert rendered(lambda opened: opened.write(b"again"), file) == b""
    assert file.read_bytes() == b"again"
    with pytest.raises(FileNotFoundError):  # a file that is gone is not made again: nobody would remove it
        rendered(lambda _: None, tmp_path / "gone")


def test_the_sum_is_bounded_and_shared(tmp_path: Path) -> None:
    spool = Spool(tmp_path, 100 * MEGABYTE)
    with pytest.raises(CostLimitError, match="30 MB, and the limit is 25 MB: ask for fewer"):
        long_answer(spool, 30 * MEGABYTE)
    held = [long_answer(spool, 25 * MEGABYTE) for _ in range(4)]
    with pytest.raises(TooManyRequestsError):
        long_answer(spool, 25 * MEGABYTE)
    other = long_answer(spool, 25 * MEGABYTE, "two")  # whose turn is not over
    held.pop().close()
    assert len(list(tmp_path.iterdir())) == 4
    other.close()


def test_too_many_files_are_refused(tmp_path: Path) -> None:
    spool = Spool(tmp_path, 10_000 * MEGABYTE)
    held = [long_answer(spool) for _ in range(MOST_OF_CLIENT)]
    with pytest.raises(TooManyRequestsError):
        long_answer(spool)
    del held
    assert not list(tmp_path.iterdir())


def test_a_failure_leaves_nothing_and_a_full_disk_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    spooled = Spool(tmp_path, 100 * MEGABYTE)

    async def fails(error: Exception, _: Path | None) -> bytes:
        raise error

    for error, raised in (
        (OSError(errno.ENOSPC, "No space left on device"), BusyError),
        (OSError(errno.EIO, "Input/output error"), OSError),
        (ValueError("a bug"), ValueError),
    ):
        with pytest.raises(raised):
            loops.run(partial(spooled.render, "one", LONG, partial(fails, error)))
        assert not list(tmp_path.iterdir())
    monkeypatch.setattr(shutil, "disk_usage", lambda _: SimpleNamespace(free=spool.LEAST_FREE))
    with pytest.raises(BusyError, match="disk"):
        long_answer(spooled)


def test_what_a_killed_service_left_is_removed_and_nothing_else(tmp_path: Path) -> None:
    command = [sys.executable, "-c", OTHER, str(tmp_path)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, cwd=ROOT) as other:
        try:
            assert other.stdout is not None
            assert other.stdout.readline() == b"there\n"
            spool = Spool(tmp_path, 100 * MEGABYTE)
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
