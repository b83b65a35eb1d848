"""The largest value that keeps a limit, over HTTP, by the client and at the command line: known answers."""

import math
from typing import Any

import httpx
import pytest

from backend.runs.solve.models import Solution
from sim_core.comparison.intervals import mean_with_interval
from tests import wording

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


@pytest.mark.parametrize("asked", wording.asked_in("solutions"))
def test_what_a_value_does_not_say_is_said_beside_it(client: httpx.Client, asked: Any) -> None:
    """Random variation, a field that is not read or cannot be driven, a metric that is not monotone, all or none."""
    answer = ask(client, **HEIGHT | asked).json()
    parts = ("value", "resolution", "warnings", "errors")
    wording.check("solutions", asked, {name: answer[name] for name in parts if name in answer})
