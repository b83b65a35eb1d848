"""One client sends the dearest requests it may, again as soon as each is answered: another client's runs are answered.

Six loads, each by an address of its own, one after the other on one service with shipped settings; beside each the
other client compares three strategies in scenarios nobody drove before. A load ends when its client hangs up, in
mid-run. DRILL_SECONDS= changes how long each lasts.
"""

import asyncio
import itertools
import json
import os
import time
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import pytest

from tests.drill.callers import Caller, new_run, quantile
from tests.servers import loops
from tests.servers.api import Api

SECONDS = float(os.environ.get("DRILL_SECONDS", "60"))
LONGEST = 2.0  # that 95 % of the other client's runs may take; alone they take 0.1 [s]
GREEDY, OTHER = "127.0.0.{}", "127.0.0.100"
PLAIN = b'"lv", "lqr", "passive"'
ROAD = "distance [m],height [mm]\n" + "".join(f"{0.01 * step:.2f},{step % 7}\n" for step in range(200_000))
LONG_HORIZONS = {"prediction_horizon": 60, "control_horizon": 40}

Request = tuple[str, str, bytes]
_seeds = itertools.count(10_000_000)


def run(strategy: str, scenario: dict[str, Any]) -> Request:
    """A run on a road that no request has asked for yet."""
    road = {**scenario.get("road", {}), "seed": next(_seeds)}
    body = {"scenario": {**scenario, "road": road}, "strategies": [strategy]}
    return "POST", "/api/v1/runs", json.dumps(body).encode()


def osqp() -> Request:
    """OSQP at the sliders' ends: some 20 s of one core."""
    mpc = {"solver": "osqp", "sample_time": 0.005, "deflection_limit": 0.03, **LONG_HORIZONS}
    return run("lv", {"mpc": mpc, "road": {"bump": {"height": 0.2}}})


def ecu() -> Request:
    return run("lv_hil", {"road": {"length": 3000}})


def walk() -> Request:
    return run("passive", {"road": {"length": 3000}, "speed": {"initial_speed_kmh": 5, "target_speed_kmh": 5}})


def solve() -> Request:
    body = {
        "scenario": {"road": {"seed": next(_seeds)}},
        "strategy": "lv",
        "field": "road.bump.height",
        "range": [0.01, 0.2],
        "metric": "bump.body_acceleration.peak",
        "limit": 5.0,
        "roads": 50,
    }
    return "POST", "/api/v1/solve", json.dumps(body).encode()


@dataclass
class Load:
    """So many requests of one client that are open all the time, and what came of them and of the other client's runs.

    Attributes:
        statuses: Of the answers to them; 0 for those that were open at the end.
        times: Of the other client's runs [s].
        refused: How many of those were not answered with a result.
    """

    name: str
    count: int
    request: Callable[[], Request]
    statuses: Counter[int] = field(default_factory=Counter)
    times: list[float] = field(default_factory=list)
    refused: int = 0


def row(load: Load) -> str:
    """A line of the table."""
    times = load.times
    statuses = ", ".join(f"{count} × {status or 'open'}" for status, count in sorted(load.statuses.items()))
    return (
        f"| {load.count} {load.name} | {statuses} | {len(times)} | {load.refused} | {quantile(times, 0.5):.0f} ms "
        f"| {quantile(times, 0.95):.0f} ms | {1000 * max(times):.0f} ms |"
    )


async def keep_open(caller: Caller, load: Load, end: float) -> None:
    """Send such requests one after the other; hang up at the end."""
    try:
        async with asyncio.timeout_at(end):
            while True:
                status, headers, _ = await caller.call(*load.request())
                load.statuses[status] += 1
                if status in (429, 503):
                    await asyncio.sleep(min(1.0, float(headers["retry-after"])))
                else:
                    assert status < 400, status
    except TimeoutError:
        load.statuses[0] += 1


async def compare(port: int, load: Load, end: float) -> None:
    """Plain comparisons, one after the other."""
    caller, clock = Caller(port, OTHER), asyncio.get_running_loop().time
    while clock() < end:
        begin = time.monotonic()
        status, _, _ = await caller.call("POST", "/api/v1/runs", new_run(PLAIN))
        load.times.append(time.monotonic() - begin)
        if status != 200:
            load.refused += 1
            await asyncio.sleep(0.1)
    await caller.close()


async def drive(port: int, load: Load, address: str) -> None:
    """The load for its time, begun a second before the other client."""
    callers = [Caller(port, address) for _ in range(load.count)]
    end = asyncio.get_running_loop().time() + SECONDS
    async with asyncio.TaskGroup() as group:
        for caller in callers:
            group.create_task(keep_open(caller, load, end))
        await asyncio.sleep(min(1.0, SECONDS / 10))
        group.create_task(compare(port, load, end))
    await asyncio.gather(*(caller.close() for caller in callers))


async def upload(port: int) -> str:
    """The id of a road of 2 km."""
    caller = Caller(port, OTHER)
    status, _, answer = await caller.call("POST", "/api/v1/roads", ROAD.encode(), kind="text/csv")
    assert status == 201
    await caller.close()
    return str(json.loads(answer)["id"])


async def all_loads(port: int) -> list[Load]:
    road = await upload(port)
    loads = [
        Load("nothing else", 0, osqp),
        Load("plain runs", 64, lambda: ("POST", "/api/v1/runs", new_run())),
        Load("OSQP runs at the sliders' ends", 4, osqp),
        Load("`lv_hil` runs on a long road", 4, ecu),
        Load("`/solve` over 50 roads", 4, solve),
        Load("passive runs at 5 km/h over 3 km", 8, walk),
        Load("`GET /roads/{id}` as CSV", 64, lambda: ("GET", f"/api/v1/roads/{road}?format=csv", b"")),
    ]
    for number, load in enumerate(loads, 2):
        await drive(port, load, GREEDY.format(number))
        print(row(load), flush=True)
    return loads


@pytest.mark.timeout(180 + 9 * SECONDS)
def test_a_greedy_client_keeps_no_other_waiting(api: Api) -> None:
    print(
        "\n| one client sends | its answers | the other's runs | refused | median | p95 | most |\n" + 7 * "|---" + "|"
    )
    loads = loops.run(lambda: all_loads(api.port))
    for load in loads:
        assert not load.refused, load.name
        assert quantile(load.times, 0.95) <= 1000 * LONGEST, load.name
