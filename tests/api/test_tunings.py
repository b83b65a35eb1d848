"""Tunings over HTTP: values by hand, better than the paper on the training roads, limits kept, cancelled, resumed."""

import json
import math
import time
from statistics import fmean
from typing import Any

import httpx
import numpy as np
import pytest
from pydantic import TypeAdapter
from scipy import stats
from sqlalchemy import update
from sqlalchemy.exc import OperationalError

from backend.compute import WorkersBusyError
from backend.problems import ProblemError
from backend.store.tables import tunings
from backend.tuner import batching, driver, models
from backend.tuner.measure import Failure

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
SIGNALS = ("body_acceleration", "pitch_acceleration", "front_tyre_load", "rear_tyre_load")


def begin(client: httpx.Client, key: str | None = None, **more: Any) -> dict[str, Any]:
    headers = {"Idempotency-Key": key} if key else {}
    answer = client.post("/api/v1/tunings", json={**REQUEST, **more}, headers=headers)
    assert answer.status_code == 202, answer.text
    assert answer.headers["location"] == f"/api/v1/tunings/{answer.json()['id']}"
    found: dict[str, Any] = answer.json()
    return found


def get(client: httpx.Client, tuning_id: str, below: str = "") -> Any:
    return client.get(f"/api/v1/tunings/{tuning_id}{below}").raise_for_status().json()


