"""A small tuning over HTTP, for tests: the request, and what waits for it and reads it."""

from typing import Any

import httpx

from tests.api.streams import read_events
from tests.servers.process import wait_until

# Nobody else's road, and a short one.
SCENARIO: dict[str, Any] = {
    "road": {"length": 61, "bump": {"start": 45}},
    "speed": {"detection_distance": 40},
    "lqr": {"weights": [2, 1, 1]},
}
SEEDS, FRESH = [1, 2], [11, 12, 13, 14]
REQUEST: dict[str, Any] = {
    "scenario": SCENARIO,
    "strategy": "lqr",
    "objectives": [{"kind": "paper", "q": [1, 2, 1]}, {"kind": "figure", "figure": "bump.front_tyre_load.peak"}],
    "limits": [{"figure": "comfort.actuator_peak_power", "at_most": 2500}],
    "seeds": SEEDS,
    "fresh_seeds": FRESH,
    "trials": 24,
    "population": 8,
    "seed": 5,
}


def begin(client: httpx.Client, key: str | None = None, **more: Any) -> Any:
    headers = {"Idempotency-Key": key} if key else {}
    answer = client.post("/api/v1/tunings", json={**REQUEST, **more}, headers=headers)
    assert answer.status_code == 202, answer.text
    assert answer.headers["location"] == f"/api/v1/tunings/{answer.json()['id']}"
    return answer.json()


def get(client: httpx.Client, tuning_id: str, below: str = "") -> Any:
    return client.get(f"/api/v1/tunings/{tuning_id}{below}").raise_for_status().json()


def wait_for(client: httpx.Client, tuning_id: str, generation: int = 1000) -> dict[str, Any]:
    """The tuning once it has ended, or has so many generations."""
    tuning: dict[str, Any] = {}

    def far_enough() -> bool:
        tuning.update(get(client, tuning_id))
        return tuning["state"] not in ("planning", "queued", "running") or tuning["generation"] >= generation

    wait_until(far_enough, "the tuning gets there")
    return tuning


def trials(client: httpx.Client, tuning_id: str) -> Any:
    return get(client, tuning_id, "/trials")["trials"]


def events(client: httpx.Client, tuning_id: str, **options: Any) -> list[dict[str, Any]]:
    return read_events(client, f"/api/v1/tunings/{tuning_id}/events", **options)
