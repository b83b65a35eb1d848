"""Tells coroutines of this process that something was committed; commits of other processes are seen by polling."""

import asyncio
import contextlib
import threading


class CommitCounter:
    """Counts commits; safe for several threads and event loops."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._count = 0
        self._waiting: set[asyncio.Future[None]] = set()

    @property
    def count(self) -> int:
        """Commits so far."""
        return self._count

    def notify(self) -> None:
        """Count a commit; callable from any thread."""
        with self._lock:
            self._count += 1
            waiting, self._waiting = self._waiting, set()
        for future in waiting:
            with contextlib.suppress(RuntimeError):  # its event loop has ended
                future.get_loop().call_soon_threadsafe(_wake, future)

    async def wait_beyond(self, count: int, timeout: float) -> None:
        """Wait for more than `count` commits, at most `timeout` [s]."""
        future = asyncio.get_running_loop().create_future()
        with self._lock:
            if self._count > count:
                return
            self._waiting.add(future)
        try:
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(timeout):  # asyncio.wait_for of Python 3.11 may swallow a cancellation
                    await future
        finally:
            with self._lock:
                self._waiting.discard(future)


def _wake(future: asyncio.Future[None]) -> None:
    if not future.done():
        future.set_result(None)
