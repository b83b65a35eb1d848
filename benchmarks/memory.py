"""Memory of a warm worker: after 3,000 different runs, and after random scenarios of every kind (Linux)."""

import asyncio
from collections.abc import Iterable
from pathlib import Path

from backend.compute.workers import Workers
from backend.runs import WARM_UP
from backend.runs.compute_run import compute_run
from benchmarks.cost import drawn
from benchmarks.timing import table
from sim_core.scenario import Scenario

PLAIN, MIXED = 3000, 300
POINTS = 800  # of the time histories that a page asks for


def plain() -> Iterable[tuple[Scenario, list[str]]]:
    """Runs that differ in road, bump and car, as those of many people do."""
    for number in range(PLAIN // 3):
        road = {"seed": number, "bump": {"height": 0.05 + number % 50 / 1000}}
        scenario = {"road": road, "vehicle": {"body_mass": 1200.0 + number % 200}}
        yield Scenario.model_validate(scenario), ["lv", "lqr", "passive"]


def mixed() -> Iterable[tuple[Scenario, list[str]]]:
    """Scenarios anywhere within the sliders, each under a strategy drawn too."""
    for number in range(MIXED):
        scenario, strategy = drawn(500, number)
        yield scenario, [strategy]


def proportional_mb(pid: int) -> float:
    """Memory of a process [MB], its share of what it shares."""
    lines = Path(f"/proc/{pid}/smaps_rollup").read_text(encoding="ascii").splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith("Pss:")) / 1024


async def _pid(workers: Workers) -> int:
    from os import getpid

    return await workers.call(getpid)


async def measure() -> None:
    """Print the table."""
    workers = Workers(1, timeout=90, warm_up=WARM_UP)
    workers.start()
    try:
        await workers.wait_until_warm()
        pids = {await _pid(workers)}
        rows: list[list[object]] = [["warm", 0, proportional_mb(*pids), proportional_mb(*pids), 0]]
        for label, cases in (("different runs", plain()), ("random scenarios", mixed())):
            most, count, before = 0.0, 0, len(pids)
            for scenario, strategies in cases:
                await workers.call(compute_run, scenario, {name: name for name in strategies}, POINTS)
                count += len(strategies)
                if count % 30 == 0:
                    pid = await _pid(workers)
                    pids.add(pid)
                    most = max(most, proportional_mb(pid))
            rows.append([label, count, proportional_mb(await _pid(workers)), most, len(pids) - before])
        table("Memory of a warm worker, PSS", ["after", "runs", "MB", "most MB", "replaced"], rows)
    finally:
        await workers.close()


if __name__ == "__main__":
    asyncio.run(measure())
