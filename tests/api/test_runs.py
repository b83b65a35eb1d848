"""POST and GET of runs: every field of the contract, and what is computed again."""

import copy
import itertools
import json
from base64 import b64encode
from typing import Any

import pytest

from backend.digest import run_id
from backend.runs.answers import run_answer
from backend.runs.models import CreatedRun, LiveRun, Run
from backend.runs.service import Runs
from sim_core import Scenario, __version__, simulate
from sim_core.catalogue import COMFORT, EVENTS, METRIC_SIGNALS, REFERENCES, SIGNALS, STATISTICS, WINDOWS
from tests.api.conftest import Service

lengths = itertools.count(1)


@pytest.fixture
def unseen(road: dict[str, Any]) -> dict[str, Any]:
    """A scenario that no test has run yet."""
    return {"road": {**road, "length": 130 + 1e-3 * next(lengths)}}


def test_a_run_has_the_numbers_of_the_core_under_the_contracts_names(run: dict[str, Any], road: dict[str, Any]) -> None:
    assert set(run) == {"id", "core_version", "scenario", "characteristics", "cautions", "comparison", "strategies"}
    assert (run["core_version"], len(run["id"])) == (__version__, 22)
    assert run["scenario"]["vehicle"]["body_mass"] == 1270
    assert run["scenario"]["road"]["bump"]["start"] == road["bump"]["start"]
    assert list(run["strategies"]) == ["lv", "lqr", "passive"], "in the catalogue's order, whatever was asked"
    CreatedRun.model_validate(run)
    scenario = Scenario.model_validate(run["scenario"])
    for name, entry in run["strategies"].items():
        assert (entry["status"], entry["cached"], entry["compute_ms"] > 0) == ("ok", False, True)
        for part, names in (("comfort", COMFORT), ("events", EVENTS), ("reference", REFERENCES)):
            assert set(entry[part]) == set(names)
        expected = dict(simulate(scenario, name).summary())
        for window, signal, statistic in itertools.product(WINDOWS, METRIC_SIGNALS, STATISTICS):
            assert entry["metrics"][window][signal][statistic] == pytest.approx(
                expected["metrics"][window][signal][statistic], rel=1e-9, abs=1e-12
            )
        for key in ("travel_time", "arrival_speed_kmh"):
            assert entry[key] == pytest.approx(expected[key], rel=1e-12)


def test_it_is_stored_and_got_with_a_tag(service: Service, run: dict[str, Any]) -> None:
    again = service.run(["lv", "lqr", "passive"], run["scenario"]).json()
    assert again["id"] == run["id"]
    assert all(entry["cached"] for entry in again["strategies"].values())
    response = service.get(f"/api/v1/runs/{run['id']}")
    Run.model_validate(response.json())
    for answer in (stored := response.json(), run := copy.deepcopy(run)):
        for entry in answer["strategies"].values():
            del entry["compute_ms"]  # another request may have stored the same result first
            entry.pop("cached", None)
    assert stored == run
    tag = response.headers["etag"]
    for header in (tag, tag.removeprefix("W/"), f'"other", {tag}', "*"):
        cached = service.get(f"/api/v1/runs/{run['id']}", headers={"If-None-Match": header})
        assert (cached.status_code, cached.content, cached.headers["etag"]) == (304, b"", tag)
    assert service.get(f"/api/v1/runs/{run['id']}", headers={"If-None-Match": '"other"'}).status_code == 200


