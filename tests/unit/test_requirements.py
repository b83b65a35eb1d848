"""Requirements on one road: the page judges them under a moving slider, and reads these same cases."""

import json
from pathlib import Path
from typing import Any

import pytest

from backend.requirements import Requirement, judge

CASES = json.loads((Path(__file__).parents[1] / "data" / "requirement_cases.json").read_text())


@pytest.mark.parametrize("case", CASES, ids=[case["case"] for case in CASES])
def test_one_road_is_judged_as_in_the_page(case: dict[str, Any]) -> None:
    requirements = [Requirement(**each) for each in case["requirements"]]
    driven = {name: [summary] for name, summary in case["summaries"].items()}
    answers = [each.model_dump(mode="json") for each in judge(requirements, driven, case["baseline"])]
    keys = ("strategy", "result", "value", "baseline")
    assert [{key: answer[key] for key in keys} for answer in answers] == case["results"]
