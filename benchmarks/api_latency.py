"""The service, a real process on a free port: what HTTP, the store and the workers add to the core's own time."""

import os
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from time import perf_counter
from typing import Any

import httpx

from benchmarks.timing import table

QUIET = {"RIDELAB_LOG_LEVEL": "warning"}  # the figures are what is printed
TOGETHER = ["lv", "lqr", "passive"]
REPEATS = 15
STORED = 300  # the system counts hundredths of a second


@contextmanager
def server(prefix: Sequence[str] = (), **environment: str) -> Iterator[httpx.Client]:
    """A client of a server with an empty store; the server ends with the block.

    Args:
        prefix: A command that starts it.
        environment: Further variables of its environment.
    """
    with tempfile.TemporaryDirectory() as folder:
        command = [*prefix, sys.executable, "-m", "backend", "--port", "0", "--data-dir", folder]
        process = subprocess.Popen(  # noqa: S603 - our own module, no shell
            command,
            stdout=subprocess.PIPE,
            text=True,
            cwd=Path(__file__).parents[1],
            env={**os.environ, **QUIET, **environment},
        )
        try:
            address = next(iter(process.stdout or [])).split()[-1]
            with httpx.Client(base_url=address, timeout=60, trust_env=False) as client:
                yield client
        finally:
            process.terminate()
            process.wait(15)


def timed(client: httpx.Client, method: str, path: str, **options: Any) -> tuple[float, httpx.Response]:
    """Milliseconds of one request, its body read, and the answer."""
    begin = perf_counter()
    answer = client.request(method, path, **options)
    taken = (perf_counter() - begin) * 1000
    answer.raise_for_status()
    return taken, answer


def run() -> None:
    """Print the table."""
    with server() as client:
        rows = []
        first, answer = timed(client, "POST", "/api/v1/runs", json={"scenario": {}, "strategies": TOGETHER})
        rows.append(["POST /runs, first of all", first, _compute_ms(answer), first - _compute_ms(answer)])
        fresh = [_new_run(client, seed) for seed in range(1, REPEATS + 1)]
        rows.append(["POST /runs, new road", *_medians(fresh)])
        stored = []
        for seed in range(1, REPEATS + 1):
            taken, _ = timed(client, "POST", "/api/v1/runs", json=_request(seed))
            stored.append((taken, 0.0))
        rows.append(["POST /runs, stored", *_medians(stored)])
        run_id = answer.json()["id"]
        rows.append(
            [
                "GET /runs/{id}",
                *_medians([(timed(client, "GET", f"/api/v1/runs/{run_id}")[0], 0.0) for _ in range(REPEATS)]),
            ]
        )
        live = []
        for i in range(REPEATS):
            body = {"scenario": {"road": {"bump": {"height": 0.08 + i / 1000}}}, "strategies": TOGETHER}
            taken, answer = timed(client, "POST", "/api/v1/live", json=body)
            live.append((taken, _compute_ms(answer)))
        rows.append(["POST /live, another height", *_medians(live)])
        places = [timed(client, "GET", f"{_instants(run_id)}&position={90 + i / 10}")[0] for i in range(100)]
        processor = [
            ["POST /runs, stored", _processor_ms(client, "POST", "/api/v1/runs", json=_request(1))],
            ["GET /runs/{id}", _processor_ms(client, "GET", f"/api/v1/runs/{run_id}")],
        ]
    print(f"\n{1000 / statistics.mean(places[1:]):.0f} instants a second under one moving cursor (goal: 10)")
    table("The service: lv + lqr + passive, medians", ["", "ms", "computing, ms", "on top, ms"], rows)
    table("The service's own processor time of a stored answer", ["", "ms"], processor)


def _instants(run_id: str) -> str:
    """The address of a run's instants."""
    return f"/api/v1/runs/{run_id}/instant?strategy=lv"


def _processor_ms(client: httpx.Client, method: str, path: str, **options: Any) -> float:
    """Processor time that the service takes for such a request, its workers apart [ms]."""
    begin = _processor_seconds(client)
    for _ in range(STORED):
        timed(client, method, path, **options)
    return 1000 * (_processor_seconds(client) - begin) / STORED


def _processor_seconds(client: httpx.Client) -> float:
    lines = client.get("/metrics").text.splitlines()
    return float(next(line.split()[1] for line in lines if line.startswith("process_cpu_seconds_total")))


def _request(seed: int) -> dict[str, Any]:
    return {"scenario": {"road": {"seed": 5000 + seed}}, "strategies": TOGETHER}


def _new_run(client: httpx.Client, seed: int) -> tuple[float, float]:
    taken, answer = timed(client, "POST", "/api/v1/runs", json=_request(seed))
    return taken, _compute_ms(answer)


def _compute_ms(answer: httpx.Response) -> float:
    return sum(float(entry["compute_ms"]) for entry in answer.json()["strategies"].values() if not entry.get("cached"))


def _medians(pairs: list[tuple[float, float]]) -> tuple[float, float, float]:
    taken, computing = (statistics.median(column) for column in zip(*pairs, strict=True))
    return taken, computing, taken - computing
