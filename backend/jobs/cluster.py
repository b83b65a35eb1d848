"""The cluster that computes the runs of jobs: Dask, in this process by default, or at `RIDELAB_DASK_SCHEDULER`.

Dask only hands chunks out. A Dask worker passes each to a pool of processes of its own (`backend.compute.Workers`,
what interactive runs have too): so a run that crashes, hangs or is cancelled takes one process with it and never a
Dask worker. Those processes stand behind interactive ones in the machine's order (nice).

The embedded cluster opens no port: its parts speak through memory (docs/decisions/0006-dask-without-ports.md).
"""

import asyncio
import contextlib
import logging
import multiprocessing
from collections import deque
from collections.abc import Iterator, Mapping
from typing import Any

import dask
from distributed import Client, Scheduler, Security, SpecCluster, Worker, get_worker
from distributed.http.routing import RoutingApplication
from tornado.httpserver import HTTPServer

from backend.compute.workers import Workers
from backend.errors import WorkerLostError, WorkersBusyError, WorkerTimeoutError
from backend.jobs.chunk_messages import Chunk, ChunkOutcome, ClusterLostError
from backend.jobs.compute_chunk import compute_chunk
from backend.settings import Settings
from sim_core import __version__ as CORE_VERSION

logger = logging.getLogger(__name__)

NICE = 10  # of 19: beside one that computes for a person it gets a tenth of a core
CONNECT_TIMEOUT = 10  # to a scheduler [s]
CLOSE_TIMEOUT = 3  # for it to take leave [s]
QUIET = {
    "distributed.worker.profile.enabled": False,  # samples every thread a hundred times a second, for a dashboard
    "distributed.admin.tick.interval": "1s",
    "distributed.admin.system-monitor.interval": "10s",
    "distributed.worker.memory.monitor-interval": "1s",  # of this process alone, which computes nothing
}

_pools: dict[str, Workers] = {}  # of this process, by Dask worker: the embedded one, or the one this process is
_running: dict[str, set[asyncio.Task[Any]]] = {}  # chunks under way in this process, by group
_stopped: deque[str] = deque(maxlen=1000)  # groups stopped lately: chunks of theirs that lie ready are not begun


class Cluster:
    """Sends chunks to Dask."""

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self._embedded: SpecCluster | None = None
        self._client: Client | None = None

    async def start(self) -> None:
        """Start the embedded cluster, or connect to the external one.

        Raises:
            OSError: Nothing answers at the scheduler's address.
        """
        address = self._settings.dask_scheduler
        dask.config.set(QUIET)
        if address is None:
            self._embedded = await _embedded(self._settings.batch_workers)
        target = self._embedded or address
        self._client = await Client(
            target, asynchronous=True, timeout=CONNECT_TIMEOUT, security=_security(self._settings), name="ridelab"
        )

    @property
    def connected(self) -> bool:
        """Whether the connection to the scheduler is open."""
        return self._client is not None and self._client.status == "running"

    async def slots(self) -> int:
        """Chunks that can be computed at the same time.

        Raises:
            ClusterLostError: The scheduler does not answer.
        """
        if self._embedded is not None:
            return self._settings.batch_workers
        with _lost():
            async with asyncio.timeout(CONNECT_TIMEOUT):
                threads: Mapping[str, int] = await self._connection.nthreads()
            return sum(threads.values())

    async def compute(self, chunk: Chunk) -> ChunkOutcome:
        """Compute a chunk on some worker.

        Raises:
            ClusterLostError: The cluster, or the part that computed it, went away: it may be handed out again.
        """
        with _lost():
            future = self._connection.submit(_on_worker, chunk, pure=False, priority=chunk.priority)
            try:
                outcome: ChunkOutcome = await future
                return outcome
            finally:
                future.release()

    async def stop(self, group: str) -> None:
        """End every chunk of that group now, on any worker."""
        with contextlib.suppress(ClusterLostError), _lost():
            async with asyncio.timeout(CONNECT_TIMEOUT):
                await self._connection.run(_stop, group, on_error="ignore")

    async def close(self) -> None:
        """Leave the cluster; the embedded one ends, with its processes."""
        client, self._client = self._client, None
        embedded, self._embedded = self._embedded, None
        addresses = [] if embedded is None else [worker.address for worker in embedded.workers.values()]
        for part in (client, embedded):
            if part is not None:
                with contextlib.suppress(Exception):  # what is gone already needs no end
                    async with asyncio.timeout(CLOSE_TIMEOUT):
                        await part.close()
        for address in addresses:
            if address in _pools:
                await _pools.pop(address).close()

    @property
    def _connection(self) -> Client:
        if self._client is None:
            raise ClusterLostError("There is no connection to a Dask scheduler")
        return self._client


