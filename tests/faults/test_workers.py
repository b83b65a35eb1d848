"""The warm processes by themselves: what a task may do to one, and what the next task finds."""

import asyncio
import os
import time
from collections.abc import Awaitable, Callable
from typing import Any

import psutil
import pytest

from backend.compute import Workers, WorkerTimeoutError
from backend.worker import run
from sim_core.scenario import Scenario
from tests.servers import loops


def with_workers(count: int, timeout: float, use: Callable[[Workers], Awaitable[None]]) -> None:
    async def main() -> None:
        workers = Workers(count, timeout=timeout)
        workers.start()
        try:
            await use(workers)
        finally:
            begin = time.monotonic()
            await workers.close()
            assert time.monotonic() - begin < 8, "SIGTERM promises ten seconds"

    loops.run(main)


def test_a_worker_outlives_errors_but_not_its_time_limit() -> None:
    async def use(workers: Workers) -> None:
        pid = await workers.call(os.getpid)
        with pytest.raises(ValueError, match="invalid literal"):
            await workers.call(int, "x")
        assert await workers.call(os.getpid) == pid
        with pytest.raises(WorkerTimeoutError):
            await workers.call(time.sleep, 60)
        other = await workers.call(os.getpid)
        assert other != pid
        assert not psutil.pid_exists(pid)

    with_workers(1, 0.5, use)


def test_a_worker_computes_on_one_thread_and_is_warm() -> None:
    async def use(workers: Workers) -> None:
        for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
            assert await workers.call(os.getenv, name) == "1"
        pid = await workers.call(os.getpid)
        # Its main thread, and the one that ends it with the service: none of BLAS.
        assert psutil.Process(pid).num_threads() == 2
        outcomes = await workers.call(run, Scenario(), ["lv", "passive"], 100)
        assert {name: outcome.status for name, outcome in outcomes.items()} == {"lv": "ok", "passive": "ok"}
        assert outcomes["lv"].compute_ms < 150, "the first run in a cold process takes several times as long"

    with_workers(1, 60, use)


def test_a_task_nobody_waits_for_gives_its_worker_back() -> None:
    async def use(workers: Workers) -> None:
        pid = await workers.call(os.getpid)
        task: asyncio.Task[Any] = asyncio.create_task(workers.call(time.sleep, 0.5))
        await asyncio.sleep(0.2)
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task
        assert await workers.call(os.getpid) == pid

    with_workers(1, 60, use)


def test_readiness_means_a_warm_worker() -> None:
    async def use(workers: Workers) -> None:
        assert not workers.ready
        await workers.call(os.getpid)
        assert workers.ready

    with_workers(1, 60, use)
