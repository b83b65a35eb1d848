"""Chunks computed by worker processes of this machine; a Dask worker has one of these too."""

import asyncio
import logging
from collections import deque
from typing import Any

from backend.compute.chunk_messages import Chunk, ChunkOutcome
from backend.compute.compute_chunk import compute_chunk
from backend.compute.workers import Workers
from backend.errors import WorkerLostError, WorkersBusyError, WorkerTimeoutError

logger = logging.getLogger(__name__)

REMEMBERED = 1000  # groups that were stopped


class LocalExecutor:
    """Hands chunks to worker processes, in which jobs take turns; see `Executor`."""

    def __init__(self, workers: Workers) -> None:
        self._workers = workers
        self._computing: dict[str, set[asyncio.Task[Any]]] = {}  # by group
        self._stopped: deque[str] = deque(maxlen=REMEMBERED)

    async def capacity(self) -> int:
        """Return how many processes there are."""
        return self._workers.count

    async def compute(self, chunk: Chunk) -> ChunkOutcome:
        """Compute a chunk in a process."""
        if chunk.group in self._stopped:
            return ChunkOutcome(computed=[])
        # Jobs are the clients that take turns; one that is stopped ends at once, as it costs a whole budget.
        task = asyncio.create_task(self._workers.call(compute_chunk, chunk, client=chunk.group, cost=chunk.budget))
        computing = self._computing.setdefault(chunk.group, set())
        computing.add(task)
        try:
            await asyncio.wait({task})
            return _outcome(task)
        finally:
            task.cancel()  # where nobody waits for the chunk any more
            computing.discard(task)
            if not computing:
                self._computing.pop(chunk.group, None)

    async def stop(self, group: str) -> None:
        """End the chunks of that group, and begin no other of them."""
        self._stopped.append(group)
        for task in tuple(self._computing.get(group, ())):
            task.cancel()

    async def close(self) -> None:
        """End every chunk; the processes are their owner's."""
        for group in tuple(self._computing):
            await self.stop(group)


def _outcome(task: "asyncio.Task[Any]") -> ChunkOutcome:
    """Return the outcome of a task that has ended."""
    if task.cancelled():
        return ChunkOutcome(computed=[])  # it was stopped: nobody waits for this
    try:
        return ChunkOutcome(computed=task.result())
    except WorkerTimeoutError:
        return ChunkOutcome(error="timeout")
    except WorkerLostError:
        return ChunkOutcome(error="lost")
    except WorkersBusyError:
        return ChunkOutcome(error="busy")
    except Exception as error:
        logger.exception("A chunk could not be computed")
        return ChunkOutcome(error="bug", detail=type(error).__name__)
