"""The largest value that keeps a limit, over HTTP, by the client and at the command line: known answers."""

import itertools
import math
from typing import Any

import httpx
import pytest

from backend.runs.solve.models import Solution
from sim_core.comparison.intervals import mean_with_interval

PEAK = "bump.body_acceleration.peak"
SMOOTH = {"road": {"roughness": 0, "length": 118}}
HEIGHT = {"scenario": SMOOTH, "strategy": "passive", "field": "road.bump.height", "metric": PEAK}


def ask(client: httpx.Client, **body: Any) -> httpx.Response:
    return client.post("/api/v1/solve", json=body)


def solved(client: httpx.Client, **body: Any) -> Solution:
    response = ask(client, **body)
    assert response.status_code == 200, response.text
    return Solution.model_validate(response.json())


def peaks(client: httpx.Client, scenario: Any, strategy: str, roads: int = 1) -> list[float]:
    """The metric on each road, from runs of one road each."""
    values = []
    for seed in range(1, roads + 1):
        road = {**scenario.get("road", {}), "seed": seed}
        body = {"scenario": {**scenario, "road": road}, "strategies": [strategy]}
        metrics = client.post("/api/v1/runs", json=body).json()["strategies"][strategy]["metrics"]
        values.append(metrics["bump"]["body_acceleration"]["peak"])
    return values


def test_a_linear_cars_peak_is_proportional_to_the_bump(client: httpx.Client) -> None:
    """On a smooth road the passive car's answer is limit over slope."""
    (at_one_cm,) = peaks(client, {"road": {**SMOOTH["road"], "bump": {"height": 0.01}}}, "passive")
    solution = solved(client, **HEIGHT, range=[0.01, 0.2], limit=4)
    expected = 4 / (at_one_cm / 0.01)
    assert solution.bracket[0] <= expected <= solution.bracket[1]
    assert solution.bracket[1] - solution.value == pytest.approx(1e-4), "the step is range / 1000, rounded down"
    assert solution.metric_value == pytest.approx(solution.value / 0.01 * at_one_cm, rel=1e-9)
    assert (solution.unit, solution.metric_unit, solution.warnings, solution.interval) == ("m", "m/s^2", [], None)
    assert solution.runs == len(solution.tried) <= 22
    assert (solution.resolution, solution.resolved_value) == (None, solution.value), "no roughness, no luck"


@pytest.mark.parametrize(
    "asked",
    [
        {"scenario": {"road": SMOOTH["road"], "estimation": {"kind": "kalman"}}, "range": [0.01, 0.2]},
        {"field": "road.roughness", "range": [0, 2.56e-4]},
    ],
)
def test_noise_and_a_roughness_that_is_tried_are_luck_on_a_smooth_road_too(
    client: httpx.Client, asked: dict[str, Any]
) -> None:
    assert solved(client, **{**HEIGHT, **asked}, limit=6.5).resolution == 7


def test_its_run_opens_and_asked_again_all_is_stored(client: httpx.Client, worker_calls: list[tuple[Any, ...]]) -> None:
    body = {**HEIGHT, "range": [0.02, 0.19], "limit": 3}
    first = ask(client, **body).json()
    run = client.get(f"/api/v1/runs/{first['run_id']}").json()
    assert run["scenario"]["road"]["bump"]["height"] == first["value"]
    assert run["strategies"]["passive"]["metrics"]["bump"]["body_acceleration"]["peak"] == first["metric_value"]
    worker_calls.clear()
    assert ask(client, **body).json() == first
    assert not worker_calls