def wait_for(client: httpx.Client, tuning_id: str, generation: int = 1000, seconds: float = 120) -> dict[str, Any]:
    """The tuning once it has ended, or has so many generations."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        found: dict[str, Any] = get(client, tuning_id)
        if found["state"] not in ("queued", "running") or found["generation"] >= generation:
            return found
        time.sleep(0.05)
    raise TimeoutError("The tuning did not end")


def trials(client: httpx.Client, tuning_id: str) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = get(client, tuning_id, "/trials")["trials"]
    return found


def figures(client: httpx.Client, strategy: str, seed: int, weights: Any = None) -> dict[str, Any]:
    """One run alone, through POST /runs."""
    scenario = {**SCENARIO, "road": {**SCENARIO["road"], "seed": seed}}
    if weights is not None:
        scenario["lqr"] = {"weights": weights}
    body = {"scenario": scenario, "strategies": [strategy]}
    found: dict[str, Any] = client.post("/api/v1/runs", json=body).raise_for_status().json()["strategies"][strategy]
    return found


def eq_16(ours: dict[str, Any], passive: dict[str, Any]) -> float:
    """By hand, with q = (1, 2, 1)."""
    a, r, f1, f2 = (ours["metrics"]["whole"][signal]["rms"] for signal in SIGNALS)
    a0, r0, f10, f20 = (passive["metrics"]["whole"][signal]["rms"] for signal in SIGNALS)
    return float((a / a0) ** 2 + 2 * (r / r0) ** 2 + (f1**2 + f2**2) / (f10**2 + f20**2))


def by_hand(client: httpx.Client, weights: Any, seeds: list[int]) -> tuple[list[float], list[float], list[float]]:
    """Both objectives and the limited figure on each road."""
    ours = [figures(client, "lqr", seed, weights) for seed in seeds]
    passive = [figures(client, "passive", seed) for seed in seeds]
    first = [eq_16(one, other) for one, other in zip(ours, passive, strict=True)]
    second = [each["metrics"]["bump"]["front_tyre_load"]["peak"] for each in ours]
    return first, second, [each["comfort"]["actuator_peak_power"] for each in ours]


@pytest.fixture(scope="module")
def tuning(client: httpx.Client) -> dict[str, Any]:
    """A finished one of two objectives."""
    answer = begin(client, "the-first")
    assert (answer["state"], answer["trials"]["done"], answer["paper"]) == ("queued", 0, None)
    found = wait_for(client, answer["id"])
    assert found["state"] == "done", found["reason"]
    return found


def test_answers_have_their_models_shape(client: httpx.Client, tuning: dict[str, Any]) -> None:
    for model, found in (
        (models.Tuning, tuning),
        (models.Tuning, begin(client, "the-first")),
        (models.Tunings, client.get("/api/v1/tunings").json()),
        (models.Trials, get(client, tuning["id"], "/trials")),
    ):
        shaped = TypeAdapter(model).validate_json(json.dumps(found))
        assert set(found) == set(model.model_fields), "nothing more, nothing less"
        assert shaped


def test_every_generation_is_there_and_told(client: httpx.Client, tuning: dict[str, Any]) -> None:
    assert tuning["trials"]["total"] == tuning["trials"]["done"] == 24
    assert tuning["generation"] == len(tuning["history"]) == 3
    found = trials(client, tuning["id"])
    assert [each["number"] for each in found] == list(range(24))
    assert [each["generation"] for each in found] == [0] * 8 + [1] * 8 + [2] * 8
    assert sum(each["feasible"] for each in found) == tuning["trials"]["feasible"] == tuning["history"][-1]["feasible"]
    volumes = [each["hypervolume"] for each in tuning["history"]]
    assert volumes == sorted(volumes)
    assert 0 < volumes[-1] < 1
    told = events(client, tuning["id"])
    assert [event["id"] for event in told] == list(range(1, len(told) + 1))
    kinds = [(event["event"], event["state"], event["step"]) for event in told]
    assert kinds == [
        ("state", "queued", "search"),
        ("state", "running", "search"),
        *[("progress", "running", "search")] * 3,
        ("state", "running", "comparison"),
        ("state", "done", "comparison"),
    ]
    assert events(client, tuning["id"], headers={"Last-Event-ID": "4"}) == told[4:]


def events(client: httpx.Client, tuning_id: str, **options: Any) -> list[dict[str, Any]]:
    text = client.get(f"/api/v1/tunings/{tuning_id}/events", timeout=120, **options).text
    found = []
    for block in text.split("\n\n"):
        fields = dict(line.split(": ", 1) for line in block.splitlines() if not line.startswith(":"))
        if "data" in fields:
            found.append({"id": int(fields["id"]), "event": fields["event"], **json.loads(fields["data"])})
    return found


def test_the_papers_weights_come_first_then_the_scenarios_own(client: httpx.Client, tuning: dict[str, Any]) -> None:
    assert tuning["paper"]["weights"] == {"lqr.weights": [1, 1, 1]}
    assert tuning["own"]["weights"] == {"lqr.weights": [2, 1, 1]}
    assert [tuning["paper"], tuning["own"]] == trials(client, tuning["id"])[:2]
    assert tuning["search"] == {f"lqr.weights.{index}": [0.05, 50] for index in range(3)}


def test_values_are_what_runs_alone_give(client: httpx.Client, tuning: dict[str, Any]) -> None:
    for trial in (tuning["paper"], tuning["own"], *tuning["best"], tuning["knee"]):
        first, second, limited = by_hand(client, trial["weights"]["lqr.weights"], SEEDS)
        # Stored results, the same to the bit; the sums above round in another order.
        assert trial["values"] == pytest.approx([fmean(first), fmean(second)], rel=1e-13)
        assert trial["limits"] == [max(limited)]


def test_tuned_is_no_worse_than_the_paper_on_the_roads_trained_on(tuning: dict[str, Any]) -> None:
    assert tuning["paper"]["feasible"]
    for index in range(2):
        assert tuning["best"][index]["values"][index] < tuning["paper"]["values"][index], (
            "this search found better ones"
        )


def test_the_front_keeps_the_limit_and_nothing_betters_it(client: httpx.Client, tuning: dict[str, Any]) -> None:
    found = trials(client, tuning["id"])
    beyond = [each for each in found if each["limits"][0] > 2500]
    assert beyond, "the limit cuts"
    assert not any(each["feasible"] for each in beyond)
    feasible = [each for each in found if each["limits"][0] <= 2500]
    assert all(each["feasible"] for each in feasible)
    for member in tuning["front"]:
        assert member in feasible
        better = [each for each in feasible if np.all(np.array(each["values"]) <= member["values"])]
        assert [each["values"] for each in better] == [member["values"]] * len(better)
    assert tuning["knee"] in tuning["front"]
    assert [tuning["front"][0], tuning["front"][-1]] == tuning["best"]


def test_the_comparison_by_hand(client: httpx.Client, tuning: dict[str, Any]) -> None:
    comparison = tuning["comparison"]
    assert [each["key"] for each in comparison["figures"]][:3] == ["objectives.0", "objectives.1", "limits.0"]
    assert len(comparison["figures"]) == 3 + 8
    assert comparison["points"][0]["roles"][0] == "paper"
    roles = {role for point in comparison["points"] for role in point["roles"]}
    assert roles == {"paper", "scenario", "best.0", "best.1", "knee"}
    base = by_hand(client, [1, 1, 1], FRESH)
    t = stats.t.ppf(0.975, len(FRESH) - 1)
    for point in comparison["points"]:
        ours = by_hand(client, point["weights"]["lqr.weights"], FRESH)
        for index in range(2):
            found = point["fresh"][f"objectives.{index}"]
            assert found["mean"] == pytest.approx(fmean(ours[index]), rel=1e-13)
            assert found["worst"] == pytest.approx(max(ours[index]), rel=1e-13)
            if point["verdict"] is None:
                assert found["change"] is None
                continue
            values, others = np.array(ours[index]), np.array(base[index])
            ratio = values.mean() / others.mean()
            half = t * stats.sem((values - ratio * others) / others.mean())
            expected = {"value": ratio - 1, "low": ratio - half - 1, "high": ratio + half - 1}
            assert found["change"] == pytest.approx({key: 100 * each for key, each in expected.items()}, rel=1e-9)
            sure = {"better": ratio + half < 1, "worse": ratio - half > 1, "unclear": abs(ratio - 1) <= half}
            assert sure[point["verdict"][index]]


def test_the_same_request_gives_the_same_trials(client: httpx.Client, tuning: dict[str, Any]) -> None:
    again = wait_for(client, begin(client, "another-key")["id"])
    assert again["id"] != tuning["id"]
    assert trials(client, again["id"]) == trials(client, tuning["id"])
    same = ("best", "knee", "front", "history")
    assert [again[name] for name in same] == [tuning[name] for name in same]
    other = wait_for(client, begin(client, seed=6, trials=8)["id"])
    assert trials(client, other["id"])[2:] != trials(client, tuning["id"])[2:8]


def test_a_repeated_key_answers_the_same_tuning_and_another_body_is_refused(
    client: httpx.Client, tuning: dict[str, Any]
) -> None:
    assert begin(client, "the-first") == tuning
    answer = client.post("/api/v1/tunings", json={**REQUEST, "trials": 25}, headers={"Idempotency-Key": "the-first"})
    assert answer.status_code == 409


def test_one_that_is_done_goes_on_with_more_trials(client: httpx.Client) -> None:
    short = wait_for(client, begin(client, trials=8)["id"])
    path = f"/api/v1/tunings/{short['id']}/resume"
    assert client.post(path).status_code == 409
    refused = client.post(path, params={"trials": 7})
    assert (refused.status_code, refused.json()["errors"][0]["parameter"]) == (422, "trials")
    assert client.post(path, params={"trials": 24}).json()["comparison"] is None
    longer = wait_for(client, short["id"])
    assert (longer["state"], longer["trials"]["done"]) == ("done", 24)
    whole = wait_for(client, begin(client, "the-first")["id"])
    assert trials(client, short["id"]) == trials(client, whole["id"]), "as if it had been asked for at once"
    assert longer["comparison"]["points"] == whole["comparison"]["points"]


def test_cancel_takes_two_seconds_and_resume_loses_nothing(client: httpx.Client) -> None:
    wanted = {"objectives": [{"kind": "paper"}], "limits": [], "trials": 4000, "scenario": {**SCENARIO, "lqr": {}}}
    tuning_id = begin(client, **wanted)["id"]
    path = f"/api/v1/tunings/{tuning_id}"
    wait_for(client, tuning_id, generation=2)
    assert client.post(f"{path}/resume").json()["state"] == "running", "it has not ended: nothing to do"
    assert client.post(f"{path}/resume", params={"trials": 4001}).status_code == 409
    begun = time.monotonic()
    cancelled = client.post(f"{path}/cancel").json()
    assert cancelled["state"] == "cancelled"
    batch = client.get(f"/api/v1/batches/{cancelled['batch']}").json()
    assert batch["state"] in ("cancelled", "done")
    assert time.monotonic() - begun < 2
    assert client.post(f"{path}/cancel").json() == cancelled, "cancelling again changes nothing"
    done = cancelled["trials"]["done"]
    client.post(f"{path}/resume", params={"trials": done + 8}).raise_for_status()
    resumed = wait_for(client, tuning_id)
    assert (resumed["state"], resumed["trials"]["done"], resumed["own"]) == ("done", done + 8, None)
    whole = wait_for(client, begin(client, **{**wanted, "trials": done + 8})["id"])
    assert trials(client, tuning_id) == trials(client, whole["id"])
    assert resumed["history"] == whole["history"]
    assert (resumed["knee"], len(resumed["front"]), len(resumed["best"])) == (None, 1, 1)


def test_a_batch_cancelled_from_outside_is_a_reason_and_resume_goes_on(client: httpx.Client) -> None:
    tuning_id = begin(client, trials=1000, limits=[], objectives=[{"kind": "peaks"}])["id"]
    while (found := get(client, tuning_id))["state"] != "failed":
        assert found["state"] in ("queued", "running")
        if found["batch"] is not None:
            client.post(f"/api/v1/batches/{found['batch']}/cancel")
    assert found["reason"] == "One of its batches was cancelled"
    client.post(f"/api/v1/tunings/{tuning_id}/resume", params={"trials": 16 + found["trials"]["done"]})
    assert wait_for(client, tuning_id)["state"] == "done"


def test_a_smooth_road_has_no_share_of_the_passive_cars(client: httpx.Client) -> None:
    smooth = {**SCENARIO, "road": {**SCENARIO["road"], "roughness": 0}}
    wanted = {"scenario": smooth, "objectives": [{"kind": "paper", "window": "rough_road"}], "limits": []}
    failed = wait_for(client, begin(client, **wanted)["id"])
    assert failed["state"] == "failed"
    assert "body acceleration is zero (rough road)" in failed["reason"]
    assert failed["front"] == failed["history"] == []
    assert failed["best"] == [None]


def failing(monkeypatch: pytest.MonkeyPatch, *positions: int) -> None:
    """These runs of every batch count as failed, as runs that the core refuses or that lose their process do."""
    measure = batching._measure

    def measured(rows: Any, *more: Any) -> Any:
        lost = Failure(reason="The computation ended unexpectedly, twice")
        return [
            lost if row.position in positions else each for row, each in zip(rows, measure(rows, *more), strict=True)
        ]

    monkeypatch.setattr(batching, "_measure", measured)


def test_failed_trials_say_why_and_the_others_count(client: httpx.Client, monkeypatch: pytest.MonkeyPatch) -> None:
    failing(monkeypatch, 7, 9)  # the second road of the fourth set of weights, and of the fifth
    found = wait_for(client, begin(client, trials=8)["id"])
    assert (found["state"], found["trials"]["done"], found["trials"]["failed"]) == ("done", 6, 2)
    lost = [each for each in trials(client, found["id"]) if each["status"] == "failed"]
    assert [each["number"] for each in lost] == [3, 4]
    assert lost[0]["reason"] == "Road 2: The computation ended unexpectedly, twice"
    assert [lost[0][name] for name in ("feasible", "values", "limits")] == [False, None, None]
    # The comparison runs each set on two roads and four fresh ones: the next set's second and fourth are lost.
    paper, other, *_ = found["comparison"]["points"]
    assert (paper["failures"], [text[:8] for text in other["failures"]]) == ([], ["Road 2: ", "Road 12:"])
    first = other["training"]["objectives.0"]
    assert first["mean"] == first["worst"], "of the one road that is left"
    assert (first["change"]["low"], first["change"]["high"]) == (None, None)
    assert other["fresh"]["objectives.0"]["change"]["low"] is not None


def test_where_nothing_can_run_the_tuning_fails_with_the_reason(
    client: httpx.Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    failing(monkeypatch, *range(16))
    found = wait_for(client, begin(client, trials=24)["id"])
    reason = "No set of weights could be run. Road 1: The computation ended unexpectedly, twice"
    assert (found["state"], found["reason"], found["generation"]) == ("failed", reason, 0)


def test_what_passes_is_waited_for_and_a_bug_is_a_reason(
    service: Any, client: httpx.Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    errors: list[Exception] = [
        ProblemError(503, "The service is full."),
        OperationalError("INSERT", {}, Exception("disk full")),
        WorkersBusyError(),
    ]
    create = service.app.state.batches.create

    async def unreliable(*args: Any) -> Any:
        if errors:
            raise errors.pop(0)
        return await create(*args)

    monkeypatch.setattr(driver, "PAUSE", 0.01)
    monkeypatch.setattr(service.app.state.batches, "create", unreliable)
    assert wait_for(client, begin(client, trials=8)["id"])["state"] == "done"
    errors.append(ValueError("a bug"))
    failed = wait_for(client, begin(client, trials=8)["id"])
    assert (failed["state"], failed["reason"]) == ("failed", driver.UNFORESEEN)
    errors.append(ProblemError(422, "It is too big now."))
    client.post(f"/api/v1/tunings/{failed['id']}/resume").raise_for_status()
    assert wait_for(client, failed["id"])["reason"] == "It is too big now."
    client.post(f"/api/v1/tunings/{failed['id']}/resume").raise_for_status()
    assert wait_for(client, failed["id"])["state"] == "done"


def test_a_limit_nothing_keeps_leaves_the_papers_weights_alone(client: httpx.Client) -> None:
    limits = [{"figure": "events.travel_exceeded_mm", "at_most": -1}]
    found = wait_for(client, begin(client, limits=limits, trials=16)["id"])
    assert (found["state"], found["trials"]["feasible"], found["trials"]["done"]) == ("done", 0, 16)
    assert (found["best"], found["front"], found["knee"]) == ([None, None], [], None)
    assert [point["roles"] for point in found["comparison"]["points"]] == [["paper"], ["scenario"]]
    assert found["history"][-1]["best"] == [None, None]
    assert found["history"][-1]["hypervolume"] == 0


def test_another_core_version_begins_anew(service: Any, client: httpx.Client, tuning: dict[str, Any]) -> None:
    again = wait_for(client, begin(client, trials=16)["id"])
    with service.app.state.store.writing() as connection:
        connection.execute(update(tunings).where(tunings.c.id == again["id"]).values(core_version="0.0.1"))
    client.post(f"/api/v1/tunings/{again['id']}/resume", params={"trials": 24}).raise_for_status()
    found = wait_for(client, again["id"])
    assert (found["core_version"], found["trials"]["done"], len(found["history"])) == (tuning["core_version"], 24, 3)
    assert trials(client, again["id"]) == trials(client, tuning["id"])
    assert [event["event"] for event in events(client, again["id"])].count("restart") == 1


def test_the_weights_of_lv_and_of_suspension_control(client: httpx.Client) -> None:
    wanted = {"limits": [], "trials": 3, "population": 3, "fresh_seeds": [11, 12], "seeds": [1]}
    chosen = {"mpc.stage_weights.bump.2": [0.5, 50], "mpc.deflection_weight": [1, 9]}
    found = wait_for(client, begin(client, strategy="lv", search=chosen, **wanted)["id"])
    assert found["state"] == "done", found["reason"]
    paper, *others = trials(client, found["id"])
    assert paper["weights"] == {
        "mpc.stage_weights.cruise": [8, 1, 1],
        "mpc.stage_weights.brake": [2, 6, 1],
        "mpc.stage_weights.bump": [1, 1, 6],
        "mpc.deflection_weight": 3,
    }
    for other in others:
        changed = {**other["weights"], "mpc.deflection_weight": 3, "mpc.stage_weights.bump": [1, 1, 6]}
        assert changed == paper["weights"]
        assert other["weights"]["mpc.stage_weights.bump"][:2] == [1, 1]
        assert 0.5 <= other["weights"]["mpc.stage_weights.bump"][2] <= 50
        assert 1 <= other["weights"]["mpc.deflection_weight"] <= 9
        assert other["values"] != paper["values"]
    single = wait_for(client, begin(client, strategy="suspension_only", **wanted)["id"])
    assert set(single["paper"]["weights"]) == {"mpc.road_weights.rough", "mpc.road_weights.bump"}


def test_a_dry_run_says_what_it_would_be_and_stores_nothing(client: httpx.Client) -> None:
    before = client.get("/api/v1/tunings", params={"limit": 500}).json()
    answer = client.post("/api/v1/tunings", json={**REQUEST, "dry_run": True})
    assert answer.status_code == 200
    found = answer.json()
    TypeAdapter(models.TuningEstimate).validate_python(found)
    # 24 sets on two roads, at most five compared on four fresh ones, and the passive car on all six.
    assert (found["runs"], found["generations"]) == (24 * 2 + 5 * 4 + 6, 3)
    assert 0 < found["estimated_seconds"] < math.inf
    assert client.get("/api/v1/tunings", params={"limit": 500}).json() == before


@pytest.mark.parametrize(
    ("body", "pointer"),
    [
        ({"strategy": "passive"}, "/strategy"),
        ({"objectives": [{"kind": "paper", "figure": "travel_time"}]}, "/objectives/0/figure"),
        ({"objectives": [{"kind": "figure", "figure": "no.such"}]}, "/objectives/0/figure"),
        ({"objectives": [{"kind": "paper"}, {"kind": "paper"}]}, "/objectives"),
        ({"limits": [{"figure": "travel_time", "at_most": "1"}]}, "/limits/0/at_most"),
        ({"search": {"mpc.stage_weights.bump.0": [0.1, 1]}}, "/search"),
        ({"search": {"<script>": [0.1, 1]}}, "/search"),
        ({"search": {"lqr.weights.0": [1, 0.1]}}, "/search/lqr.weights.0"),
        ({"fresh_seeds": [1, 11]}, "/fresh_seeds"),
        ({"seeds": [1, 1]}, "/seeds"),
        ({"trials": 5001}, "/trials"),
        ({"scenario": {"road": {"bump": {"height": 3}}}}, "/scenario/road/bump/height"),
        ({"scenario": {"road": {"length": 3000}, "mpc": {"solver": "osqp"}}, "strategy": "lv"}, "/scenario"),
        ({"weights": [1, 1, 1]}, ""),
        ({"seeds": list(range(200, 264)), "trials": 5000}, "/trials"),
    ],
)
def test_what_cannot_be_tuned_is_refused_with_its_place(
    client: httpx.Client, body: dict[str, Any], pointer: str
) -> None:
    answer = client.post("/api/v1/tunings", json={**REQUEST, **body})
    assert answer.status_code == 422, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    assert answer.json()["errors"][0]["pointer"] == pointer
    assert "<script>" not in answer.text


def test_unknown_ids_are_not_found(client: httpx.Client) -> None:
    for method, below in (
        ("GET", ""),
        ("GET", "/trials"),
        ("GET", "/events"),
        ("POST", "/cancel"),
        ("POST", "/resume"),
    ):
        assert client.request(method, f"/api/v1/tunings/{'x' * 22}{below}").status_code == 404
