"""What cannot be used is refused with 422, at its place in the body or by its parameter, in words that help."""

from typing import Any

import httpx
import pytest

from backend.http.openapi import EXAMPLES
from tests.api import tuning
from tests.api.conftest import ROAD
from tests.api.test_problems import SOLVE, check

NOBODY = "A" * 22
PIN = {"name": "soft", "run": NOBODY}
SHEET = EXAMPLES["DataSheet"]
BODIES: dict[str, dict[str, Any]] = {
    "runs": {"strategies": ["lqr", "passive"]},
    "live": {"strategies": ["lv"]},
    "frequency": {"strategies": ["lqr"]},
    "batches": {"strategies": ["lv"]},
    "tunings": tuning.REQUEST,
    "solve": SOLVE,
    "fuzzy": {},
    "vehicles/from-data-sheet": SHEET,
    "links": {"run_id": "RUN"},
}
HELD = {**SOLVE, "metric": None, "limit": None}  # a question about requirements
PEAK = {"metric": "bump.body_acceleration.peak"}
MISSING = "recording:" + NOBODY
UNDRIVEN = "A recording is taken by runs alone: nothing drives it"
RULES = [{"if": {"distance": "O"}, "then": "V"}, {"if": {"speed": "O"}, "then": "V"}]


def fuzzy(**parts: Any) -> dict[str, Any]:
    return {"scenario": {"fuzzy": parts}}


def second(**requirement: Any) -> dict[str, Any]:
    return {"requirements": [{**PEAK, "max": 1}, {**PEAK, **requirement}]}


