"""Batches: the service's rate on two cores and on one against the core's own, its memory, what-ifs meanwhile."""

import multiprocessing
import os
import statistics
import time
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime
from multiprocessing.pool import Pool
from typing import Any

import httpx
import psutil

from backend.batches.points import Sweep, points
from backend.compute.workers import BATCH_NICE
from backend.scenario_at import scenario_at
from benchmarks.api_latency import TOGETHER, server, timed
from benchmarks.timing import table
from sim_core import Scenario, simulate

FEW, MANY, SMALL = 1000, 10_000, 4
SAMPLE = 300  # runs that tell the core's own rate
PROBES = 40
RANGES = {"road.bump.height": [0.05, 0.15], "mpc.stage_weights.cruise.0": [1, 10], "mpc.stage_weights.bump.2": [1, 10]}


def sweep(samples: int, seed: int) -> dict[str, Any]:
    """Random heights and weights: every run has control laws of its own to work out."""
    return {"latin_hypercube": {"ranges": RANGES, "samples": samples, "seed": seed}}


def core_rate(seed: int) -> tuple[float, float]:
    """LV runs a second of one process that does nothing else over such a sweep, and its processor time a run [ms]."""
    base = Scenario().model_dump(mode="json")
    sweep_points = points(Sweep.model_validate(sweep(SAMPLE, seed)), base)
    scenarios = [scenario_at(base, changes) for changes in sweep_points]
    simulate(scenarios[0], "lv")
    begin, processor = time.perf_counter(), time.process_time()
    for scenario in scenarios:
        simulate(scenario, "lv").summary()
    return SAMPLE / (time.perf_counter() - begin), 1000 * (time.process_time() - processor) / SAMPLE


def run() -> None:
    """Print the tables."""
    spawn = multiprocessing.get_context("spawn")
    # It stands as far behind other programs as the service's processes do: what else the machine does slows both alike.
    with spawn.Pool(1, initializer=os.nice, initargs=(BATCH_NICE,)) as alone:
        with server(("taskset", "--cpu-list", "0"), RIDELAB_BATCH_WORKERS="1") as client:
            _small_batch(client, 6)  # starts its process
            one_core, _, _ = _measured(client, alone, "one core", FEW, 1)
        with server() as client:
            idle = (probes := _Probes(client)).take(PROBES)
            small_alone = _small_batch(client, 4)
            measured = [_measured(client, alone, "two cores", samples, seed) for samples, seed in ((FEW, 1), (MANY, 2))]
            _print_rates([one_core, *(rates for rates, _, _ in measured)])
            few, many = (memory for _, memory, _ in measured)
            table(
                "Memory of all processes at most",
                ["", "MiB", "against the first"],
                [[f"{FEW} runs", few, 1.0], [f"{MANY} runs", many, many / few]],
            )
            with _going_on(client):
                busy = probes.take(PROBES)
                small_beside = _small_batch(client, 5)
            table(
                "POST /runs of lv + lqr + passive on a new road, medians",
                ["", "ms", "against idle"],
                [["idle", idle, 1.0], [f"while {MANY} runs go on", busy, busy / idle]],
            )
            table(
                f"A batch of {SMALL} LV runs on new roads, from its 202 to its end",
                ["", "ms", "against alone"],
                [["alone", small_alone, 1.0], [f"behind {MANY} runs", small_beside, small_beside / small_alone]],
            )
            _exports(client, measured[-1][2])


def _measured(client: httpx.Client, alone: Pool, label: str, samples: int, seed: int) -> tuple[list[Any], float, str]:
    """Its row of rates, the most memory [MiB] and its id, of a batch of so many runs."""
    service = psutil.Process(_server_pid())
    before = alone.apply(core_rate, (seed,))
    batch = _submitted(client, samples, seed)
    processor, memory = _processor_seconds(service), 0.0
    while batch["state"] != "done":
        time.sleep(1)
        memory = max(memory, _memory(service))
        batch = client.get(f"/api/v1/batches/{batch['id']}").json()
    processor = 1000 * (_processor_seconds(service) - processor) / samples
    after = alone.apply(core_rate, (seed,))
    core, own = ((one + other) / 2 for one, other in zip(before, after, strict=True))
    rate = samples / _seconds(batch)
    return [f"{label}, {samples} runs", rate, core, rate / core, processor, own], memory, batch["id"]


