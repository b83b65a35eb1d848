"""The warm processes by themselves: what a task may do to one, and what the next task finds."""

import asyncio
import os
import threading
import time
from collections.abc import Callable, Coroutine, Iterator
from typing import Any

import psutil
import pytest

from backend.compute.workers import Workers
from backend.errors import WorkerTimeoutError
from backend.runs.work import run
from sim_core.scenario import Scenario
from tests.servers import loops

LIMIT = 2.0  # a task may take [s]; the others here take far less
CACHED_CARS = "__import__('sim_core.car.half_car').car.half_car.half_car.cache_info().currsize"
Do = Callable[[Callable[[Workers], Coroutine[Any, Any, Any]]], Any]


@pytest.fixture(scope="module")
def do() -> Iterator[Do]:
    """Runs a coroutine with one worker, in an event loop of its own that lives as long as the tests here."""
    loop, workers = asyncio.new_event_loop(), Workers(1, timeout=LIMIT)
    thread = threading.Thread(target=loop.run_forever)
    thread.start()

    def wait(coroutine: Coroutine[Any, Any, Any]) -> Any:
        return asyncio.run_coroutine_threadsafe(coroutine, loop).result(120)

    async def start() -> None:
        workers.start()
        assert not workers.ready, "readiness means a warm worker"

    try:
        wait(start())
        wait(workers.wait_until_warm())
        assert workers.ready
        yield lambda use: wait(use(workers))
        begin = time.monotonic()
        wait(workers.close())
        assert time.monotonic() - begin < 8, "SIGTERM promises ten seconds"
    finally:
        loop.call_soon_threadsafe(loop.stop)
        thread.join()
        loop.close()


def test_a_worker_outlives_errors_but_not_its_time_limit(do: Do) -> None:
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

    do(use)


def test_a_worker_computes_on_one_thread_and_is_warm(do: Do) -> None:
    async def use(workers: Workers) -> None:
        for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
            assert await workers.call(os.getenv, name) == "1"
        pid = await workers.call(os.getpid)
        # Its main thread, and the one that ends it with the service: none of BLAS.
        assert psutil.Process(pid).num_threads() == 2
        assert await workers.call(eval, CACHED_CARS) > 0, "it has driven before anybody asked"
        outcomes = await workers.call(run, Scenario(), ["lv", "passive"], 100)
        assert {name: outcome.status for name, outcome in outcomes.items()} == {"lv": "ok", "passive": "ok"}

    do(use)


def test_a_worker_that_has_grown_is_replaced_while_it_serves() -> None:
    async def use() -> None:
        workers = Workers(1, timeout=LIMIT, max_memory=1)  # any is too large
        workers.start()
        try:
            await workers.wait_until_warm()
            first = await workers.call(os.getpid)
            fresh = first
            while fresh == first:  # it serves until another is warm
                fresh = await workers.call(os.getpid)
            async with asyncio.timeout(30):
                while psutil.pid_exists(first):
                    await asyncio.sleep(0.01)
            assert workers.load["busy"] + workers.load["idle"] <= 2, "one, and perhaps its successor"
            assert workers.ready
        finally:
            await workers.close()

    loops.run(use)
