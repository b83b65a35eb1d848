"""One client takes all it can get, for half a minute each way: the others are served as if it were not there.

It keeps 800 connections open, or it asks for runs on 64 of them as quickly as they are answered. Shipped settings.
"""

import asyncio
import time
from collections.abc import Iterator

import pytest

from tests.drill.callers import Caller, new_run, quantile
from tests.servers import loops
from tests.servers.api import Api

GREEDY = "127.0.0.2"
OTHERS = [f"127.0.0.{number}" for number in range(3, 49)]
SECONDS = 30.0


@pytest.fixture(scope="module")
def port(tmp_path_factory: pytest.TempPathFactory) -> Iterator[int]:
    api = Api(tmp_path_factory.mktemp("greedy"))
    try:
        api.wait_until_ready()
        yield api.port
    finally:
        api.end()


async def others(port: int, seconds: float) -> tuple[dict[int, int], list[float], list[float]]:
    """Each asks for health and then for a run, on a new connection: statuses, and times of either [s]."""
    statuses: dict[int, int] = {}
    health: list[float] = []
    runs: list[float] = []
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        for address in OTHERS:
            caller = Caller(port, address)
            for into, request in ((health, ("GET", "/healthz")), (runs, ("POST", "/api/v1/runs", new_run()))):
                begin = time.monotonic()
                status, _, _ = await caller.call(*request)
                into.append(time.monotonic() - begin)
                statuses[status] = statuses.get(status, 0) + 1
            await caller.close()
    return statuses, health, runs


def summary(statuses: dict[int, int], health: list[float], runs: list[float]) -> str:
    return (
        f"the others' answers by status {statuses}, health {quantile(health, 0.5):.0f} ms, p99 "
        f"{quantile(health, 0.99):.0f}; runs {quantile(runs, 0.5):.0f} ms, p99 {quantile(runs, 0.99):.0f}"
    )


async def idle(port: int) -> None:
    greedy = Caller(port, GREEDY)
    try:
        await greedy.hold(800)
        print(f"\n800 idle connections, of which {greedy.open} are left open: ", end="")
        assert greedy.open == 200
        statuses, health, runs = await others(port, SECONDS)
        print(summary(statuses, health, runs))
        assert set(statuses) == {200}
        assert (await greedy.call("GET", "/healthz"))[0] == 200
    finally:
        await greedy.close()


async def busy(port: int) -> None:
    greedy, end, answers = Caller(port, GREEDY), time.monotonic() + SECONDS, dict[int, int]()

    async def ask() -> None:
        while time.monotonic() < end:
            status, headers, _ = await greedy.call("POST", "/api/v1/runs", new_run())
            answers[status] = answers.get(status, 0) + 1
            if status != 200:
                await asyncio.sleep(min(1.0, float(headers["retry-after"])))

    async with asyncio.TaskGroup() as group:
        for _ in range(64):
            group.create_task(ask())
        statuses, health, runs = await others(port, SECONDS - 2)
        print(f"\n64 runs at once, always: {summary(statuses, health, runs)}")
        assert set(statuses) == {200}
        assert quantile(runs, 0.99) < 5000
    print(f"the greedy client's answers by status {answers}")
    await greedy.close()


@pytest.mark.timeout(180)
def test_idle_connections_of_one_client_keep_nobody_out(port: int) -> None:
    loops.run(lambda: idle(port))


@pytest.mark.timeout(180)
def test_runs_of_one_client_keep_nobody_out(port: int) -> None:
    loops.run(lambda: busy(port))
