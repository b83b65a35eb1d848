"""Long answers lie in files whose sum is bounded, and nothing is left of them."""

import errno
import subprocess
import sys
from functools import partial
from pathlib import Path

import pytest

from backend.errors import BusyError
from backend.gate import Budget
from backend.http.spool import MAX_IN_MEMORY, Spool, SpoolFile
from backend.pieces import render_to
from tests.servers import loops
from tests.servers.process import HANG_TIMEOUT, ROOT

MEGABYTE = 1_000_000
LONG = MAX_IN_MEMORY + 1
OTHER = """
import sys, time
from pathlib import Path
from backend.gate import Budget
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