def test_digits_that_one_road_does_not_resolve_are_not_said(client: httpx.Client) -> None:
    """The passive car's peak is nearly proportional to the bump: 7 % of it either way are 7 % of the height."""
    body = {**HEIGHT, "scenario": {"road": {"length": 118}}, "range": [0.01, 0.2]}
    one = solved(client, **body, limit=4)
    assert (one.resolution, one.bracket[0]) == (7, one.value)
    assert one.warnings
    assert one.resolved_value == math.floor(one.value * 1000) / 1000 < one.value
    three = solved(client, **body, limit=4, roads=3)
    assert three.interval is not None
    assert three.resolution == pytest.approx(100 * (three.interval.high - three.interval.mean) / three.interval.high)
    assert len(str(three.resolved_value)) < len(str(three.value))
    assert solved(client, **{**body, "metric": "travel_time"}, limit=100).resolution is None


def test_how_fast_over_a_hump_so_that_the_interval_keeps_the_limit(client: httpx.Client) -> None:
    scenario = {"road": {"length": 118, "bump": {"shape": "circular", "height": 0.075, "width": 3.7}}}
    speed = {"scenario": scenario, "strategy": "passive", "field": "speed.initial_speed_kmh", "metric": PEAK}
    solution = solved(client, **speed, range=[10, 40], limit=3.5, roads=3)
    assert (solution.unit, solution.runs) == ("km/h", 3 * len(solution.tried))
    values = {}
    for value in solution.bracket:
        at = {**scenario, "speed": {"initial_speed_kmh": value}}
        values[value] = mean_with_interval(peaks(client, at, "passive", roads=3))
    below, above = (values[value] for value in solution.bracket)
    assert below.high <= 3.5 < above.high
    assert solution.metric_value == below.high
    assert solution.interval is not None
    assert solution.interval.model_dump() == {"mean": below.value, "low": below.low, "high": below.high}
    assert client.get(f"/api/v1/runs/{solution.run_id}").json()["roads"] == 3
    alone = solved(client, **speed, range=[10, 40], limit=3.5)
    assert alone.value > solution.value, "one road's value has no interval to keep"


def test_a_metric_that_is_not_monotone_is_said(client: httpx.Client) -> None:
    """A long bump is a gentle one, but half a wavelength that meets both axles is worse than a shorter one."""
    body = {**HEIGHT, "field": "road.bump.width", "range": [0.5, 15]}
    widths = {each.value: each.metric_value for each in solved(client, **body, limit=20).tried}
    values = list(widths.values())
    assert any(a is not None and b is not None and a > b for a, b in itertools.pairwise(values))
    solution = solved(client, **body, limit=4)
    assert solution.value == 15
    last_over = max(value for value, peak in widths.items() if peak is not None and peak > 4)
    said = "\n".join(solution.warnings)
    assert "not monotone" in said
    assert f"to {last_over:g} m exceed it" in said


def test_all_of_a_range_or_none_of_it(client: httpx.Client) -> None:
    all_of_it = solved(client, **HEIGHT, range=[0.01, 0.02], limit=4)
    assert (all_of_it.value, all_of_it.bracket) == (0.02, (0.02, 0.02))
    assert all_of_it.warnings == []
    none_of_it = ask(client, **HEIGHT, range=[0.1, 0.2], limit=4)
    assert none_of_it.status_code == 422
    problem = none_of_it.json()
    assert problem["type"].endswith(":no-solution")
    (place,) = problem["errors"]
    assert place["pointer"] == "/range"
    assert place["message"].endswith("is at 0.1 m"), "the least"


def test_what_a_field_does_not_change_and_what_cannot_be_driven_is_said(client: httpx.Client) -> None:
    unread = solved(client, **{**HEIGHT, "field": "speed.target_speed_kmh"}, range=[10, 50], limit=20)
    assert "Passive does not use speed.target_speed_kmh" in unread.warnings[0]
    beyond = solved(client, **{**HEIGHT, "field": "road.bump.width"}, range=[10, 26], limit=4)
    assert beyond.bracket == (18, 18.01), "the road ends at 118 m"
    assert "The bump must end before the road does" in beyond.warnings[0]
    assert beyond.runs < len(beyond.tried)
