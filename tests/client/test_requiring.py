"""`--require`: what is sent for what is typed, the exit codes, and the file for a CI system."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest

from sim_core import Requirement
from sim_core.comparison.requirements import judge
from tests.client.cli import Cli
from tests.client.conftest import Prepared

PEAK = "bump.body_acceleration.peak"


@pytest.fixture(autouse=True)
def judged(prepared: Prepared, outcomes: dict[str, dict[str, Any]]) -> None:
    """Runs are judged as the service judges them, on roads that differ by a tenth where there are several."""
    run: Any = prepared.answers["POST /runs"]

    def answer(body: Any) -> dict[str, Any]:
        requirements = [Requirement(**each) for each in body.get("requirements", ())]
        higher = json.loads(json.dumps(outcomes))
        higher["lv"]["metrics"]["bump"]["body_acceleration"]["peak"] *= 1.1
        roads = [outcomes, higher][: body["roads"]]
        driven = {name: [road[name] for road in roads] for name in body["strategies"]}
        results = [asdict(each) for each in judge(requirements, driven, body["baseline"])]
        return {**run(body), "requirement_results": results}

    prepared.answers["POST /runs"] = answer


def test_the_exit_code_is_1_where_one_fails_and_uncertain_fails_with_strict(
    cli: Cli, outcomes: dict[str, dict[str, Any]], tmp_path: Path
) -> None:
    peak = outcomes["lv"]["metrics"]["bump"]["body_acceleration"]["peak"]
    run, file = ("run", "-s", "lv,passive", "--require"), tmp_path / "junit.xml"
    assert "fail" in cli(*run, f"{PEAK}<{0.99 * peak}", code=1)
    several = (*run, f"{PEAK}<{1.05 * peak}", "--require", "travel_time>0", "--roads", "2")
    for options, code, of_uncertain in (((), 0, "skipped"), (("--strict",), 1, "failure")):
        assert "uncertain" in cli(*several, "--junit", file, *options, code=code)
        suite = ElementTree.parse(file).getroot()  # noqa: S314  # written here
        assert (suite.get("tests"), suite.get("failures")) == ("2", str(code))
        uncertain, passed = suite.iter("testcase")
        assert [child.tag for child in uncertain] == [of_uncertain]
        assert (uncertain.get("classname"), list(passed)) == ("ridelab.lv", [])


def test_runs_of_a_sweep_that_could_not_be_computed_are_errors_beside_its_failures(
    cli: Cli, prepared: Prepared, tmp_path: Path
) -> None:
    file, batch = tmp_path / "junit.xml", prepared.job("batch", total=5, fields=[])
    prepared.answers[f"GET /batches/{batch}/results"] = {"rows": []}
    first, worst = ({"run": run, "value": 2.0 + run, "at": {"road.bump.height": run / 10}} for run in (1, 2))
    none = {"min": None, "max_change": None, "baseline": None}
    held = {"metric": PEAK, "max": 2.0, "result": "fail", "first_failure": None, "worst_failure": None, **none}
    some = {"pass": 1, "fail": 2, "not_computed": 2, "unfinished": 0}
    prepared.answers[f"GET /batches/{batch}/requirements"] = {
        "requirement_results": [
            {**held, "strategy": "mine", "counts": {**some, "fail": 0, "not_computed": 4}, "reason": "No force"},
            {**held, "strategy": "lqr", "counts": some, "first_failure": first, "worst_failure": worst, "reason": "X"},
        ]
    }
    printed = cli("sweep", "--grid", "road.bump.height=0:0.4:5", "--require", f"{PEAK}<2", "--junit", file, code=1)
    assert "1 of 5 runs pass; 4 not computed" in printed
    place = "the first at road.bump.height=0.1 with 3 m/s^2, the worst at road.bump.height=0.2 with 4 m/s^2"
    assert f"2 of 5 runs fail, {place}; 2 not computed" in printed
    suite = ElementTree.parse(file).getroot()  # noqa: S314  # written here
    assert (suite.get("failures"), suite.get("errors")) == ("1", "2")
    assert [[child.tag for child in case] for case in suite] == [["error"], ["failure", "error"]]


def test_the_second_of_two_results_is_held_to_limits(
    cli: Cli, outcomes: dict[str, dict[str, Any]], tmp_path: Path
) -> None:
    """Beside the differences; a file whose numbers the service would not compute is not held to any."""
    saved, file = tmp_path / "saved.json", tmp_path / "junit.xml"
    run = json.loads(cli("run", "-s", "lv,passive", "--json"))
    saved.write_text(json.dumps(run))
    peak = outcomes["lv"]["metrics"]["bump"]["body_acceleration"]["peak"]
    compare = ("compare", saved, saved, "--junit", file)
    assert "fail" in cli(*compare, "--require", f"{PEAK}<{0.99 * peak}", code=1)
    cases = list(ElementTree.parse(file).getroot())  # noqa: S314  # written here
    assert [[child.tag for child in case] for case in cases] == [[], [], ["failure"]], "the differences come first"
    run["strategies"]["passive"]["travel_time"] += 1
    other = tmp_path / "other.json"
    other.write_text(json.dumps({**run, "id": "A" * 22}))
    cli("compare", saved, other, "--junit", file, code=1)
    suite = ElementTree.parse(file)  # noqa: S314  # written here
    assert suite.find("testcase[@classname='ridelab.passive']/failure") is not None
    cli("compare", saved, other, "--require", f"{PEAK}<9", code=2)