@contextlib.contextmanager
def _lost() -> Iterator[None]:
    """One error for everything that Dask raises when a part of it goes away."""
    try:
        yield
    except ClusterLostError:
        raise
    except Exception as error:
        raise ClusterLostError(f"{type(error).__name__}: {error}") from error


def _security(settings: Settings) -> Security | None:
    if settings.dask_tls_ca_file is None:
        return None
    return Security(
        require_encryption=True,
        tls_ca_file=str(settings.dask_tls_ca_file),
        tls_client_cert=str(settings.dask_tls_cert_file),
        tls_client_key=str(settings.dask_tls_key_file),
    )


async def _embedded(slots: int) -> SpecCluster:
    workers = {0: {"cls": _PortlessWorker, "options": {"nthreads": slots, "protocol": "inproc://"}}}
    scheduler = {"cls": _PortlessScheduler, "options": {"protocol": "inproc://", "dashboard": False}}
    return await SpecCluster(workers=workers, scheduler=scheduler, asynchronous=True, silence_logs=False)


class _NoPort:
    """A Dask server without HTTP: by default each opens a port to everybody."""

    http_application: RoutingApplication
    http_server: HTTPServer

    def start_http_server(self, *_: object, **__: object) -> None:
        """Have the server that closing expects, bound to nothing."""
        self.http_application = RoutingApplication([])
        self.http_server = HTTPServer(self.http_application)
        self.http_server.port = 0


class _PortlessScheduler(_NoPort, Scheduler):  # type: ignore[misc]  # distributed is untyped
    pass


class _PortlessWorker(_NoPort, Worker):  # type: ignore[misc]
    pass


async def _on_worker(chunk: Chunk) -> ChunkOutcome:
    """On a Dask worker, in its event loop: pass the chunk to a process."""
    worker = get_worker()
    if chunk.core_version != CORE_VERSION:
        return ChunkOutcome(trouble="misfit", detail=f"the Dask worker at {worker.address} has core {CORE_VERSION}")
    if multiprocessing.current_process().daemon:
        detail = f"the Dask worker at {worker.address} may have no children: --no-nanny, or distributed.worker.daemon"
        return ChunkOutcome(trouble="misfit", detail=f"{detail}: false")
    if chunk.group in _stopped:
        return ChunkOutcome(computed=[])
    pool = _pool(worker, chunk.timeout)
    task = asyncio.create_task(pool.call(compute_chunk, chunk))
    running = _running.setdefault(chunk.group, set())
    running.add(task)
    try:
        await asyncio.wait({task})
        if task.cancelled():
            return ChunkOutcome(computed=[])  # it was stopped: nobody waits for this
        return ChunkOutcome(computed=task.result())
    except WorkerTimeoutError:
        return ChunkOutcome(trouble="timeout")
    except WorkerLostError:
        return ChunkOutcome(trouble="lost")
    except WorkersBusyError:
        return ChunkOutcome(trouble="busy")
    except Exception as error:
        logger.exception("A chunk could not be computed")
        return ChunkOutcome(trouble="bug", detail=type(error).__name__)
    finally:
        task.cancel()  # also where Dask ends this coroutine because its worker closes
        running.discard(task)
        if not running:
            _running.pop(chunk.group, None)


def _pool(worker: Worker, timeout: float) -> Workers:
    """That Dask worker's processes, started when first needed."""
    pool = _pools.get(worker.address)
    if pool is None:
        pool = _pools[worker.address] = Workers(worker.state.nthreads, timeout=timeout, nice=NICE)
        pool.start()
    return pool


async def _stop(group: str) -> None:
    """On a Dask worker: end the chunks of that group, and start no other of them."""
    _stopped.append(group)
    for task in tuple(_running.get(group, ())):
        task.cancel()
