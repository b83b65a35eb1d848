"""Tells coroutines of this process that a job was changed; commits of other processes are seen by polling."""

import asyncio
import contextlib
import threading
from collections.abc import Iterator

EVERY = ""  # in place of a job's id


class Follower:
    """Learns that what it follows was changed, in the event loop it was made in."""

    def __init__(self) -> None:
        self._loop = asyncio.get_running_loop()
        self._changed = asyncio.Event()

    def clear(self) -> None:
        """Forget the changes so far: what is read from now on has them."""
        self._changed.clear()

    async def wait(self, timeout: float) -> None:
        """Wait for a change since `clear`, at most `timeout` [s]."""
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(timeout):  # asyncio.wait_for of Python 3.11 may swallow a cancellation
                await self._changed.wait()

    def wake(self) -> None:
        """Note a change; callable from any thread."""
        with contextlib.suppress(RuntimeError):  # its event loop has ended
            self._loop.call_soon_threadsafe(self._changed.set)


class Commits:
    """The followers of jobs; safe for several threads and event loops."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._followers: dict[str, set[Follower]] = {}

    @contextlib.contextmanager
    def following(self, job_id: str = EVERY) -> Iterator[Follower]:
        """Return a follower of that job, or of every job, for the length of the block."""
        follower = Follower()
        with self._lock:
            self._followers.setdefault(job_id, set()).add(follower)
        try:
            yield follower
        finally:
            with self._lock:
                self._followers[job_id].discard(follower)
                if not self._followers[job_id]:
                    del self._followers[job_id]

    def notify(self, *job_ids: str) -> None:
        """Tell that these jobs were changed; callable from any thread."""
        with self._lock:
            woken = [follower for job_id in (*job_ids, EVERY) for follower in self._followers.get(job_id, ())]
        for follower in woken:
            follower.wake()
