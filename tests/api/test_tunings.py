"""Tunings over HTTP: values by hand, no worse than the paper where trained, within limits, validated."""

from statistics import fmean
from typing import Any

import httpx
import pytest

from backend.tunings.space import road
from tests.api.tuning import FRESH, SCENARIO, SEEDS, begin, events, trials, wait_for
from tests.servers.batches import rows

SHORT: dict[str, Any] = {"limits": [], "trials": 3, "population": 3, "fresh_seeds": [11, 12], "seeds": [1]}
SIGNALS = ("body_acceleration", "pitch_acceleration", "front_tyre_load", "rear_tyre_load")


def figures(client: httpx.Client, strategy: str, seed: int, weights: Any = None) -> Any:
    """One run alone, through POST /runs."""
    scenario = {**SCENARIO, "road": {**SCENARIO["road"], "seed": seed}}
    if weights is not None:
        scenario["lqr"] = {"weights": weights}
    body = {"scenario": scenario, "strategies": [strategy]}
    return client.post("/api/v1/runs", json=body).raise_for_status().json()["strategies"][strategy]


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
    answer = begin(client, "the-one-read")
    assert (answer["state"], answer["trials"]["done"], answer["paper"]) == ("planning", 0, None)
    finished = wait_for(client, answer["id"])
    assert finished["state"] == "done", finished["reason"]
    return finished


def test_every_generation_is_stored_and_has_an_event(client: httpx.Client, tuning: dict[str, Any]) -> None:
    assert tuning["trials"]["total"] == tuning["trials"]["done"] == 24
    assert tuning["generation"] == len(tuning["history"]) == 3
    every = trials(client, tuning["id"])
    assert [each["number"] for each in every] == list(range(24))
    assert [each["generation"] for each in every] == [0] * 8 + [1] * 8 + [2] * 8
    assert sum(each["feasible"] for each in every) == tuning["trials"]["feasible"] == tuning["history"][-1]["feasible"]
    assert all(each["feasible"] == (each["limits"][0] <= 2500) for each in every)
    assert not all(each["feasible"] for each in every), "the limit cuts"
    assert [tuning["front"][0], tuning["front"][-1]] == tuning["best"]
    assert tuning["knee"] in tuning["front"]
    volumes = [each["hypervolume"] for each in tuning["history"]]
    assert volumes == sorted(volumes)
    assert 0 < volumes[-1] < 1
    heard = [(event["event"], event["state"], event["step"]) for event in events(client, tuning["id"])]
    assert heard[3:] == [
        *[("progress", "running", "search")] * 3,
        ("state", "running", "comparison"),
        ("state", "done", "comparison"),
    ]


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


def test_the_comparison_by_hand(client: httpx.Client, tuning: dict[str, Any]) -> None:
    comparison = tuning["comparison"]
    assert [each["key"] for each in comparison["figures"]][:3] == ["objectives.0", "objectives.1", "limits.0"]
    assert len(comparison["figures"]) == 3 + 8
    assert comparison["points"][0]["roles"][0] == "paper"
    roles = {role for point in comparison["points"] for role in point["roles"]}
    assert roles == {"paper", "scenario", "best.0", "best.1", "knee"}
    for point in comparison["points"]:
        ours = by_hand(client, point["weights"]["lqr.weights"], FRESH)
        for index in range(2):
            compared = point["fresh"][f"objectives.{index}"]
            assert compared["mean"] == pytest.approx(fmean(ours[index]), rel=1e-13)
            assert compared["worst"] == pytest.approx(max(ours[index]), rel=1e-13)
            assert (compared["change"] is None) == (point["verdict"] is None) == ("paper" in point["roles"])


def test_a_tunings_batches_are_there_but_not_among_those_that_people_handed_in(
    client: httpx.Client, tuning: dict[str, Any]
) -> None:
    body = {"scenario": SCENARIO, "strategies": ["passive"], "sweep": {"list": [{}]}}
    asked = client.post("/api/v1/batches", json=body, headers={"Idempotency-Key": "tuning-x"}).json()["id"]
    listed = {batch["id"] for batch in client.get("/api/v1/batches", params={"limit": 500}).json()["batches"]}
    assert asked in listed
    assert tuning["comparison"]["batch"] not in listed
    batch = client.get(f"/api/v1/batches/{tuning['comparison']['batch']}").json()
    assert (batch["state"], batch["total"]) == ("done", len(tuning["comparison"]["points"]) * (len(SEEDS) + len(FRESH)))


def test_a_limit_nothing_keeps_leaves_the_papers_weights_alone(client: httpx.Client) -> None:
    limits = [{"figure": "events.travel_exceeded_mm", "at_most": -1}]
    tuning = wait_for(client, begin(client, limits=limits, trials=16)["id"])
    assert (tuning["state"], tuning["trials"]["feasible"], tuning["trials"]["done"]) == ("done", 0, 16)
    assert (tuning["best"], tuning["front"], tuning["knee"]) == ([None, None], [], None)
    assert [point["roles"] for point in tuning["comparison"]["points"]] == [["paper"], ["scenario"]]
    assert tuning["history"][-1]["best"] == [None, None]
    assert tuning["history"][-1]["hypervolume"] == 0


@pytest.mark.parametrize(
    ("asked", "names"),
    [
        ({"strategy": "suspension_only"}, {"mpc.road_weights.rough", "mpc.road_weights.bump"}),
        (
            {"strategy": "lv", "search": {"mpc.stage_weights.bump.2": [0.5, 50], "mpc.deflection_weight": [1, 9]}},
            {f"mpc.stage_weights.{stage}" for stage in ("cruise", "brake", "bump")} | {"mpc.deflection_weight"},
        ),
    ],
)
def test_each_strategy_has_weights_of_its_own(client: httpx.Client, asked: dict[str, Any], names: set[str]) -> None:
    tuning = wait_for(client, begin(client, **SHORT, **asked)["id"])
    assert tuning["state"] == "done", tuning["reason"]
    assert set(tuning["paper"]["weights"]) == names
    paper, other, _ = trials(client, tuning["id"])
    assert other["values"] != paper["values"]


@pytest.mark.thorough
def test_on_uncertain_cars_each_road_has_its_own_and_a_quantile_is_minimised(client: httpx.Client) -> None:
    uncertain: dict[str, Any] = {
        "search": {"mpc.prediction_horizon": [20, 40]},
        "previews": ["none", "obstacle"],
        "uncertain": True,
    }
    drawn = wait_for(client, begin(client, strategy="lv", quantile=1, **uncertain, **(SHORT | {"seeds": [1, 2]}))["id"])
    assert (drawn["state"], drawn["uncertain"], drawn["quantile"]) == ("done", True, 1), drawn["reason"]
    paper, *others = trials(client, drawn["id"])
    assert (paper["weights"]["mpc.preview"], paper["weights"]["mpc.prediction_horizon"]) == ("lookahead", 30)
    assert {each["weights"]["mpc.preview"] for each in others} <= {"none", "obstacle"}
    masses = [row["mismatch.body_mass"] for row in rows(client, drawn["comparison"]["batch"])[:2]]
    assert masses == [road({"uncertain": True}, seed)["mismatch.body_mass"] for seed in (1, 2)]
    measured = drawn["comparison"]["points"][0]["training"]["objectives.1"]
    assert measured["quantile"] == measured["worst"] == paper["values"][1]
