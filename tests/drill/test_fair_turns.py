"""One client sends the dearest requests it may, again as soon as each is answered: another client's runs are answered.

Seventeen loads, each by an address of its own, one after the other on one service, and on two replicas by turns, with
shipped settings; beside each the other client compares three strategies in scenarios nobody drove before. A load ends
when its client hangs up, in mid-run. DRILL_SECONDS= changes how long each lasts. At which line a file is refused is
shown by tests/api/test_measured_roads.py and test_recordings.py.
"""

import asyncio
import itertools
import json
import os
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from sim_core.strategies import STRATEGIES
from tests.drill.callers import Caller, new_run, quantile
from tests.servers import loops
from tests.servers.postgres import Postgres
from tests.servers.process import Api

SECONDS = float(os.environ.get("DRILL_SECONDS", "60"))
LONGEST = 2.0  # that 95 % of the other client's runs may take; alone they take 0.1 [s]
GREEDY, OTHER = "127.0.0.{}", "127.0.0.100"
PLAIN = b'"lv", "lqr", "passive"'
ROAD = "distance [m],height [mm]\n" + "".join(f"{0.01 * step:.2f},{step % 7}\n" for step in range(200_000))
LONG_HORIZONS = {"prediction_horizon": 60, "control_horizon": 40}
INFINITE = ROAD.partition("\n")[2].replace("1000.00,5", "1000.00,inf")
NO_FILES = (  # the longest that are read to their middle or end before they are refused
    ("roads", f"distance [m],height [mm]\n{INFINITE}".encode()),
    ("roads", b"x [m],z [m]\n" + 2_000_000 * b"\n"),
    ("roads", b"x [m],z [m]\n" + 4_000_000 * b"1"),
    ("recordings", f"time [s],body_acceleration [m/s^2]\n{INFINITE}".encode()),
    ("recordings", 2000 * b"a," + b"b\n" + 900 * (2000 * b"1," + b"1\n")),
    ("recordings", b"time [s],height [mm]\n" + 500_000 * b"0,1\n"),
    ("recordings", 4_000_000 * b"\xff"),
)

NINE = list(STRATEGIES)

Request = tuple[str, str, bytes]
Ports = Sequence[int]
_seeds = itertools.count(10_000_000)


def post(path: str, strategies: Sequence[str], scenario: dict[str, Any], **more: Any) -> Request:
    """Something of a road that no request has asked for yet."""
    road = {**scenario.get("road", {}), "seed": next(_seeds)}
    body = {"scenario": {**scenario, "road": road}, "strategies": strategies, **more}
    return "POST", f"/api/v1/{path}", json.dumps(body).encode()


def run(strategy: str, scenario: dict[str, Any]) -> Request:
    """A run of one strategy."""
    return post("runs", [strategy], scenario)


