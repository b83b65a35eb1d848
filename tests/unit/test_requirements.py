"""Requirements on one road: the page judges them under a moving slider, and reads these same cases."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

import pytest

from sim_core import Requirement, RidelabError
from sim_core.comparison.requirements import judge, share_used

CASES = json.loads((Path(__file__).parents[1] / "data" / "requirement_cases.json").read_text())


@pytest.mark.parametrize("case", CASES, ids=[case["case"] for case in CASES])
def test_one_road_is_judged_as_in_the_page(case: dict[str, Any]) -> None:
    requirements = [Requirement(**each) for each in case["requirements"]]
    driven = {name: [summary] for name, summary in case["summaries"].items()}
    answers = [asdict(each) for each in judge(requirements, driven, case["baseline"])]
    keys = ("strategy", "result", "value", "baseline")
    assert [{key: answer[key] for key in keys} for answer in answers] == case["results"]


@pytest.mark.parametrize(
    ("limit", "time", "share"),
    [
        ({"max": 10}, 9.0, 0.9),
        ({"max": 10}, 12.0, 1.2),
        ({"max": 0}, 3.0, 4.0),
        ({"min": 10}, 40.0, 0.25),
        ({"min": 10}, 8.0, 1.2),
        ({"max_change": -20}, 2.0, 0.25),  # 80 % below the other's ten seconds
        ({"max_change": 5}, 2.0, 0.0),
    ],
)
def test_the_share_of_a_limit_that_is_used_is_never_below_zero(
    limit: dict[str, Any], time: float, share: float
) -> None:
    requirement = Requirement(metric="travel_time", **limit)
    assert share_used(requirement, [{"travel_time": time}], [{"travel_time": 10.0}]) == pytest.approx(share)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ({"metric": "travel_tim", "max": 1}, "no metric travel_tim"),
        ({"metric": "travel_time"}, "exactly one of max, min, max_change"),
        ({"metric": "travel_time", "max": 1, "min": 0}, "exactly one of max, min, max_change"),
    ],
)
def test_a_requirement_has_a_metric_and_one_limit(content: dict[str, Any], message: str) -> None:
    with pytest.raises(RidelabError, match=message):
        Requirement(**content)