@pytest.mark.parametrize(
    ("path", "change", "pointer", "said"),
    [
        ("runs", {"scenario": {"road": {"length": "150"}}}, "/scenario/road/length", "number"),
        ("runs", {"scenario": {"road": {"length": int("9" * 308)}}}, "/scenario/road/length", "less"),
        ("runs", {"scenario": {"hook": {"semi_active": "on"}}}, "/scenario/hook/semi_active", "true or false"),
        ("runs", {"scenario": {"hook": {"semi_active": 1}}}, "/scenario/hook/semi_active", "true or false"),
        ("runs", {"scenario": {"road": {"bump": {"height": 12}}}}, "/scenario/road/bump/height", "or equal to 1 m"),
        ("batches", {"sweep": {"grid": {"road.bump.height": [0.1, 2]}}}, "/sweep/grid/road.bump.height/1", "to 1 m"),
        ("runs", {"scenario": {"road": {"roughness": "I"}}}, "/scenario/road/roughness", "a road class of ISO 8608"),
        ("runs", {"scenario": {"road": {"bump": {"my colour": 1}}}}, "/scenario/road/bump", "Unknown field"),
        ("runs", {"scenario": {"road.bump.height": 12}}, "/scenario/road.bump.height", "or equal to 1 m"),
        ("runs", {"scenario": {"lqr.weights": [1, 1]}}, "/scenario/lqr.weights/2", "required"),
        (
            "runs",
            {"scenario": {"road": {"bump.height": 1}}},
            "/scenario/road/bump.height",
            '{"bump": {"height": ...}}',
        ),
        ("runs", {"scenario": {"road": {"bump": {"start": 149}}}}, "/scenario/road/bump/start", "before the road"),
        ("runs", {"scenario": {"lqr": {"weights": [1, 1]}}}, "/scenario/lqr/weights/2", "required"),
        (
            "runs",
            fuzzy(output=[{"name": "a", "function": "trimf", "corners": [2, 1, 3]}]),
            "/scenario/fuzzy/output/0/corners",
            "trimf takes three ascending corners, not all alike",
        ),
        (
            "runs",
            fuzzy(output=[{"name": "a", "function": "trimf", "corners": [1]}]),
            "/scenario/fuzzy/output/0/corners",
            "trimf takes three ascending corners",
        ),
        ("fuzzy", fuzzy(rules=[{"if": {"distance": "O"}, "then": "x"}]), "/scenario/fuzzy/rules/0/then", ""),
        ("runs", fuzzy(rules=[{"if": {}, "then": "V"}]), "/scenario/fuzzy/rules/0/if", ""),
        ("runs", {"scenario": []}, "/scenario", ""),
        ("runs", {"strategies": []}, "/strategies", ""),
        ("runs", {"strategies": "lv"}, "/strategies", 'a list: write ["lv"]'),
        ("batches", {"strategies": 1}, "/strategies", "a list"),
        ("runs", {"scenario": {"lqr": {"weights": "1"}}}, "/scenario/lqr/weights", "list"),
        ("runs", {"strategies": ["teleport"]}, "/strategies/0", ""),
        ("runs", {"strategies": ["passive", MISSING]}, "/strategies", ""),
        ("runs", {"strategies": ["recording:../x"]}, "/strategies/0", ""),
        ("runs", {"strategies": [MISSING], "roads": 2}, "/roads", ""),
        ("runs", second(), "/requirements/1/max", ""),
        ("runs", second(max=1, min=0), "/requirements/1/max", ""),
        ("runs", second(max=1, metric="bump.peak"), "/requirements/1/metric", ""),
        ("runs", second(max=1, strategies=["lqr", "skyhook"]), "/requirements/1/strategies/1", ""),
        ("runs", second(max_change=1, strategies=["passive"]), "/requirements/1/max_change", ""),
        ("runs", second(max="3"), "/requirements/1/max", ""),
        ("runs", {"roads": 0}, "/roads", "greater"),
        ("runs", {"roads": 51}, "/roads", "50"),
        ("runs", {"roads": 2, "baseline": "lv"}, "/baseline", "lqr, passive"),
        ("runs", {"baseline": "lv"}, "/baseline", "lqr, passive"),
        ("runs", {"roads": 2, "scenario": {"road": {"seed": 2**32 - 1}}}, "/roads", "seed"),
        ("runs", {"road": 2}, "/road", "road, perhaps roads; there are scenario, strategies"),
        (
            "live",
            {"scenario": {"road": {"bump": {"hight": 1}}}},
            "/scenario/road/bump/hight",
            "hight, perhaps height; there are shape, height, width, start",
        ),
        (
            "live",
            fuzzy(rules=RULES),
            "/scenario/fuzzy/rules/1/if/speed",
            "speed, perhaps speed_error; there are speed_error, distance",
        ),
        ("live", {"strategies": [MISSING]}, "/strategies/0", UNDRIVEN),
        ("frequency", {"strategies": [MISSING]}, "/strategies/0", UNDRIVEN),
        ("frequency", {"strategies": []}, "/strategies", ""),
        ("frequency", {"frequencies": [0]}, "/frequencies/0", ""),
        ("frequency", {"outputs": ["speed"]}, "/outputs/0", ""),
        ("frequency", {"stage": "jump"}, "/stage", ""),
        ("batches", {"strategies": ["lv", MISSING], "sweep": {"list": [{}]}}, "/strategies/1", UNDRIVEN),
        (
            "batches",
            {"sweep": {"grid": {"road.bump.hight": [0.1, 0.2]}}},
            "/sweep/grid/road.bump.hight",
            "road.bump.hight, perhaps road.bump.height or road.bump.",
        ),
        (
            "batches",
            {"sweep": {"list": [{"road.seed": 1}, {"rode.seed": 1}]}},
            "/sweep/list/1/rode.seed",
            "rode.seed, perhaps road.seed",
        ),
        ("batches", {"sweep": {"grid": {"height": [0.1]}}}, "/sweep/grid/height", "height, perhaps road.bump.height"),
        ("tunings", {"strategy": MISSING}, "/strategy", "Unknown strategy that can be tuned; there are lv"),
        ("tunings", {"objectives": [{"kind": "figure", "figure": "no.such"}]}, "/objectives/0/figure", ""),
        (
            "tunings",
            {"objectives": [{"kind": "paper"}, {"kind": "peaks", "windows": "bump"}]},
            "/objectives/1/windows",
            "windows, perhaps window; there are kind, q, window, figure",
        ),
        ("tunings", {"search": {"lqr.weight.0": [1, 2]}}, "/search/lqr.weight.0", "perhaps lqr.weights"),
        ("tunings", {"search": {"<script>": [0.1, 1]}}, "/search", ""),
        ("tunings", {"fresh_seeds": [1, 11]}, "/fresh_seeds", ""),
        ("tunings", {"scenario": {"road": {"bump": {"height": 3}}}}, "/scenario/road/bump/height", ""),
        ("tunings", {"seeds": list(range(200, 264)), "trials": 5000}, "/trials", ""),
        ("solve", {"field": "road.bump.hight"}, "/field", "perhaps road.bump.height"),
        ("solve", {"field": "road.bump.shape"}, "/field", "its values have no order"),
        ("solve", {"field": "road.seed"}, "/field", "its values have no order"),
        ("solve", {"metric": "bump.nothing"}, "/metric", "Unknown metric"),
        ("solve", {"metric": "events.target_reached"}, "/metric", "Unknown metric"),
        ("solve", {"metric": "events.ecu_most_iterations"}, "/metric", "Passive has no"),
        ("solve", HELD, "/metric", ""),
        ("solve", second(min=0), "/limit", ""),
        ("solve", {**HELD, **second(max=1, strategies=["lqr"])}, "/requirements/1/strategies", ""),
        ("solve", {**HELD, **second(max_change=1)}, "/requirements/1/max_change", ""),
        ("solve", {"strategy": MISSING}, "/strategy", UNDRIVEN),
        ("solve", {"strategy": "fast"}, "/strategy", "Unknown strategy"),
        ("solve", {"range": [0.2, 0.1]}, "/range", "the first smaller"),
        ("solve", {"range": [0, 5e-324]}, "/range", "as wide as 1e-09 of its larger end"),
        ("solve", {"field": "road.bump.width", "range": [1, 1.0000000000000002]}, "/range", "as wide as 1e-09"),
        ("solve", {"range": [0.1, 3]}, "/range/1", "less than or equal to 1 m"),
        ("solve", {"range": [0.1]}, "/range/1", "required"),
        ("solve", {"field": "road.bump.count", "range": [1.5, 3]}, "/range/0", "integer"),
        ("solve", {"scenario": {"road": ROAD}, "field": "road.bump.width", "range": [50, 60]}, "/range", "must end"),
        ("solve", {"roads": 51}, "/roads", "50"),
        ("solve", {"limit": "4"}, "/limit", "number"),
        ("solve", {"scenario": {"road": {"bump": {"height": 3}}}}, "/scenario/road/bump/height", "1"),
        ("vehicles/from-data-sheet", {"front_axle_load": 60}, "/front_axle_load", ""),
        ("vehicles/from-data-sheet", {"rear_frequency": 9}, "/rear_frequency", ""),
        ("vehicles/from-data-sheet", {"wheelbase": None}, "/wheelbase", ""),
        ("vehicles/from-data-sheet", {"colour": 1}, "/colour", ""),
        ("links", {"run_id": None}, "/run_id", ""),
        ("links", {"batch_id": NOBODY}, "/run_id", ""),
        ("links", {"run_id": NOBODY}, "/run_id", ""),
        ("links", {"run_id": None, "batch_id": NOBODY}, "/batch_id", ""),
        ("links", {"view": {"theme": "dark"}}, "/view/theme", ""),
        ("links", {"view": {"my colour": "dark"}}, "/view", ""),
        ("links", {"view": {"strategies": ["lv", "teleport"]}}, "/view/strategies/1", ""),
        ("links", {"view": {"baseline": "teleport"}}, "/view/baseline", ""),
        ("links", {"view": {"zoom": [2, 2]}}, "/view/zoom", ""),
        ("links", {"view": {"zoom": [1, True]}}, "/view/zoom/1", ""),
        ("links", {"view": {"pins": [{**PIN, "name": ""}]}}, "/view/pins/0/name", ""),
        ("links", {"view": {"pins": [PIN]}}, "/view/pins/0/run", ""),
        ("links", {"view": {"pins": [PIN] * 9}}, "/view/pins", ""),
        ("links", {"run_id": None, "batch_id": NOBODY, "view": {"pins": []}}, "/view/pins", ""),
        ("links", {"run_id": None, "batch_id": NOBODY, "view": {"differences": True}}, "/view/differences", ""),
        ("links", {"view": {"pins": [PIN], "reference": "B" * 22}}, "/view/reference", ""),
        ("links", {"view": {"x": "road.bump.height"}}, "/view/x", ""),
        ("links", {"view": {"threshold": "high"}}, "/view/threshold", ""),
        ("links", {"view": {"y": "bump.body_acceleration.peak"}}, "/view/y", ""),
    ],
)
def test_a_value_is_refused_at_its_place(
    client: httpx.Client, run: dict[str, Any], path: str, change: dict[str, Any], pointer: str, said: str
) -> None:
    body = {**BODIES[path], **change}
    if body.get("run_id") == "RUN":
        body["run_id"] = run["id"]
    answer = client.post(f"/api/v1/{path}", json=body)
    kind = str(answer.json()["type"]).rpartition(":")[2]
    assert kind in ("invalid-request", "unknown", "cost-limit")
    problem = check(answer, 422, kind)
    assert problem.errors[0].pointer == pointer
    assert said in problem.errors[0].message
    assert "my colour" not in answer.text, "only what looks like a name is repeated"
    assert "<script>" not in answer.text


