"""What computes the runs of jobs: processes of this machine or a Dask cluster, behind the same four methods."""

from typing import Protocol

from backend.compute.chunk_messages import Chunk, ChunkOutcome


class ExecutorLostError(Exception):
    """Nothing can be computed at the moment, because what computes has gone away; chunks may be sent again."""


class Executor(Protocol):
    """Computes chunks; each in a process of its own, which a crash takes with it and nothing else."""

    async def capacity(self) -> int:
        """Return how many chunks can be computed at the same time; raises ExecutorLostError."""

    async def compute(self, chunk: Chunk) -> ChunkOutcome:
        """Return the outcome of a chunk; raises ExecutorLostError."""

    async def stop(self, group: str) -> None:
        """End every chunk of that group now, and begin no other one."""

    async def close(self) -> None:
        """Leave it; what it computes ends."""
