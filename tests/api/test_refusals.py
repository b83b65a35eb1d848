"""What cannot be used is refused with 422, at its place in the body or by its parameter."""

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
    ("path", "change", "pointer"),
    [
        ("runs", {"scenario": {"road": {"length": "150"}}}, "/scenario/road/length"),
        ("runs", {"scenario": {"road": {"length": int("9" * 308)}}}, "/scenario/road/length"),
        ("runs", {"scenario": {"hook": {"semi_active": "on"}}}, "/scenario/hook/semi_active"),
        ("runs", {"scenario": {"road": {"roughness": "I"}}}, "/scenario/road/roughness"),
        ("runs", {"scenario": {"road": {"bump": {"my colour": 1}}}}, "/scenario/road/bump"),
        ("runs", {"scenario": {"lqr.weights": [1, 1]}}, "/scenario/lqr.weights/2"),
        ("runs", {"scenario": {"road": {"bump.height": 1}}}, "/scenario/road/bump.height"),
        ("runs", {"scenario": {"road": {"bump": {"start": 149}}}}, "/scenario/road/bump/start"),
        ("runs", {"scenario": {"lqr": {"weights": [1, 1]}}}, "/scenario/lqr/weights/2"),
        (
            "runs",
            fuzzy(output=[{"name": "a", "function": "trimf", "corners": [2, 1, 3]}]),
            "/scenario/fuzzy/output/0/corners",
        ),
        ("fuzzy", fuzzy(rules=[{"if": {"distance": "O"}, "then": "x"}]), "/scenario/fuzzy/rules/0/then"),
        ("runs", fuzzy(rules=[{"if": {}, "then": "V"}]), "/scenario/fuzzy/rules/0/if"),
        ("runs", {"strategies": []}, "/strategies"),
        ("runs", {"strategies": ["teleport"]}, "/strategies/0"),
        ("runs", {"strategies": ["passive", MISSING]}, "/strategies"),
        ("runs", {"strategies": ["recording:../x"]}, "/strategies/0"),
        ("runs", {"strategies": [MISSING], "roads": 2}, "/roads"),
        ("runs", second(), "/requirements/1/max"),
        ("runs", second(max=1, min=0), "/requirements/1/max"),
        ("runs", second(max=1, metric="bump.peak"), "/requirements/1/metric"),
        ("runs", second(max=1, strategies=["lqr", "skyhook"]), "/requirements/1/strategies/1"),
        ("runs", second(max_change=1, strategies=["passive"]), "/requirements/1/max_change"),
        ("runs", {"roads": 2, "baseline": "lv"}, "/baseline"),
        ("runs", {"baseline": "lv"}, "/baseline"),
        ("runs", {"roads": 2, "scenario": {"road": {"seed": 2**32 - 1}}}, "/roads"),
        ("runs", {"road": 2}, "/road"),
        ("live", {"scenario": {"road": {"bump": {"hight": 1}}}}, "/scenario/road/bump/hight"),
        ("live", fuzzy(rules=RULES), "/scenario/fuzzy/rules/1/if/speed"),
        ("live", {"strategies": [MISSING]}, "/strategies/0"),
        ("frequency", {"strategies": [MISSING]}, "/strategies/0"),
        ("frequency", {"stage": "jump"}, "/stage"),
        ("batches", {"strategies": ["lv", MISSING], "sweep": {"list": [{}]}}, "/strategies/1"),
        ("tunings", {"strategy": MISSING}, "/strategy"),
        ("tunings", {"objectives": [{"kind": "figure", "figure": "no.such"}]}, "/objectives/0/figure"),
        ("tunings", {"objectives": [{"kind": "paper"}, {"kind": "peaks", "windows": "bump"}]}, "/objectives/1/windows"),
        ("tunings", {"search": {"<script>": [0.1, 1]}}, "/search"),
        ("tunings", {"fresh_seeds": [1, 11]}, "/fresh_seeds"),
        ("tunings", {"seeds": list(range(200, 264)), "trials": 5000}, "/trials"),
        ("solve", {"field": "road.bump.hight"}, "/field"),
        ("solve", {"field": "road.bump.shape"}, "/field"),
        ("solve", {"metric": "bump.nothing"}, "/metric"),
        ("solve", {"metric": "events.ecu_most_iterations"}, "/metric"),
        ("solve", HELD, "/metric"),
        ("solve", second(min=0), "/limit"),
        ("solve", {**HELD, **second(max=1, strategies=["lqr"])}, "/requirements/1/strategies"),
        ("solve", {**HELD, **second(max_change=1)}, "/requirements/1/max_change"),
        ("solve", {"strategy": MISSING}, "/strategy"),
        ("solve", {"strategy": "fast"}, "/strategy"),
        ("solve", {"range": [0.2, 0.1]}, "/range"),
        ("solve", {"range": [0, 5e-324]}, "/range"),
        ("solve", {"range": [0.1, 3]}, "/range/1"),
        ("solve", {"field": "road.bump.count", "range": [1.5, 3]}, "/range/0"),
        ("solve", {"scenario": {"road": ROAD}, "field": "road.bump.width", "range": [50, 60]}, "/range"),
        ("vehicles/from-data-sheet", {"front_axle_load": 60}, "/front_axle_load"),
        ("vehicles/from-data-sheet", {"rear_frequency": 9}, "/rear_frequency"),
        ("links", {"run_id": None}, "/run_id"),
        ("links", {"batch_id": NOBODY}, "/run_id"),
        ("links", {"run_id": NOBODY}, "/run_id"),
        ("links", {"run_id": None, "batch_id": NOBODY}, "/batch_id"),
        ("links", {"view": {"my colour": "dark"}}, "/view"),
        ("links", {"view": {"strategies": ["lv", "teleport"]}}, "/view/strategies/1"),
        ("links", {"view": {"baseline": "teleport"}}, "/view/baseline"),
        ("links", {"view": {"zoom": [2, 2]}}, "/view/zoom"),
        ("links", {"view": {"pins": [PIN]}}, "/view/pins/0/run"),
        ("links", {"run_id": None, "batch_id": NOBODY, "view": {"pins": []}}, "/view/pins"),
        ("links", {"run_id": None, "batch_id": NOBODY, "view": {"differences": True}}, "/view/differences"),
        ("links", {"view": {"pins": [PIN], "reference": "B" * 22}}, "/view/reference"),
        ("links", {"view": {"y": "bump.body_acceleration.peak"}}, "/view/y"),
    ],
)
def test_a_value_is_refused_at_its_place(
    client: httpx.Client, run: dict[str, Any], path: str, change: dict[str, Any], pointer: str
) -> None:
    body = {**BODIES[path], **change}
    if body.get("run_id") == "RUN":
        body["run_id"] = run["id"]
    answer = client.post(f"/api/v1/{path}", json=body)
    kind = str(answer.json()["type"]).rpartition(":")[2]
    assert kind in ("invalid-request", "unknown", "cost-limit")
    problem = check(answer, 422, kind)
    assert problem.errors[0].pointer == pointer
    assert "my colour" not in answer.text, "only what looks like a name is repeated"
    assert "<script>" not in answer.text


