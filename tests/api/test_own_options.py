"""Options of controllers of one's own are fields like ours: in runs, sweeps, searches and tunings."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from sim_core.frequency.stability import least_damping
from sim_core.scenario import Scenario
from tests import wording
from tests.api.conftest import ROAD, Service
from tests.api.own_laws import BY_STAGE, LAW, SCENARIO, driven, own, told_of
from tests.api.refusals import check_refused
from tests.api.tuning import begin, get, trials, wait_for
from tests.servers.batches import computed

MINE = LAW.replace("    damping", "    hard: bool = option(False)\n    damping")
_CLASS = LAW.partition("\n\n\n")[2]
FREE = _CLASS.replace("mine", "free").replace("Mine", "Free").replace(", ge=0, le=20_000", "")


@pytest.fixture(scope="module", autouse=True)
def folder(service: Service, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """With a file of two laws: one with bounds, one without, which looks nowhere ahead."""
    folder = tmp_path_factory.mktemp("laws")
    (folder / "mine.py").write_text(f"{MINE}\n\n{FREE}    preview = 'none'")
    with told_of(service, folder):
        yield folder


def with_options(**options: Any) -> dict[str, Any]:
    return {**SCENARIO, "own": {"mine": options}}


def test_options_are_fields_that_only_their_law_reads(service: Service) -> None:
    schema = service.get("/api/v1/schema").json()
    assert schema["$defs"]["Own"]["properties"]["mine"] == {"$ref": "#/$defs/own.mine", "title": "Mine"}
    field = schema["$defs"]["own.mine"]["properties"]["damping"]
    assert (field["unit"], field["soft_range"], field["default"]) == ("N·s/m", [0, 20_000], 2000.0)
    assert own(service)["mine"]["reads"][-1] == "own.mine"
    soft = driven(service, ["mine", "passive"])
    hard = driven(service, ["mine", "passive"], with_options(damping=4000))
    assert hard["passive"]["cached"]
    assert hard["mine"]["metrics"] != soft["mine"]["metrics"]


@pytest.mark.parametrize("asked", wording.asked_in("own_refusals"))
def test_an_option_that_cannot_be_is_refused_at_its_field(service: Service, asked: Any) -> None:
    check_refused(service, "own_refusals", asked)


def test_what_is_stored_of_a_law_that_is_gone_still_opens(service: Service, folder: Path) -> None:
    """Its options, the requirements that name it, and its curves, which a link keeps."""
    file = folder / "leaving.py"
    file.write_text(LAW.replace("mine", "leaving"))
    requirements = [{"metric": "bump.body_acceleration.peak", "max": 1, "strategies": ["leaving"]}]
    scenario = {**SCENARIO, "own": {"leaving": {"damping": 4000}}}
    asked = {"scenario": scenario, "strategies": ["leaving", "passive"], "requirements": requirements}
    run = service.post("/api/v1/runs", json=asked).json()
    path = f"/api/v1/batches/{computed(service, **asked, sweep={'grid': {'road.bump.height': [0.05]}})['id']}"
    link = service.post("/api/v1/links", json={"run_id": run["id"], "requirements": requirements}).json()
    curves = f"/api/v1/runs/{run['id']}/series?strategy=leaving&points=9&signals=front_force"
    addresses = [curves, path, *(f"{path}/{part}" for part in ("requirements", "results", "summary"))]
    addresses.append(f"/api/v1/links/{link['slug']}")

    def answers() -> list[Any]:
        found = [service.get(address).raise_for_status().json() for address in addresses]
        del found[-1]["run"]["comparison"]  # which has the label of a law that is there
        return found

    before = answers()
    assert before[-1]["run"]["requirement_results"] == run["requirement_results"]
    file.unlink()
    assert "leaving" not in own(service)
    assert answers() == before
    assert service.run(["passive"], run["scenario"]).json()["errors"][0]["pointer"] == "/scenario/own/leaving"
    shared = {"run_id": run["id"], "view": {"strategies": ["leaving"], "baseline": "leaving"}}
    assert service.post("/api/v1/links", json=shared).status_code == 201


def test_sweeps_and_searches_take_options(service: Service) -> None:
    sweep = {"grid": {"own.mine.damping": [0, 3000, 6000]}}
    batch = computed(service, scenario=SCENARIO, strategies=["mine", "passive"], sweep=sweep)
    figures = {"figures": "bump.body_acceleration.peak"}
    table = service.get(f"/api/v1/batches/{batch['id']}/table", params=figures).json()
    columns = table["columns"]
    assert table["units"]["own.mine.damping"] == "N·s/m"
    assert columns["own.mine.damping"] == [0, 0, 3000, 3000, 6000, 6000]
    assert len(set(columns["bump.body_acceleration.peak"])) == 4, "passive reads none of it"
    question = {
        "scenario": SCENARIO,
        "strategy": "mine",
        "field": "own.mine.damping",
        "range": [0, 3000],
        "metric": "bump.front_force.peak",
        "limit": 500,
    }
    solution = service.post("/api/v1/solve", json=question).json()
    assert 0 < solution["value"] < 3000
    assert solution["metric_value"] <= 500 < max(each["metric_value"] for each in solution["tried"])


@pytest.mark.thorough
def test_a_robustness_study_judges_the_law_that_it_drove(service: Service, folder: Path) -> None:
    file = folder / "harder.py"
    file.write_text(BY_STAGE)
    ranges = {"own.mine.damping": [1000, 9000], "mismatch.body_mass": [0.8, 1.2]}
    sweep = {"latin_hypercube": {"ranges": ranges, "samples": 4}}
    strategies = ["mine", "harder", "passive"]
    batch = computed(service, scenario=SCENARIO, strategies=strategies, sweep=sweep)["id"]
    summary = f"/api/v1/batches/{batch}/summary?baseline=passive&figures=bump.front_force.peak"
    study = service.get(summary).json()["strategies"]
    forces = study["mine"]["figures"]["bump.front_force.peak"]
    assert forces["nominal"] == driven(service, ["mine"])["mine"]["metrics"]["bump"]["front_force"]["peak"]
    assert 0 < forces["lowest"]["value"] < forces["highest"]["value"]
    law: dict[str, Any] = {"__name__": __name__}
    exec(BY_STAGE, law)  # noqa: S102 - ours
    expected = least_damping(Scenario.model_validate(SCENARIO), law["Harder"])
    assert (study["harder"]["stability"]["nominal"], study["harder"]["stability"]["n"]) == (expected, 4)
    assert study["mine"]["stability"]["known"] == 0, "it says no linear law"
    file.write_text(BY_STAGE.replace("-1000.0", "-9000.0"))
    anew = summary.replace("passive", "mine")  # computed, not the one that was kept
    changed = service.get(anew).json()["strategies"]["harder"]
    peak = changed["figures"]["bump.front_force.peak"]
    assert (peak["mean"], peak["nominal"]) == (study["harder"]["figures"]["bump.front_force.peak"]["mean"], None)
    assert changed["stability"]["known"] == 0, "the new law did not drive these"


@pytest.mark.thorough
def test_the_tuner_searches_options_of_the_law_it_began_with(service: Service, folder: Path) -> None:
    file = folder / "tuned.py"
    file.write_text(LAW.replace("mine", "tuned"))
    figure = {"kind": "figure", "figure": "bump.body_acceleration.peak"}
    more: dict[str, Any] = {"strategy": "tuned", "objectives": [figure], "limits": [], "trials": 4, "population": 4}
    begun = begin(service, **more, scenario=SCENARIO, seeds=[1], fresh_seeds=[2, 3])
    tuned = wait_for(service, begun["id"])
    assert (tuned["state"], tuned["source"]["file"]) == ("done", "tuned.py"), tuned["reason"]
    assert (tuned["paper"]["weights"], tuned["own"]) == ({"own.tuned.damping": 2000}, None)
    tried = [each["weights"]["own.tuned.damping"] for each in trials(service, begun["id"])]
    assert all(0 <= each <= 20_000 for each in tried), "linear: its bounds begin with 0"
    (best,) = tuned["best"]
    scenario = {"road": {**ROAD, "seed": 1}, "own": {"tuned": {"damping": best["weights"]["own.tuned.damping"]}}}
    alone = driven(service, ["tuned"], scenario)
    assert best["values"] == [alone["tuned"]["metrics"]["bump"]["body_acceleration"]["peak"]]
    assert tuned["comparison"]["points"][0]["weights"] == {"own.tuned.damping": 2000}
    file.write_text(file.read_text().replace("2000.0", "3000.0"))
    service.post(f"/api/v1/tunings/{begun['id']}/resume?trials=5").raise_for_status()
    resumed = wait_for(service, begun["id"])
    assert resumed["reason"] == "tuned.py has changed or gone since it began: begin another tuning"
    file.unlink()
    assert get(service, begun["id"])["best"] == tuned["best"], "its numbers stay"
