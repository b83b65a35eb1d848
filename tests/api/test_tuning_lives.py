"""What can happen to a tuning: refused, repeated, cancelled, resumed, in trouble of every kind, another core."""

import asyncio
import math
from typing import Any

import httpx
import pytest
from pydantic import TypeAdapter
from sqlalchemy.exc import OperationalError

from backend.errors import BusyError, ConflictError, CostLimitError, WorkersBusyError
from backend.jobs import scheduler
from backend.store import StoredJob
from backend.tunings import answers, steps
from backend.tunings.measure import Failure
from tests.api.conftest import Service
from tests.api.tuning import REQUEST, SCENARIO, begin, get, trials, wait_for


def test_one_that_is_done_goes_on_with_more_trials(client: httpx.Client) -> None:
    short = wait_for(client, begin(client, trials=8)["id"])
    path = f"/api/v1/tunings/{short['id']}/resume"
    assert client.post(path).status_code == 409
    refused = client.post(path, params={"trials": 7})
    assert (refused.status_code, refused.json()["errors"][0]["parameter"]) == (422, "trials")
    assert client.post(path, params={"trials": 16}).json()["comparison"] is None
    longer = wait_for(client, short["id"])
    assert (longer["state"], longer["trials"]["done"]) == ("done", 16)
    whole = wait_for(client, begin(client, "as-asked-at-once", trials=16)["id"])
    assert trials(client, short["id"]) == trials(client, whole["id"]), "as if it had been asked for at once"
    assert longer["comparison"]["points"] == whole["comparison"]["points"]


def test_cancel_takes_effect_at_once_and_resume_loses_nothing(client: httpx.Client) -> None:
    options: dict[str, Any] = {"objectives": [{"kind": "paper"}], "limits": [], "scenario": {**SCENARIO, "lqr": {}}}
    tuning_id = begin(client, **options, trials=4000)["id"]
    path = f"/api/v1/tunings/{tuning_id}"
    wait_for(client, tuning_id, generation=2)
    assert client.post(f"{path}/resume", params={"trials": 4001}).status_code == 409, "it has not ended"
    cancelled = client.post(f"{path}/cancel").json()
    assert get(client, tuning_id)["state"] == cancelled["state"] == "cancelled"
    assert client.get(f"/api/v1/batches/{cancelled['batch']}").json()["state"] in ("cancelled", "done")
    total = cancelled["trials"]["done"] + 8
    client.post(f"{path}/resume", params={"trials": total}).raise_for_status()
    resumed = wait_for(client, tuning_id)
    assert (resumed["state"], resumed["trials"]["done"], resumed["own"]) == ("done", total, None)
    whole = wait_for(client, begin(client, **options, trials=total)["id"])
    assert trials(client, tuning_id) == trials(client, whole["id"])
    assert resumed["history"] == whole["history"]
    assert (resumed["knee"], len(resumed["front"]), len(resumed["best"])) == (None, 1, 1)


def test_of_two_that_resume_it_with_other_trials_one_is_refused(service: Service) -> None:
    job_id = wait_for(service, begin(service, trials=8)["id"])["id"]

    async def together() -> Any:
        both = (service.services.tunings.resume(job_id, trials, None) for trials in (500, 600))
        return await asyncio.gather(*both, return_exceptions=True)

    refused, accepted = sorted(service.inside(together()), key=lambda each: isinstance(each, StoredJob))
    assert isinstance(refused, ConflictError)
    assert isinstance(accepted, StoredJob)
    assert get(service, job_id)["trials"]["total"] == accepted.total
    service.post(f"/api/v1/tunings/{job_id}/cancel").raise_for_status()


@pytest.mark.thorough
def test_a_batch_cancelled_from_outside_is_a_reason_and_resume_goes_on(client: httpx.Client) -> None:
    tuning_id = begin(client, trials=1000, population=128, limits=[], objectives=[{"kind": "peaks"}])["id"]
    while (tuning := get(client, tuning_id))["state"] != "failed":
        assert tuning["state"] in ("planning", "queued", "running")
        if tuning["batch"] is not None:
            client.post(f"/api/v1/batches/{tuning['batch']}/cancel")
    assert tuning["reason"] == "One of its batches was cancelled"
    client.post(f"/api/v1/tunings/{tuning_id}/resume", params={"trials": 16 + tuning["trials"]["done"]})
    assert wait_for(client, tuning_id)["state"] == "done"