@pytest.mark.parametrize(
    ("path", "query", "parameter"),
    [
        ("runs/RUN/series", {"strategy": "lv,teleport"}, "strategy"),
        ("runs/RUN/series", {"strategy": "speed_only"}, "strategy"),
        ("runs/RUN/series", {"strategy": "lv", "signals": "speed,colour"}, "signals"),
        ("runs/RUN/series", {"strategy": "lv", "points": "1"}, "points"),
        ("runs/RUN/series", {"strategy": "lv", "format": "xls"}, "format"),
        ("runs/RUN/report.html", {"baseline": "speed_only"}, "baseline"),
        ("runs/RUN/differences", {"baseline": ""}, "baseline"),
        ("runs/RUN/instant", {"strategy": "skyhook", "position": "50"}, "strategy"),
        ("runs/RUN/instant", {"strategy": "nobody", "position": "50"}, "strategy"),
        ("runs/RUN/instant", {"strategy": "lv"}, "position"),
        ("runs/RUN/instant", {"strategy": "lv", "position": "50", "time": "3"}, "time"),
        ("runs/RUN/instant", {"strategy": "lv", "position": "131"}, "position"),
        ("runs/RUN/instant", {"strategy": "lv", "time": "-1"}, "time"),
        ("runs/RUN/instant", {"strategy": "lv", "position": "nan"}, "position"),
        ("batches", {"cursor": "yesterday"}, "cursor"),
        ("paper", {"preview": "red"}, "preview"),
        ("paper", {"seeds": "3"}, "seeds"),
        ("paper", {"colour": "red"}, "colour"),
        ("paper", {"interpretation": "red"}, "interpretation"),
        ("paper", {"first_seed": "0"}, "first_seed"),
    ],
)
def test_a_parameter_is_refused_by_its_name(
    client: httpx.Client, run: dict[str, Any], path: str, query: dict[str, str], parameter: str
) -> None:
    answer = client.get(f"/api/v1/{path.replace('RUN', run['id'])}", params=query)
    problem = check(answer, 422, "invalid-request")
    assert [error.parameter for error in problem.errors] == [parameter]
    assert "red" not in answer.text.replace("required", "")
