"""Batches: the service's rate on two cores against the core's own, small batches and what-ifs meanwhile."""

import multiprocessing
import os
import statistics
import time
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime
from typing import Any

import httpx
import psutil

from backend.batches.points import Sweep, points
from backend.compute.workers import BATCH_NICE
from backend.scenario_at import scenario_at
from benchmarks.api_latency import TOGETHER, server, timed
from benchmarks.timing import table
from sim_core import Scenario, simulate

MANY, SMALL = 10_000, 4
SAMPLE = 300  # runs that tell the core's own rate
PROBES = 40
RANGES = {"road.bump.height": [0.05, 0.15], "mpc.stage_weights.cruise.0": [1, 10], "mpc.stage_weights.bump.2": [1, 10]}


def sweep(samples: int, seed: int) -> dict[str, Any]:
    """Return random heights and weights: every run has control laws of its own to work out."""
    return {"latin_hypercube": {"ranges": RANGES, "samples": samples, "seed": seed}}


def core_rate(seed: int) -> tuple[float, float]:
    """Return the LV runs a second of one process over such a sweep, and its processor time a run [ms]."""
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
    with spawn.Pool(1, initializer=os.nice, initargs=(BATCH_NICE,)) as alone, server() as client:
        idle, small_alone = _what_if(client, 100_000), _small_batch(client, 4)
        before = alone.apply(core_rate, (2,))
        rate, processor = _measured(client, 2)
        core, own = ((one + other) / 2 for one, other in zip(before, alone.apply(core_rate, (2,)), strict=True))
        table(
            f"{MANY} LV runs stored, and one process that only computes such runs, before and after",
            ["", "runs/s", "processor ms a run"],
            [["the service on two cores", rate, processor], ["one process", core, own]],
        )
        print(f"  the service is {rate / core:.2f} times as fast as one process (goal: at least 1.9)")
        with _going_on(client):
            busy, small_beside = _what_if(client, 200_000), _small_batch(client, 5)
    rows = [
        ["POST /runs of lv + lqr + passive on a new road", idle, busy, busy / idle],
        [f"a batch of {SMALL} LV runs, from its 202 to its end", small_alone, small_beside, small_beside / small_alone],
    ]
    table(f"Beside {MANY} runs that go on, medians", ["", "alone, ms", "beside, ms", "ratio"], rows)


def _measured(client: httpx.Client, seed: int) -> tuple[float, float]:
    """Return the runs a second of a large batch, and the processor time of a run [ms]."""
    (server_process,) = [each for each in psutil.Process().children() if "backend" in " ".join(each.cmdline())]
    batch = _submitted(client, seed)
    processor = _processor_seconds(server_process)
    while batch["state"] != "done":
        time.sleep(1)
        batch = client.get(f"/api/v1/batches/{batch['id']}").json()
    begin, end = (datetime.fromisoformat(batch[name]) for name in ("started_at", "finished_at"))
    spent = 1000 * (_processor_seconds(server_process) - processor) / MANY
    return MANY / (end - begin).total_seconds(), spent


def _processor_seconds(service: psutil.Process) -> float:
    """Return what the service and its processes have used."""
    times = [process.cpu_times() for process in (service, *service.children(recursive=True))]
    return float(sum(each.user + each.system for each in times))


def _submitted(client: httpx.Client, seed: int) -> dict[str, Any]:
    answer = client.post("/api/v1/batches", json={"strategies": ["lv"], "sweep": sweep(MANY, seed)})
    batch: dict[str, Any] = answer.raise_for_status().json()
    return batch


def _small_batch(client: httpx.Client, seed: int) -> float:
    """Return how long a small batch takes [ms]."""
    points = [{"road.seed": 1_000_000 + seed * SMALL + number} for number in range(SMALL)]
    begin = time.perf_counter()
    body = {"strategies": ["lv"], "sweep": {"list": points}}
    job = client.post("/api/v1/batches", json=body).raise_for_status().json()
    client.get(f"/api/v1/batches/{job['id']}/events", timeout=120).raise_for_status()  # a stream that ends with it
    return 1000 * (time.perf_counter() - begin)


@contextmanager
def _going_on(client: httpx.Client) -> Iterator[None]:
    """Have a large batch computed meanwhile."""
    batch = _submitted(client, 3)
    while client.get(f"/api/v1/batches/{batch['id']}").json()["done"] < SAMPLE:
        time.sleep(0.2)
    yield
    state = client.post(f"/api/v1/batches/{batch['id']}/cancel").json()["state"]
    if state != "cancelled":
        raise RuntimeError("The batch ended before the probes did")


def _what_if(client: httpx.Client, first_seed: int) -> float:
    """Return the median time of a what-if on a road nobody drove before [ms]; the first few are not counted."""
    times = []
    for seed in range(first_seed, first_seed + PROBES + 3):
        body = {"scenario": {"road": {"seed": seed}}, "strategies": TOGETHER}
        times.append(timed(client, "POST", "/api/v1/runs", json=body)[0])
    return statistics.median(times[3:])
