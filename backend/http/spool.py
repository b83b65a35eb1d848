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
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import IO

from backend.errors import BusyError, CostLimitError
from backend.http.limits import ConcurrencyLimit, FairLimit

SHORT = 4 * 1024 * 1024  # what is expected to be no longer stays in memory [bytes]
PIECE = 256 * 1024  # read and sent at once [bytes]
SHARE = 4  # the longest answer is that part of all that may be there
MOST_OF_CLIENT, MOST = 48, 128  # files
LEAST_FREE = 256 * 1024 * 1024  # left on the disk for the database [bytes]


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
        """Its length [bytes]."""
        return os.fstat(self._file.fileno()).st_size

    async def pieces(self) -> AsyncIterator[bytes]:
        """All of it, piece by piece."""
        while piece := await asyncio.to_thread(self._file.read, PIECE):
            yield piece


class Spool:
    """Files of answers. Each is locked while it is used, so that `clear` knows what a killed service has left.

    Args:
        folder: Where they lie; made when there is one.
        limit: About how much there may be in all [bytes]; clients share it fairly.
    """

    def __init__(self, folder: Path, limit: int) -> None:
        self._folder = folder
        self._longest = limit // SHARE
        self._bytes = FairLimit(what="space for long answers", total=limit)
        self._files = ConcurrencyLimit(what="long answers", per_client=MOST_OF_CLIENT, total=MOST)

    def clear(self) -> None:
        """Remove the files that no living service uses."""
        for path in self._folder.glob("*"):
            with suppress(OSError), path.open("rb") as file:  # BlockingIOError: it is in use
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                path.unlink()

    async def render(
        self, client: str, size: float, work: Callable[[Path | None], Awaitable[bytes]]
    ) -> bytes | SpoolFile:
        """What `work` renders.

        Args:
            client: Who asks.
            size: About how long it will be [bytes].
            work: Returns a short answer, or writes a long one into the file of that path.

        Raises:
            CostLimitError, TemporaryError: As `file`; also where the disk is full before all is written.
        """
        if size <= SHORT:
            return await work(None)
        file = self.file(client, size)
        with ExitStack() as held, refused_where_full():
            held.callback(file.close)
            await work(file.path)
            held.pop_all()
        return file

    @contextmanager
    def scratch(self, client: str, size: float) -> Iterator[IO[bytes]]:
        """Memory, or a file, for about so many bytes until the block ends; raises what `file` raises."""
        if size <= SHORT:
            yield io.BytesIO()
            return
        file = self.file(client, size)
        with ExitStack() as held, refused_where_full(), file.path.open("r+b") as opened:
            held.callback(file.close)
            yield opened

    def file(self, client: str, size: float) -> SpoolFile:
        """An empty file for about so many bytes.

        Raises:
            CostLimitError: It would be longer than any may be.
            TemporaryError: Too much is there, by this client or in all, or the disk is full.
        """
        if size > self._longest:
            raise CostLimitError(
                f"The answer would have about {size / 1e6:.0f} MB, and the limit is {self._longest / 1e6:.0f} MB: ask "
                "for fewer strategies, signals, points or columns."
            )
        with ExitStack() as held, refused_where_full():
            held.enter_context(self._files.acquired(client))
            held.enter_context(self._bytes.acquired(client, size))
            self._folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            if shutil.disk_usage(self._folder).free < size + LEAST_FREE:
                raise OSError(errno.ENOSPC, "less is free than the answer needs")
            file = held.enter_context(NamedTemporaryFile(dir=self._folder, buffering=0))
            fcntl.flock(file, fcntl.LOCK_EX)
            return SpoolFile(file, held.pop_all())


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
