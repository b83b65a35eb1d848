"""Chunks computed by the workers of a Dask cluster, at `RIDELAB_DASK_SCHEDULER`; the extra `cluster` brings Dask.

Dask only hands chunks out. A Dask worker passes each to processes of its own (`LocalExecutor`), as a service does that
has no cluster: so a run that crashes, hangs or is cancelled takes one process with it and never a Dask worker.
"""

import asyncio
import contextlib
import multiprocessing
from collections.abc import Iterator, Mapping
from typing import Self

from distributed import Client, Security, get_worker

from backend.compute.chunk_messages import Chunk, ChunkOutcome
from backend.compute.executor import ExecutorLostError
from backend.compute.local_executor import LocalExecutor
from backend.compute.memory import memory_limit
from backend.compute.workers import BATCH_NICE, Workers
from backend.custom_controllers import registry as custom_controllers
from backend.settings import Settings
from sim_core import __version__ as CORE_VERSION

CONNECT_TIMEOUT = 10  # to a scheduler [s]
CLOSE_TIMEOUT = 3  # for it to take leave [s]
PROCESS_MEMORY = 120_000_000  # of a Dask worker, and of each of its processes [bytes]

_executors: dict[str, LocalExecutor] = {}  # of this process, by Dask worker


class DaskExecutor:
    """Sends chunks to Dask; see `Executor`."""

    def __init__(self, client: Client, warm_up: str) -> None:
        self._client = client
        self._warm_up = warm_up

    @classmethod
    async def connected(cls, settings: Settings, warm_up: str) -> Self:
        """Connect to the scheduler.

        Args:
            settings: Name it.
            warm_up: What every process of a Dask worker does first.

        Raises:
            OSError: Nothing answers at its address.
        """
        client = await Client(
            settings.dask_scheduler,
            asynchronous=True,
            timeout=CONNECT_TIMEOUT,
            security=_security(settings),
            name="ridelab",
        )
        return cls(client, warm_up)

    async def capacity(self) -> int:
        """Return how many threads its workers have; raises ExecutorLostError."""
        if not self._is_connected:
            raise ExecutorLostError("The connection to the Dask scheduler is lost")
        with _lost():
            async with asyncio.timeout(CONNECT_TIMEOUT):
                threads: Mapping[str, int] = await self._client.nthreads()
        return sum(threads.values())

    async def compute(self, chunk: Chunk) -> ChunkOutcome:
        """Compute a chunk on some worker; raises ExecutorLostError."""
        try:
            with _lost():
                future = self._client.submit(_on_worker, chunk, self._warm_up, pure=False, priority=chunk.priority)
                try:
                    outcome: ChunkOutcome = await future
                    return outcome
                finally:
                    future.release()
        except ExecutorLostError as error:
            if self._is_connected:  # only the worker is lost: perhaps by what it was sent
                return ChunkOutcome(error="lost", detail=str(error))
            raise

    async def stop(self, group: str) -> None:
        """End the chunks of that group on every worker."""
        with contextlib.suppress(ExecutorLostError), _lost():
            async with asyncio.timeout(CONNECT_TIMEOUT):
                await self._client.run(_stop, group, on_error="ignore")

    async def close(self) -> None:
        """Take leave of the scheduler."""
        with contextlib.suppress(Exception):  # what is gone already needs no end
            async with asyncio.timeout(CLOSE_TIMEOUT):
                await self._client.close()

    @property
    def _is_connected(self) -> bool:
        return bool(self._client.status == "running")


@contextlib.contextmanager
def _lost() -> Iterator[None]:
    """One error for everything that Dask raises when a part of it goes away."""
    try:
        yield
    except Exception as error:
        raise ExecutorLostError(f"{type(error).__name__}: {error}") from error


def _security(settings: Settings) -> Security | None:
    if settings.dask_tls_ca_file is None:
        return None
    return Security(
        require_encryption=True,
        tls_ca_file=str(settings.dask_tls_ca_file),
        tls_client_cert=str(settings.dask_tls_cert_file),
        tls_client_key=str(settings.dask_tls_key_file),
    )


async def _on_worker(chunk: Chunk, warm_up: str) -> ChunkOutcome:
    """On a Dask worker, in its event loop: pass the chunk to a process."""
    worker = get_worker()
    if chunk.core_version != CORE_VERSION:
        return ChunkOutcome(
            error="version_mismatch", detail=f"the Dask worker at {worker.address} has core {CORE_VERSION}"
        )
    if multiprocessing.current_process().daemon:
        detail = f"the Dask worker at {worker.address} may have no children: --no-nanny, or distributed.worker.daemon"
        return ChunkOutcome(error="version_mismatch", detail=f"{detail}: false")
    needed = PROCESS_MEMORY * (1 + worker.state.nthreads)
    if (limit := memory_limit() or needed) < needed:
        return ChunkOutcome(error="version_mismatch", detail=_too_little(limit, needed, worker.state.nthreads))
    executor = _executors.get(worker.address)
    if executor is None:
        workers = Workers(worker.state.nthreads, timeout=chunk.timeout, warm_up=warm_up, nice=BATCH_NICE)
        executor = _executors[worker.address] = LocalExecutor(workers)
    custom_controllers.set_sources(chunk.controllers)
    return await executor.compute(chunk)


def _too_little(limit: int, needed: int, processes: int) -> str:
    return (
        f"A Dask worker may use {limit / 1e6:.0f} MB of memory, and needs {needed / 1e6:.0f} MB for its {processes} "
        "processes: give it more (WORKER_MEMORY), or fewer processes (WORKER_CORES)"
    )


async def _stop(group: str) -> None:
    """On a Dask worker: end the chunks of that group."""
    for executor in _executors.values():
        await executor.stop(group)
