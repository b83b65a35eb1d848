"""A service killed in the middle of a tuning: it completes, with the trials it would have had."""

import time
from typing import Any

SCENARIO = {"road": {"length": 63, "bump": {"start": 45}}, "speed": {"detection_distance": 40}}
REQUEST = {
    "scenario": SCENARIO,
    "strategy": "lqr",
    "objectives": [{"kind": "peaks"}, {"kind": "figure", "figure": "rough_road.front_tyre_load.rms"}],
    "seeds": [1, 2],
    "fresh_seeds": [11, 12],
    "trials": 40,
    "population": 8,
}


def begin(service: Any) -> str:
    answer = service.client.post("/api/v1/tunings", json=REQUEST)
    assert answer.status_code == 202, answer.text
    return str(answer.json()["id"])


def wait_for(service: Any, tuning_id: str, generation: int, seconds: float = 90) -> dict[str, Any]:
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        found: dict[str, Any] = service.client.get(f"/api/v1/tunings/{tuning_id}").json()
        if found["state"] not in ("queued", "running") or found["generation"] >= generation:
            return found
        time.sleep(0.01)
    raise TimeoutError("The tuning does not get on")


def test_a_killed_service_goes_on_to_the_same_trials(start: Any) -> None:
    quick = {"RIDELAB_WORKERS": "1", "RIDELAB_BATCH_WORKERS": "1"}
    service = start(**quick)
    tuning_id = begin(service)
    assert wait_for(service, tuning_id, 2)["state"] == "running"
    service.kill()
    service = start(**quick)
    ended = wait_for(service, tuning_id, 1000)
    assert (ended["state"], ended["trials"]["done"], ended["generation"]) == ("done", 40, 5)
    whole = wait_for(service, begin(service), 1000)
    trials = [
        service.client.get(f"/api/v1/tunings/{each}/trials").json()["trials"] for each in (tuning_id, whole["id"])
    ]
    assert trials[0] == trials[1]
    assert [each["number"] for each in trials[0]] == list(range(40))
    assert ended["history"] == whole["history"]
    assert ended["comparison"]["points"] == whole["comparison"]["points"]