def failing(monkeypatch: pytest.MonkeyPatch, *positions: int) -> None:
    """These runs of every batch count as failed, as runs that the core refuses or that lose their process do."""
    measure = steps._measure

    def measured(rows: Any, *more: Any) -> Any:
        lost = Failure(reason="The computation ended unexpectedly, twice")
        return [
            lost if row.position in positions else each for row, each in zip(rows, measure(rows, *more), strict=True)
        ]

    monkeypatch.setattr(steps, "_measure", measured)


def test_failed_trials_say_why_and_the_others_count(client: httpx.Client, monkeypatch: pytest.MonkeyPatch) -> None:
    failing(monkeypatch, 7, 9)  # the second road of the fourth set of weights, and of the fifth
    tuning = wait_for(client, begin(client, trials=8)["id"])
    assert (tuning["state"], tuning["trials"]["done"], tuning["trials"]["failed"]) == ("done", 6, 2)
    lost = [each for each in trials(client, tuning["id"]) if each["status"] == "failed"]
    assert [each["number"] for each in lost] == [3, 4]
    assert lost[0]["reason"] == "Road 2: The computation ended unexpectedly, twice"
    assert [lost[0][name] for name in ("feasible", "values", "limits")] == [False, None, None]
    # The comparison runs each set on two training and four validation roads: the next set's second and fourth are lost.
    paper, other, *_ = tuning["comparison"]["points"]
    assert (paper["failures"], [text[:8] for text in other["failures"]]) == ([], ["Road 2: ", "Road 12:"])
    first = other["training"]["objectives.0"]
    assert first["mean"] == first["worst"], "of the one road that is left"
    assert (first["change"]["low"], first["change"]["high"]) == (None, None)
    assert other["fresh"]["objectives.0"]["change"]["low"] is not None


def test_where_nothing_can_run_the_tuning_fails_with_the_reason(
    client: httpx.Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    failing(monkeypatch, *range(16))
    tuning = wait_for(client, begin(client, trials=16)["id"])
    reason = "No set of weights could be run. Road 1: The computation ended unexpectedly, twice"
    assert (tuning["state"], tuning["reason"], tuning["generation"]) == ("failed", reason, 0)


def test_what_passes_is_waited_for_and_a_bug_is_a_reason(service: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    errors: list[Exception] = [
        BusyError("The service is full."),
        OperationalError("INSERT", {}, Exception("disk full")),
        WorkersBusyError(),
    ]
    create = service.services.batches.create

    async def unreliable(*args: Any, **names: Any) -> Any:
        if errors:
            raise errors.pop(0)
        return await create(*args, **names)

    monkeypatch.setattr(scheduler, "PAUSE_AFTER_FAILURE", 0.01)
    monkeypatch.setattr(service.services.batches, "create", unreliable)
    assert wait_for(service, begin(service, trials=8)["id"])["state"] == "done"
    errors.append(ValueError("a bug"))
    failed = wait_for(service, begin(service, trials=8)["id"])
    assert (failed["state"], failed["reason"]) == ("failed", scheduler.UNFORESEEN)
    errors.append(CostLimitError("It is too big now."))
    service.post(f"/api/v1/tunings/{failed['id']}/resume").raise_for_status()
    assert wait_for(service, failed["id"])["reason"] == "It is too big now."
    service.post(f"/api/v1/tunings/{failed['id']}/resume").raise_for_status()
    assert wait_for(service, failed["id"])["state"] == "done"


def test_a_dry_run_says_what_it_would_be_and_stores_nothing(client: httpx.Client) -> None:
    before = client.get("/api/v1/tunings", params={"limit": 500}).json()
    answer = client.post("/api/v1/tunings", json={**REQUEST, "dry_run": True})
    assert answer.status_code == 200
    estimate = answer.json()
    TypeAdapter(answers.TuningEstimate).validate_python(estimate)
    # 24 sets on two roads, at most five compared on four validation roads, and the passive car on all six.
    assert (estimate["runs"], estimate["generations"]) == (24 * 2 + 5 * 4 + 6, 3)
    assert 0 < estimate["estimated_seconds"] < math.inf
    assert client.get("/api/v1/tunings", params={"limit": 500}).json() == before
