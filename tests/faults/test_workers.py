"""The warm processes by themselves: what a task may do to one, and what the next task finds."""

import asyncio
import os
import threading
import time
from collections.abc import Callable, Coroutine, Iterator
from importlib import import_module
from pathlib import Path
from typing import Any
from urllib.error import ContentTooShortError

import psutil
import pytest

from backend.compute.workers import Workers
from backend.errors import WorkerTimeoutError
from backend.outcome import Sampling
from backend.runs import WARM_UP
from backend.runs.compute_run import compute_run
from sim_core.scenario import Scenario
from tests.servers import loops
from tests.servers.process import HANG_TIMEOUT

CACHED_CARS = "__import__('sim_core.vehicle.half_car').vehicle.half_car.half_car.cache_info().currsize"
BEGIN = "import pathlib, signal, time; pathlib.Path({!r}).touch()"
Do = Callable[[Callable[[Workers], Coroutine[Any, Any, Any]]], Any]


@pytest.fixture(scope="module")
def do() -> Iterator[Do]:
    """Runs a coroutine with one worker, in an event loop of its own that lives as long as the tests here."""
    loop, workers = asyncio.new_event_loop(), Workers(1, timeout=HANG_TIMEOUT, warm_up=WARM_UP)
    thread = threading.Thread(target=loop.run_forever)
    thread.start()

    def wait(coroutine: Coroutine[Any, Any, Any]) -> Any:
        return asyncio.run_coroutine_threadsafe(coroutine, loop).result(HANG_TIMEOUT)

    async def start() -> None:
        workers.start()
        assert not workers.ready, "readiness means a warm worker"

    try:
        wait(start())
        wait(workers.wait_until_warm())
        assert workers.ready
        yield lambda use: wait(use(workers))
        wait(workers.close())
    finally:
        loop.call_soon_threadsafe(loop.stop)
        thread.join()
        loop.close()


async def ended_process(pid: int) -> None:
    """Wait until it has ended: its successor may be there before."""
    async with asyncio.timeout(HANG_TIMEOUT):
        while psutil.pid_exists(pid):
            await asyncio.sleep(0.01)


def test_a_worker_outlives_errors_but_not_its_time_limit(do: Do, monkeypatch: pytest.MonkeyPatch) -> None:
    async def use(workers: Workers) -> None:
        pid = await workers.call(os.getpid)
        with pytest.raises(ValueError, match="invalid literal"):
            await workers.call(int, "x")
        assert await workers.call(os.getpid) == pid
        with monkeypatch.context() as patch:
            patch.setattr(workers, "_timeout", 0.5)
            with pytest.raises(WorkerTimeoutError):
                await workers.call(time.sleep, 3600)
        other = await workers.call(os.getpid)
        assert other != pid
        await ended_process(pid)

    do(use)


def test_a_worker_computes_on_one_thread_and_is_warm(do: Do) -> None:
    async def use(workers: Workers) -> None:
        for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
            assert await workers.call(os.getenv, name) == "1"
        pid = await workers.call(os.getpid)
        # Its main thread, and the one that ends it with the service: none of BLAS.
        assert psutil.Process(pid).num_threads() == 2
        assert await workers.call(eval, CACHED_CARS) > 0, "it has driven before anybody asked"
        outcomes = await workers.call(compute_run, Scenario(), {"lv": "a", "passive": "b"}, Sampling(100))
        assert {name: outcome.status for name, outcome in outcomes.items()} == {"lv": "ok", "passive": "ok"}

    do(use)


def test_a_task_that_nobody_waits_for_ends_or_never_begins(do: Do, tmp_path: Path) -> None:
    begun, ended, never = (tmp_path / name for name in ("begun", "ended", "never"))

    async def gone(workers: Workers, code: str, cost: float) -> None:
        """A task whose caller goes away once it has begun, and another one that waits behind it."""
        begun.unlink(missing_ok=True)
        task = asyncio.create_task(workers.call(exec, f"{BEGIN.format(str(begun))}; {code}", cost=cost))
        waiting = asyncio.create_task(workers.call(never.touch))
        while not begun.exists():
            await asyncio.sleep(0.01)
        for each in (waiting, task):
            each.cancel()
            with pytest.raises(asyncio.CancelledError):
                await each

    async def use(workers: Workers) -> None:
        pid = await workers.call(os.getpid)
        await gone(workers, f"time.sleep(0.1); pathlib.Path({str(ended)!r}).touch()", cost=0.1)
        assert await workers.call(os.getpid) == pid
        assert ended.exists(), "a short one ends by itself"
        await gone(workers, "time.sleep(3600)", cost=30.0)
        assert await workers.call(os.getpid) != pid, "a long one ends with its process"
        await ended_process(pid)
        assert await workers.call(eval, CACHED_CARS) > 0, "the next one is warm"

    do(use)
    assert not never.exists()


def test_what_cannot_be_sent_is_an_error_of_its_task_alone(do: Do) -> None:
    async def use(workers: Workers) -> None:
        pid = await workers.call(os.getpid)
        with pytest.raises(RuntimeError, match="cannot pickle"):
            await workers.call(threading.Lock)
        with pytest.raises(ModuleNotFoundError) as raised:
            await workers.call(import_module, "no_such_module")
        assert "import_module" in str(raised.value.__cause__), "the log has where it was raised"
        assert await workers.call(os.getpid) == pid
        with pytest.raises(AttributeError, match="pickle"):
            await workers.call(os.getpid, lambda: None)
        with pytest.raises(TypeError, match="missing 1 required"):
            await workers.call(ContentTooShortError, "half", b"")  # which is written, and cannot be read
        assert await workers.call(os.getpid) != pid, "of whose pipe nobody knows what is left in it"
        assert workers.load == {"busy": 0, "idle": 1, "waiting": 0}

    do(use)


def test_a_worker_that_has_grown_is_replaced_while_it_serves() -> None:
    async def use() -> None:
        workers = Workers(1, timeout=HANG_TIMEOUT, warm_up=WARM_UP, max_memory=1)  # any is too large
        workers.start()
        try:
            await workers.wait_until_warm()
            first = await workers.call(os.getpid)
            fresh = first
            while fresh == first:
                fresh = await workers.call(os.getpid)
            await ended_process(first)
            assert workers.load["busy"] + workers.load["idle"] <= 1
            assert await workers.call(os.getpid) != first
        finally:
            await workers.close()

    loops.run(use)
