"""Long answers as files: bounded in sum, sent piece by piece, and gone afterwards."""

import asyncio
import errno
import fcntl
import io
import os
import shutil
import weakref
from collections.abc import AsyncIterator, Awaitable, Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import IO, cast

from backend.errors import BusyError, CostLimitError
from backend.gate import Budget

MAX_IN_MEMORY = 4 * 1024 * 1024  # an answer that is expected to be longer is written into a file [bytes]
CHUNK = 256 * 1024  # read and sent at once [bytes]
LARGEST_SHARE = 1 / 4  # of the whole space, for one file
LEAST_FREE = 256 * 1024 * 1024  # left on the disk for the database [bytes]

FEWER = "ask for fewer strategies, signals, points or columns"
Work = Callable[[Path | None], Awaitable[bytes]]  # returns a short answer, or writes a long one into that file


class SpoolFile:
    """A file that is removed when it is closed, or nobody refers to it any more.

    Args:
        file: At its beginning.
        held: What is closed with it.
    """

    def __init__(self, file: IO[bytes], held: ExitStack) -> None:
        self._file = file
        self.path = Path(file.name)
        self.close = weakref.finalize(self, held.close)

    @property
    def size(self) -> int:
        """Return its length [bytes]."""
        return os.fstat(self._file.fileno()).st_size

    async def pieces(self) -> AsyncIterator[bytes]:
        """Yield all of it, piece by piece."""
        while piece := await asyncio.to_thread(self._file.read, CHUNK):
            yield piece


class Spool:
    """Files of answers. Each is locked while it is used, so that `clear` knows what a killed service has left.

    Args:
        folder: Where they lie; made when there is one.
        space: How many bytes they may have in all.
    """

    def __init__(self, folder: Path, space: Budget) -> None:
        self._folder = folder
        self._space = space
        self._longest = space.total * LARGEST_SHARE
        self._expected: dict[int, float] = {}  # by descriptor of an open file how long it will be [bytes]

    def clear(self) -> None:
        """Remove the files that no living service uses."""
        for path in self._folder.glob("*"):
            with suppress(OSError), path.open("rb") as file:  # BlockingIOError: it is in use
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                path.unlink()

    @contextmanager
    def reserved(self, client: str, size: float) -> Iterator[Callable[[Work], Awaitable[bytes | SpoolFile]]]:
        """Reserve space for an answer before anything is computed for it; it is freed where the block fails.

        Args:
            client: Who asks.
            size: About how long the answer will be [bytes].

        Yields:
            What has the answer written: returns a short one, or the file that holds a long one.

        Raises:
            CostLimitError, TemporaryError: As `file`; also where the disk is full before all is written.
        """
        file = None if size <= MAX_IN_MEMORY else self.file(client, size)
        with ExitStack() as held, refused_where_full():
            if file is not None:
                held.callback(file.close)
            yield partial(_written, file)
            held.pop_all()

    @contextmanager
    def scratch(self, client: str, size: float) -> Iterator[IO[bytes]]:
        """Memory, or a file, for about so many bytes until the block ends; raises what `file` raises."""
        if size <= MAX_IN_MEMORY:
            yield io.BytesIO()
            return
        file = self.file(client, size)
        with ExitStack() as held, refused_where_full(), file.path.open("r+b") as opened:
            held.callback(file.close)
            yield opened

    def file(self, client: str, size: float, *, advice: str = FEWER) -> SpoolFile:
        """An empty file for about so many bytes.

        Args:
            client: Who asks.
            size: How many.
            advice: What makes it shorter.

        Raises:
            CostLimitError: It would be longer than any may be.
            TemporaryError: Too much is there, by this client or in all, or the disk is full.
        """
        if size > self._longest:
            raise CostLimitError(
                f"A file of about {size / 1e6:.0f} MB would be needed, and the limit is {self._longest / 1e6:.0f} MB: "
                f"{advice}."
            )
        with ExitStack() as held, refused_where_full():
            held.enter_context(self._space.hold(client, size))
            self._folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            if shutil.disk_usage(self._folder).free < size + self._unwritten() + LEAST_FREE:
                raise OSError(errno.ENOSPC, "less is free than the files will need")
            file = held.enter_context(_locked_file(self._folder))
            self._expected[file.fileno()] = size
            held.callback(self._expected.pop, file.fileno())
            return SpoolFile(file, held.pop_all())

    def _unwritten(self) -> float:
        """Return what the open files will still need on the disk [bytes]."""
        return sum(max(0.0, size - os.fstat(number).st_size) for number, size in self._expected.items())


async def _written(file: SpoolFile | None, work: Work) -> bytes | SpoolFile:
    if file is None:
        return await work(None)
    await work(file.path)
    return file


def _locked_file(folder: Path) -> IO[bytes]:
    """A new file with a lock on it; not one that a starting service's `clear` has locked or removed before that."""
    while True:
        file = NamedTemporaryFile(dir=folder, buffering=0)  # noqa: SIM115  # the caller closes it
        with suppress(BlockingIOError):
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if os.fstat(file.fileno()).st_nlink:
                return cast(IO[bytes], file)
        with suppress(FileNotFoundError):  # it is removed already
            file.close()


@contextmanager
def refused_where_full() -> Iterator[None]:
    """Say so where there is no space on the disk.

    Raises:
        BusyError: There is none.
    """
    try:
        yield
    except OSError as error:
        if error.errno not in (errno.ENOSPC, errno.EDQUOT):
            raise
        raise BusyError("The service is full: its disk has no space for long answers.", retry_after=60) from None