def sweep() -> Request:
    """2,000 runs."""
    heights = {"ranges": {"road.bump.height": [0.02, 0.12]}, "samples": 1000, "seed": next(_seeds)}
    return post("batches", ["lv", "passive"], {}, sweep={"latin_hypercube": heights})


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
        refusal: Status that such a request is meant to be refused with.
        kind: The media type of its body.
        pause: From an answer to the next request [s].
        statuses: Of the answers to them; 0 for those that were open at the end.
        times: Of the other client's runs [s].
        refused: How many of those were not answered with a result.
    """

    name: str
    count: int
    request: Callable[[], Request]
    refusal: int = 200
    kind: str = "application/json"
    pause: float = 0.0
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
                status, headers, _ = await caller.call(*load.request(), kind=load.kind)
                load.statuses[status] += 1
                if status in (429, 503):
                    await asyncio.sleep(min(1.0, float(headers["retry-after"])))
                else:
                    assert status < 400 or status == load.refusal, status
                    await asyncio.sleep(load.pause)
    except TimeoutError:
        load.statuses[0] += 1


async def compare(ports: Ports, load: Load, end: float) -> None:
    """Plain comparisons, one after the other, of each replica in turn."""
    callers, clock = [Caller(port, OTHER) for port in ports], asyncio.get_running_loop().time
    for caller in itertools.cycle(callers):
        if clock() >= end:
            break
        begin = time.monotonic()
        status, _, _ = await caller.call("POST", "/api/v1/runs", new_run(PLAIN))
        load.times.append(time.monotonic() - begin)
        if status != 200:
            load.refused += 1
            await asyncio.sleep(0.1)
    await asyncio.gather(*(caller.close() for caller in callers))


async def drive(ports: Ports, load: Load, address: str) -> None:
    """The load for its time, begun a second before the other client."""
    callers = [Caller(ports[number % len(ports)], address) for number in range(load.count)]
    end = asyncio.get_running_loop().time() + SECONDS
    async with asyncio.TaskGroup() as group:
        for caller in callers:
            group.create_task(keep_open(caller, load, end))
        await asyncio.sleep(min(1.0, SECONDS / 10))
        group.create_task(compare(ports, load, end))
    await asyncio.gather(*(caller.close() for caller in callers))


async def made(port: int, path: str, body: bytes, kind: str = "application/json") -> str:
    """The id of what is made there."""
    caller = Caller(port, OTHER)
    status, _, answer = await caller.call("POST", f"/api/v1/{path}", body, kind=kind)
    assert status < 300, answer
    await caller.close()
    return str(json.loads(answer)["id"])


async def all_loads(ports: Ports) -> list[Load]:
    road = await made(ports[0], "roads", ROAD.encode(), "text/csv")
    long = await made(ports[0], "runs", post("runs", NINE, {"road": {"length": 1000}})[2])
    link, files = json.dumps({"run_id": long, "view": {}}).encode(), itertools.cycle(NO_FILES)

    def file() -> Request:
        to, content = next(files)
        return "POST", f"/api/v1/{to}", content

    loads = [
        Load("nothing else", 0, osqp),
        Load("plain runs", 64, lambda: ("POST", "/api/v1/runs", new_run())),
        Load("OSQP runs at the sliders' ends", 4, osqp),
        Load("`lv_hil` runs on a long road", 4, ecu),
        Load("`/solve` over 50 roads", 4, solve),
        Load("passive runs at 5 km/h over 3 km", 8, walk),
        Load("`GET /roads/{id}` as CSV", 64, lambda: ("GET", f"/api/v1/roads/{road}?format=csv", b"")),
        Load("runs of nine over 50 roads", 8, lambda: post("runs", NINE, {}, roads=50)),
        Load("`/live` of nine on 1 km", 32, lambda: post("live", NINE, {"road": {"length": 1000}})),
        Load("time histories of 1 km", 64, lambda: ("GET", f"/api/v1/runs/{long}/series?strategy=lv&format=csv", b"")),
        Load("reports", 16, lambda: ("GET", f"/api/v1/runs/{long}/report.html?baseline=lv", b"")),
        Load("links of nine time histories", 16, lambda: ("POST", "/api/v1/links", link)),
        Load("bodies of 0.9 MB, too long", 32, lambda: ("POST", "/api/v1/runs", b"[" * 900_000), refusal=413),
        Load("files that are no roads and no drives", 8, file, refusal=422, kind="text/csv"),
        Load("idle connections", 800, lambda: ("GET", "/healthz", b""), pause=SECONDS),
        Load("`/openapi.json`", 64, lambda: ("GET", "/openapi.json", b"")),
        Load("batches' lists", 64, lambda: ("GET", "/api/v1/batches?limit=50", b"")),
        Load("batches of 2,000 runs", 4, sweep),  # the last: they go on behind the next load
    ]
    for number, load in enumerate(loads, 2):
        await drive(ports, load, GREEDY.format(number))
        print(row(load), flush=True)
    return loads


@contextmanager
def replicas(folder: Path, postgres: Postgres) -> Iterator[list[Api]]:
    """Two on one database."""
    url = postgres.new_database()
    with (
        Api(folder, name="first", RIDELAB_DATABASE_URL=url) as first,
        Api(folder, name="second", RIDELAB_DATABASE_URL=url) as second,
    ):
        first.wait_until_ready()
        second.wait_until_ready()
        yield [first, second]


def check(ports: Ports) -> None:
    print(
        "\n| one client sends | its answers | the other's runs | refused | median | p95 | most |\n" + 7 * "|---" + "|"
    )
    loads = loops.run(lambda: all_loads(ports))
    for load in loads:
        assert not load.refused, load.name
        assert quantile(load.times, 0.95) <= 1000 * LONGEST, load.name


@pytest.mark.timeout(180 + 18 * SECONDS)
def test_a_greedy_client_keeps_no_other_waiting(api: Api) -> None:
    check([api.port])


@pytest.mark.timeout(180 + 18 * SECONDS)
def test_a_client_that_is_greedy_with_two_replicas_keeps_no_other_waiting(tmp_path: Path, postgres: Postgres) -> None:
    with replicas(tmp_path, postgres) as apis:
        check([each.port for each in apis])
