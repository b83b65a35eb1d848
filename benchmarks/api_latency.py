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
    """Print both tables."""
    with server() as client:
        _, answer = timed(client, "POST", "/api/v1/runs", json=_request(0))
        fresh = [timed(client, "POST", "/api/v1/runs", json=_request(seed)) for seed in range(1, REPEATS + 1)]
        live = [timed(client, "POST", "/api/v1/live", json=_request(seed)) for seed in range(-REPEATS, 0)]
        run_id = answer.json()["id"]
        processor = [
            ["POST /runs, stored", *_stored(client, "POST", "/api/v1/runs", json=_request(0))],
            ["GET /runs/{id}", *_stored(client, "GET", f"/api/v1/runs/{run_id}")],
        ]
    rows = [["POST /runs, new road", *_medians(fresh)], ["POST /live", *_medians(live)]]
    table("The service: lv + lqr + passive, medians", ["", "ms", "computing, ms", "on top, ms"], rows)
    table("A stored answer", ["", "median, ms", "the service's own processor time, ms"], processor)


def _stored(client: httpx.Client, method: str, path: str, **options: Any) -> tuple[float, float]:
    """Return how long such a request takes, and the processor time of the service, its workers apart [ms]."""
    begin = _processor_seconds(client)
    taken = statistics.median(timed(client, method, path, **options)[0] for _ in range(STORED))
    return taken, 1000 * (_processor_seconds(client) - begin) / STORED


def _processor_seconds(client: httpx.Client) -> float:
    lines = client.get("/metrics").text.splitlines()
    return float(next(line.split()[1] for line in lines if line.startswith("process_cpu_seconds_total")))


def _request(seed: int) -> dict[str, Any]:
    return {"scenario": {"road": {"seed": 5000 + seed}}, "strategies": TOGETHER}


def _medians(answers: list[tuple[float, httpx.Response]]) -> tuple[float, float, float]:
    taken = statistics.median(milliseconds for milliseconds, _ in answers)
    computing = statistics.median(
        sum(each["compute_ms"] for each in answer.json()["strategies"].values()) for _, answer in answers
    )
    return taken, computing, taken - computing