def test_what_a_client_has_is_asked_for_again_and_sent_only_where_a_release_answers_otherwise(
    service: Any, run: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    run_path = f"/api/v1/runs/{run['id']}"
    below = ("/series?strategy=lv&points=50", "/instant?strategy=lv&time=0.5", "/differences")
    for path in (run_path, f"{run_path}?baseline=lv", *(run_path + each for each in below)):
        answer = service.get(path)
        assert (answer.status_code, answer.headers["cache-control"]) == (200, "public, no-cache"), path
        tag = answer.headers["etag"]
        assert service.get(path, headers={"If-None-Match": tag}).status_code == 304, path
    tag = service.get(run_path).headers["etag"]
    monkeypatch.setattr(f"{Runs.__module__}.run_answer", lambda *args, **more: {**run_answer(*args, **more), "new": 1})
    assert service.get(run_path, headers={"If-None-Match": tag}).json()["new"] == 1
    unknown = f"/api/v1/runs/{'A' * 22}"
    assert service.get(unknown, headers={"If-None-Match": "*"}).status_code == 404


def read_binary(content: bytes) -> dict[str, Any]:
    """Return the strategies of an answer of JSON and, after it, the numbers of all time histories as they are."""
    length = int.from_bytes(content[:4], "little")
    strategies, numbers = json.loads(content[4 : 4 + length])["strategies"], content[4 + length :]
    for entry in strategies.values():
        samples = 4 * entry["series"]["samples"]
        parts = {name: numbers[samples * i :][:samples] for i, name in enumerate(entry["series"]["signals"])}
        numbers = numbers[samples * len(parts) :]
        entry["series"] = {name: b64encode(part).decode() for name, part in parts.items()}
    assert (numbers, length % 4) == (b"", 0)
    return dict(strategies)


def test_live_answers_series_and_stores_nothing(service: Any, unseen: dict[str, Any]) -> None:
    first = service.live(["lv", "passive"], unseen)
    assert first.status_code == 200
    answer = first.json()
    LiveRun.model_validate(answer)
    assert set(answer) == {"core_version", "scenario", "characteristics", "cautions", "comparison", "strategies"}
    identifier = run_id(Scenario.model_validate(answer["scenario"]), ["lv", "passive"])
    assert service.get(f"/api/v1/runs/{identifier}").status_code == 404
    for entry in answer["strategies"].values():
        assert entry["cached"] is False
        assert list(entry["series"]) == list(SIGNALS)
    again = service.live(["lv", "passive"], unseen).json()["strategies"]
    assert all(entry["cached"] for entry in again.values())
    binary = service.live(["lv", "passive"], unseen, encoding="binary")
    assert binary.headers["content-type"] == "application/octet-stream"
    assert "content-encoding" not in binary.headers
    for entry in again.values():
        entry["series"] = {name: packed["bdata"] for name, packed in entry["series"].items()}
    assert read_binary(binary.content) == again
    posted = service.run(["lv", "passive"], unseen).json()
    assert all(entry["cached"] for entry in posted["strategies"].values()), "what a drag computed is stored as it is"
    for name, entry in posted["strategies"].items():
        assert entry["metrics"] == answer["strategies"][name]["metrics"]
        assert entry["compute_ms"] == answer["strategies"][name]["compute_ms"]


def test_a_refused_strategy_fails_alone_and_says_why(service: Service, lqr_fails: int) -> None:
    """A failure is a deterministic result like any other: stored, with its reason, beside those that succeeded."""
    scenario = {"road": {"length": 131.9, "seed": lqr_fails}}
    answer = service.run(["lqr", "passive"], scenario).json()
    CreatedRun.model_validate(answer)
    failure = {"status": "failed", "reason": "no controller", "kind": "refused", "fields": []}
    assert answer["strategies"]["lqr"] == {**failure, "cached": False, "compute_ms": 1.0}
    assert answer["strategies"]["passive"]["status"] == "ok"
    stored = service.get(f"/api/v1/runs/{answer['id']}").json()
    assert stored["strategies"]["lqr"]["reason"] == "no controller"
    assert service.run(["lqr"], scenario).json()["strategies"]["lqr"]["cached"] is True
    series = service.get(f"/api/v1/runs/{answer['id']}/series?points=20").json()
    assert series["strategy"] == "passive", "the only one with time histories"
    assert set(service.get(f"/api/v1/runs/{answer['id']}/figures").json()["figures"])


def test_a_rule_base_of_its_own_changes_those_that_slow_down_and_comes_back_as_it_was_sent(service: Any) -> None:
    rules = [{"if": {"speed_error": each}, "then": "V"} for each in "OSMLV"]
    paper = service.run(["speed_only", "passive"], {}).json()
    own = service.run(["speed_only", "passive"], {"fuzzy": {"rules": rules}}).json()
    assert own["id"] != paper["id"]
    times = [[run["strategies"][name]["travel_time"] for run in (paper, own)] for name in ("speed_only", "passive")]
    assert times[0][1] > times[0][0] + 0.5
    assert times[1][1] == times[1][0]
    assert own["strategies"]["passive"]["cached"] is True, "it reads no rule"
    stored = service.get(f"/api/v1/runs/{own['id']}").json()["scenario"]["fuzzy"]
    assert [(rule["if"]["speed_error"], rule["then"]) for rule in stored["rules"]] == [(each, "V") for each in "OSMLV"]
    report = service.get(f"/api/v1/runs/{own['id']}/report.html").text
    assert "fuzzy.rules=" in report
    again = service.run(["speed_only"], {"fuzzy": stored}).json()
    assert again["strategies"]["speed_only"]["cached"] is True