def _print_rates(rows: list[list[Any]]) -> None:
    table(
        "Batches of LV runs, and one process that only computes them, before and after each",
        ["the service on", "runs/s", "one process, runs/s", "ratio", "processor ms a run", "of one process"],
        rows,
    )
    (_, on_one, *_), (_, on_two, _, ratio, processor, own) = rows[0], rows[-1]
    by_processor = 2 * own / processor
    print(f"  {MANY} runs on two cores go {ratio:.2f} times as fast as one process (goal: at least 1.9), and")
    print(f"  {on_two / on_one:.2f} times as fast as the service on one core; by processor time {by_processor:.2f}")


def _processor_seconds(service: psutil.Process) -> float:
    """Used by the service and its processes."""
    times = [process.cpu_times() for process in (service, *service.children(recursive=True))]
    return float(sum(each.user + each.system for each in times))


def _server_pid() -> int:
    (child,) = [each for each in psutil.Process().children() if "backend" in " ".join(each.cmdline())]
    return child.pid


def _memory(service: psutil.Process) -> float:
    """Of the service and its processes [MiB]."""
    total = 0
    for process in (service, *service.children(recursive=True)):
        try:
            total += process.memory_full_info().pss
        except psutil.NoSuchProcess:
            continue
    return total / 2**20


def _submitted(client: httpx.Client, samples: int, seed: int) -> dict[str, Any]:
    body = {"strategies": ["lv"], "sweep": sweep(samples, seed)}
    answer = client.post("/api/v1/batches", json=body)
    answer.raise_for_status()
    batch: dict[str, Any] = answer.json()
    return batch


def _small_batch(client: httpx.Client, seed: int) -> float:
    """How long a small batch takes [ms]."""
    points = [{"road.seed": 1_000_000 + seed * SMALL + number} for number in range(SMALL)]
    begin = time.perf_counter()
    body = {"strategies": ["lv"], "sweep": {"list": points}}
    job = client.post("/api/v1/batches", json=body).raise_for_status().json()
    client.get(f"/api/v1/batches/{job['id']}/events", timeout=120).raise_for_status()  # a stream that ends with it
    return 1000 * (time.perf_counter() - begin)


def _seconds(batch: dict[str, Any]) -> float:
    begin, end = (datetime.fromisoformat(batch[name]) for name in ("started_at", "finished_at"))
    return (end - begin).total_seconds()


@contextmanager
def _going_on(client: httpx.Client) -> Iterator[None]:
    batch = _submitted(client, MANY, 3)
    while client.get(f"/api/v1/batches/{batch['id']}").json()["done"] < FEW // 2:
        time.sleep(0.2)
    yield
    state = client.post(f"/api/v1/batches/{batch['id']}/cancel").json()["state"]
    if state != "cancelled":
        raise RuntimeError("The batch ended before the probes did")


class _Probes:
    """What-ifs on roads nobody drove before."""

    def __init__(self, client: httpx.Client) -> None:
        self._client = client
        self._seed = 100_000

    def take(self, count: int) -> float:
        """Median time of one [ms]; the first few are not counted."""
        times = []
        for _ in range(count + 3):
            self._seed += 1
            body = {"scenario": {"road": {"seed": self._seed}}, "strategies": TOGETHER}
            times.append(timed(self._client, "POST", "/api/v1/runs", json=body)[0])
        return statistics.median(times[3:])


def _exports(client: httpx.Client, batch_id: str) -> None:
    path = f"/api/v1/batches/{batch_id}"
    rows: list[list[Any]] = []
    for name in ("json", "csv"):
        taken, answer = timed(client, "GET", f"{path}/results", params={"format": name})
        rows.append([f"results as {name}", taken, len(answer.content) / 2**20])
    taken, answer = timed(client, "GET", f"{path}/table", params={"figures": "bump.body_acceleration.peak"})
    rows.append(["table, one figure", taken, len(answer.content) / 2**20])
    table(f"Reading {MANY} rows", ["", "ms", "MiB"], rows)
