"""Batches: the service's rate against the core's own on one core, its memory, and what-ifs while a batch goes on."""

import multiprocessing
import statistics
import time
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime
from typing import Any

import httpx
import psutil

from backend.jobs.sweep.plan import scenario_at
from backend.jobs.sweep.sweeps import Sweep, points
from benchmarks.api_latency import TOGETHER, server, timed
from benchmarks.timing import table
from sim_core.scenario import Scenario
from sim_core.simulate import simulate

FEW, MANY, SMALL = 1000, 10_000, 4
SAMPLE = 300  # runs that tell the core's own rate
PROBES = 40
RANGES = {"road.bump.height": [0.05, 0.15], "mpc.stage_weights.cruise.0": [1, 10], "mpc.stage_weights.bump.2": [1, 10]}


def sweep(samples: int, seed: int) -> dict[str, Any]:
    """Random heights and weights: every run has control laws of its own to work out."""
    return {"latin_hypercube": {"ranges": RANGES, "samples": samples, "seed": seed}}


def core_rate(seed: int) -> float:
    """LV runs a second of one process that does nothing else, over such a sweep."""
    base = Scenario().model_dump(mode="json")
    _, sweep_points = points(Sweep.model_validate(sweep(SAMPLE, seed)), base)
    scenarios = [scenario_at(base, changes) for changes in sweep_points]
    simulate(scenarios[0], "lv")
    begin = time.perf_counter()
    for scenario in scenarios:
        simulate(scenario, "lv").summary()
    return SAMPLE / (time.perf_counter() - begin)


def run() -> None:
    """Print the tables."""
    spawn = multiprocessing.get_context("spawn")
    with server() as client, spawn.Pool(1) as alone:
        family = psutil.Process(_server_pid())
        probes = _Probes(client)
        idle = probes.take(PROBES)
        rows, memory = [], {}
        for samples, seed in ((FEW, 1), (MANY, 2)):
            before = alone.apply(core_rate, (seed,))
            batch, memory[samples] = _followed(client, samples, seed, family)
            after = alone.apply(core_rate, (seed,))
            core, rate = (before + after) / 2, samples / _seconds(batch)
            rows.append([f"{samples} runs", rate, core, rate / core, 100 * rate / (2 * core)])
        table(
            "Batches of LV runs on two processes (the first one starts them), core rate before and after",
            ["", "runs/s", "one core alone, runs/s", "ratio", "of two cores, %"],
            rows,
        )
        table(
            "Memory of all processes at most",
            ["", "MiB", "against the first"],
            [[f"{samples} runs", peak, peak / memory[FEW]] for samples, peak in memory.items()],
        )
        small_alone = _small_batch(client, 4)
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
        _exports(client, batch["id"])


def _server_pid() -> int:
    (child,) = [each for each in psutil.Process().children() if "backend" in " ".join(each.cmdline())]
    return child.pid


def _followed(client: httpx.Client, samples: int, seed: int, family: psutil.Process) -> tuple[dict[str, Any], float]:
    """A finished batch, and the most memory that the service and its processes had [MiB]."""
    batch = _submitted(client, samples, seed)
    peak = 0.0
    while batch["state"] != "done":
        time.sleep(1)
        peak = max(peak, _memory(family))
        batch = client.get(f"/api/v1/batches/{batch['id']}").json()
    return batch, peak


def _memory(family: psutil.Process) -> float:
    total = 0
    for process in (family, *family.children(recursive=True)):
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
    for name in ("json", "csv", "parquet"):
        taken, answer = timed(client, "GET", f"{path}/results", params={"format": name})
        rows.append([f"results as {name}", taken, len(answer.content) / 2**20])
    taken, answer = timed(client, "GET", f"{path}/table", params={"figures": "bump.body_acceleration.peak"})
    rows.append(["table, one figure", taken, len(answer.content) / 2**20])
    table(f"Reading {MANY} rows", ["", "ms", "MiB"], rows)
