"""How soon an idle service accepts batches and tunings, whatever they ask, in bodies of up to 1 MiB."""

import json
import statistics
import time
from collections.abc import Iterator
from typing import Any

import httpx

from benchmarks.api_latency import server, timed
from benchmarks.timing import table

LONGEST = 2**20  # of a body [bytes]
REPEATS = 20
REST = 0.5  # in which the service leaves off planning what was cancelled [s]


def run() -> None:
    """Print the table."""
    with server() as client:
        rows = [[name, f"{len(body) / 2**20:.2f}", *_accepted(client, path, body)] for name, path, body in _requests()]
    table(
        "Accepting batches and tunings (goal: 95 % within 100 ms)",
        ["", "MiB", "median, ms", "95 %, ms"],
        rows,
    )


def _requests() -> Iterator[tuple[str, str, bytes]]:
    two = [{"road.seed": i, "road.bump.height": round(0.05 + i / 1e6, 6)} for i in range(21_000)]
    sweeps = {
        "a hypercube of 100,000 points": {
            "latin_hypercube": {"ranges": {"road.bump.height": [0.05, 0.15]}, "samples": 100_000}
        },
        "a grid of 100,000 values": {"grid": {"vehicle.body_mass": [round(600 + i / 1000, 3) for i in range(100_000)]}},
        "a list of 21,000 points of two fields": {"list": two},
        "a list of 50,000 points of one field": {"list": [{"road.seed": i} for i in range(50_000)]},
    }
    for name, sweep in sweeps.items():
        yield name, "/batches", _body({"strategies": ["passive"], "sweep": sweep})
    yield "a tuning", "/tunings", _body({"strategy": "lv"}).ljust(LONGEST)


def _body(request: dict[str, Any]) -> bytes:
    return json.dumps(request, separators=(",", ":")).encode()


def _accepted(client: httpx.Client, path: str, body: bytes) -> tuple[float, float]:
    times = [_once(client, path, body) for _ in range(REPEATS)]
    return statistics.median(times), statistics.quantiles(times, n=20)[-1]


def _once(client: httpx.Client, path: str, body: bytes) -> float:
    """Return how long it takes until the answer is there [ms]; with an idempotency key, which is looked for first."""
    headers = {"Content-Type": "application/json", "Idempotency-Key": f"key-{time.monotonic_ns()}"}
    taken, answer = timed(client, "POST", f"/api/v1{path}", content=body, headers=headers)
    client.post(f"/api/v1{path}/{answer.json()['id']}/cancel").raise_for_status()
    time.sleep(REST)  # the service is idle again
    return taken