@pytest.mark.parametrize(
    ("path", "query", "parameter"),
    [
        ("runs/RUN/series", {"strategy": "lv,teleport"}, "strategy"),
        ("runs/RUN/series", {"strategy": "speed_only"}, "strategy"),
        ("runs/RUN/series", {"strategy": "lv", "signals": "speed,colour"}, "signals"),
        ("runs/RUN/series", {}, "strategy"),
        ("runs/RUN/series", {"strategy": "lv", "format": "parquet"}, "format"),
        ("runs/RUN/report.html", {"baseline": "speed_only"}, "baseline"),
        ("runs/RUN/differences", {"baseline": ""}, "baseline"),
        ("runs/RUN/instant", {"strategy": "skyhook", "position": "50"}, "strategy"),
        ("runs/RUN/instant", {"strategy": "lv"}, "position"),
        ("runs/RUN/instant", {"strategy": "lv", "position": "50", "time": "3"}, "time"),
        ("runs/RUN/instant", {"strategy": "lv", "position": "131"}, "position"),
        ("batches", {"cursor": "yesterday"}, "cursor"),
        ("paper", {"preview": "red"}, "preview"),
        ("paper", {"seeds": "3"}, "seeds"),
        ("paper", {"colour": "red"}, "colour"),
    ],
)
def test_a_parameter_is_refused_by_its_name(
    client: httpx.Client, run: dict[str, Any], path: str, query: dict[str, str], parameter: str
) -> None:
    answer = client.get(f"/api/v1/{path.replace('RUN', run['id'])}", params=query)
    problem = check(answer, 422, "invalid-request")
    assert [error.parameter for error in problem.errors] == [parameter]
    assert "red" not in answer.text.replace("required", "")
