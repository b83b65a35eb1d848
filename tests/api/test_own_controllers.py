"""Controllers of one's own are strategies like ours, and what is wrong with one costs its own column alone."""

import csv
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from backend.custom_controllers import registry
from backend.fmu.archive import fmu
from sim_core import Scenario, simulate
from tests.api.conftest import Service
from tests.api.own_laws import BY_STAGE, LAW, SCENARIO, driven, own, told_of
from tests.importer import Importer
from tests.servers.batches import computed, wait_for
from tests.servers.process import wait_until

BROKEN = {
    "raises": "return 1 / 0",
    "nan": "return float('nan'), 0.0",
    "shape": "return [0.0]",
    "ends_at_once": "import os; os._exit(3)",
    "killed": "import os; os.kill(os.getpid(), 9)",
    "changes": "seen.state[0] = 1.0; return 0.0, 0.0",
    "memory": "import numpy; return numpy.ones(2**30), 0.0",
    "deep": "return self.force(seen)",
    "environment": "import os; return float(os.environ['RIDELAB_NO_SUCH_VARIABLE']), 0.0",
    "damaged": "return float(b'\\xff'.decode()), 0.0",
}


def named(name: str, body: str | None = None) -> str:
    """The law under another name; what its force does in place of what stands there."""
    text = LAW.replace("mine", name).replace("Mine", name.title())
    return text if body is None else text.rpartition("return")[0] + f"{body}\n"


@pytest.fixture(scope="module")
def laws(service: Service, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A folder with laws that tests share: each file is a process that takes a second to start."""
    folder = tmp_path_factory.mktemp("laws")
    (folder / "mine.py").write_text(LAW)
    (folder / "harder.py").write_text(BY_STAGE)
    with told_of(service, folder):
        yield folder


@pytest.fixture
def folder(laws: Path) -> Iterator[Path]:
    """That folder; what a test writes there goes with it."""
    shared = set(laws.iterdir())
    yield laws
    for file in set(laws.glob("*.*")) - shared:
        file.unlink()


def test_a_file_is_a_strategy_and_a_saved_one_another_law(service: Service, folder: Path) -> None:
    file = folder / "saved.py"
    assert "saved" not in own(service)
    file.write_text(named("saved"))
    first = own(service)["saved"]
    assert (first["label"], first["description"], first["fault"]) == ("Saved", "Damps the body.", None)
    assert first["source"]["file"] == "saved.py"
    option = {"type": "number", "unit": "N·s/m", "minimum": 0, "maximum": 20_000, "default": 2000.0}
    assert first["options"]["properties"]["damping"].items() >= {**option, "description": "Force per velocity."}.items()
    run = service.run(["saved", "passive"], SCENARIO).json()
    outcome = run["strategies"]["saved"]
    assert (outcome["source"], run["strategies"]["passive"]["source"]) == (first["source"], None)
    address = f"/api/v1/runs/{run['id']}"
    at = service.get(f"{address}/instant?position=90.3&strategy=saved").json()
    assert at["forces"]["asked"] == pytest.approx([-2000.0 * at["state"][4]] * 2, rel=1e-9)
    assert at["predicted_states"] is at["parts"] is None

    file.write_text(named("saved").replace("2000.0", "4000.0"))
    again = driven(service, ["saved", "passive"])
    assert again["saved"]["source"]["digest"] != outcome["source"]["digest"]
    assert (again["saved"]["cached"], again["passive"]["cached"]) == (False, True)
    assert again["saved"]["metrics"] != outcome["metrics"]
    stored = service.get(address).json()["strategies"]["saved"]
    assert stored == {key: value for key, value in outcome.items() if key != "cached"}, "the old law's, as it was"
    series = service.get(f"{address}/series", params={"strategy": "saved", "points": 9})
    assert (series.status_code, "passive" in series.json()["detail"]) == (422, True), "no curves of another law"
    instant = service.get(f"{address}/instant?position=90.3&strategy=saved")
    assert (instant.status_code, "has changed" in instant.json()["detail"]) == (410, True)
    assert len(service.get(f"{address}/figures").json()["figures"]["road"]["data"]) == 1
    file.write_text(named("saved"))
    assert driven(service, ["saved"])["saved"] == {**outcome, "cached": True}


def test_whatever_leaves_names_the_laws_file_and_digest(service: Service, folder: Path) -> None:
    strategies = ["harder", "passive"]
    run = service.run(strategies, SCENARIO).json()
    source = run["strategies"]["harder"]["source"]
    assert source == {"file": "harder.py", "digest": own(service)["harder"]["source"]["digest"]}
    address = f"/api/v1/runs/{run['id']}"
    assert f"harder.py, <code>{source['digest']}</code>" in service.get(f"{address}/report.html").text
    asked: dict[str, str | int] = {"strategy": ",".join(strategies), "points": 9}
    assert service.get(f"{address}/series", params=asked).json()["sources"] == {"harder": source}
    sweep = {"grid": {"road.bump.height": [0.06]}}
    batch = computed(service, scenario=SCENARIO, strategies=strategies, sweep=sweep)
    results = f"/api/v1/batches/{batch['id']}/results"
    rows = csv.DictReader(service.get(results, params={"format": "csv"}).text.splitlines())
    assert [row["source"] and json.loads(row["source"]) for row in rows] == ["", source], "ours before theirs"


@pytest.mark.thorough
def test_a_law_of_ones_own_that_is_linear_leaves_as_an_fmu(service: Service, folder: Path, tmp_path: Path) -> None:
    """Its gains differ by stage, and count the force before, which the FMU remembers."""
    file = tmp_path / "harder.fmu"
    body = {"strategy": "harder", "version": "3.0", "platforms": ["linux64"]}
    file.write_bytes(service.post("/api/v1/fmus", json=body).raise_for_status().content)
    importer = Importer(file, tmp_path / "fmu")
    given: list[list[float]] = []
    with importer.run():
        for stage in (0, 0, 2):
            importer.step(0.01 * len(given), 0.01, {"state[5]": 1.0, "stage": stage})
            given.append(importer.get(["force_front", "force_rear"]))
    assert given == [[-1000.0] * 2, [-1500.0] * 2, [-3500.0] * 2]
    both = (folder / "harder.py").read_text().replace("harder", "both")
    (folder / "both.py").write_text(f"{both}\n    def force(self, seen):\n        return 0.0, 0.0\n")
    for name, said in (("mine", "linear"), ("both", "leave force out")):
        refused = service.post("/api/v1/fmus", json={"strategy": name})
        assert (refused.status_code, said in refused.json()["detail"]) == (422, True), refused.text


def test_an_fmu_is_a_strategy_too(service: Service, folder: Path) -> None:
    (folder / "theirs.fmu").write_bytes(fmu(Scenario.model_validate(SCENARIO), "lqr", "controller", "2.0", ["linux64"]))
    assert own(service)["theirs"]["options"]["properties"]["force_limit"]["unit"] == "N"
    outcomes = driven(service, ["theirs", "lqr"])
    ours, theirs = (outcomes[name]["metrics"]["whole"]["body_acceleration"]["rms"] for name in ("lqr", "theirs"))
    assert theirs == pytest.approx(ours, rel=1e-9)


@pytest.mark.usefixtures("laws")
def test_it_is_driven_as_in_the_library(service: Service) -> None:
    namespace: dict[str, Any] = {"__name__": __name__}
    exec(LAW, namespace)  # noqa: S102 - ours
    expected = simulate(Scenario.model_validate(SCENARIO), namespace["Mine"]).summary()
    assert driven(service, ["mine"])["mine"]["metrics"] == expected["metrics"]
    live = service.live(["mine"], SCENARIO, points=50, signals=["front_force"]).json()["strategies"]["mine"]
    assert set(live["series"]) == {"time", "position", "front_force"}


def test_a_law_that_fails_costs_its_own_column_and_is_told_with_its_line(service: Service, folder: Path) -> None:
    laws = [named(name, body).partition("\n\n\n")[2] for name, body in BROKEN.items()]
    (folder / "broken.py").write_text("from sim_core import Controller, option\n" + "\n".join(laws))
    lines = (folder / "broken.py").read_text().splitlines()
    line = {name: lines.index(f"        {body}") + 1 for name, body in BROKEN.items()}
    (folder / "chatty.py").write_text(named("chatty").replace("return", "print('x' * 10_000); return"))
    outcomes = driven(service, [*BROKEN, "chatty", "passive"])
    assert {name for name, each in outcomes.items() if each["status"] == "ok"} == {"chatty", "passive"}
    for name in BROKEN:
        place = f", line {line[name] - (name in ('nan', 'shape'))}"  # of a wrong value the line of its def
        said = f"broken.py{': it ended its process by SIGKILL' if name == 'killed' else place}"
        assert outcomes[name]["reason"].startswith(said), outcomes[name]
    assert outcomes["raises"]["reason"].endswith("ZeroDivisionError: division by zero")
    of_code = {"raises", "nan", "shape", "changes"}  # which says the same on every machine
    assert {name for name in BROKEN if outcomes[name]["kind"] == "refused"} == of_code
    assert {name for name in BROKEN if outcomes[name]["kind"] == "unavailable"} == BROKEN.keys() - of_code
    again = driven(service, ["raises", "killed"])
    assert {name: each["cached"] for name, each in again.items()} == {"raises": True, "killed": False}


def test_what_a_machine_lacked_is_computed_as_soon_as_it_has_it(service: Service, folder: Path) -> None:
    """A file that is away: the failure is told, is in no memory and no store, and ends with the file's return."""
    weights = folder / "weights.txt"
    reads = f"float(open({str(weights)!r}).read()) * -seen.state[4]"
    lines = ["try:", f"    gain = {reads}", "except OSError as error:", "    raise ValueError('no gain') from error"]
    (folder / "reads.py").write_text(named("reads", "\n        ".join([*lines, "return gain, gain"])))
    body = {"scenario": SCENARIO, "strategies": ["passive", "reads"]}
    run = service.post("/api/v1/runs", json=body).json()
    link = service.post("/api/v1/links", json={"run_id": run["id"]}).json()["slug"]
    batch = computed(service, **body, sweep={"grid": {"road.bump.height": [0.05]}})
    address, path = f"/api/v1/runs/{run['id']}", f"/api/v1/batches/{batch['id']}"

    def nominal() -> Any:
        summary = service.get(f"{path}/summary?figures=bump.body_acceleration.peak").json()["strategies"]["reads"]
        return summary["ok"], summary["figures"]["bump.body_acceleration.peak"]["nominal"]

    failed = run["strategies"]["reads"]
    assert (failed["kind"], failed["reason"]) == ("unavailable", "reads.py, line 15: ValueError: no gain")
    for again in (service.post("/api/v1/runs", json=body), service.get(address)):
        assert (again.json()["id"], again.json()["strategies"]["reads"]["reason"]) == (run["id"], failed["reason"])
    assert (batch["done"], batch["failed"], nominal()[0]) == (1, 1, 0)

    weights.write_text("2000")
    now = service.get(address).json()
    assert now["strategies"]["reads"]["status"] == "ok"
    weights.unlink()
    assert service.get(address).json() == now, "it is a result now"
    assert service.get(f"/api/v1/links/{link}").json()["run"]["strategies"] == now["strategies"]

    weights.write_text("2000")
    service.post(f"{path}/resume").raise_for_status()
    ended = wait_for(service, batch["id"])
    assert (ended["done"], ended["failed"]) == (2, 0)
    weights.unlink()
    assert nominal() == (1, None)
    weights.write_text("2000")
    assert nominal()[1] == now["strategies"]["reads"]["metrics"]["bump"]["body_acceleration"]["peak"]


def test_a_law_that_does_not_end_is_ended(service: Service, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(service.services.own_files, "_limit", 0.5)
    (folder / "endless.py").write_text(named("endless", "while True: pass"))
    ignoring = "import signal; signal.alarm(0); signal.signal(14, signal.SIG_IGN)\n        while True: pass"
    (folder / "stubborn.py").write_text(named("stubborn", ignoring))
    outcomes = driven(service, ["endless", "stubborn", "passive"])
    assert {name: each.get("reason") for name, each in outcomes.items()} == {
        "passive": None,
        "endless": "endless.py, line 12: it did not end within 0.5 s",
        "stubborn": "stubborn.py: it did not end within 0.5 s, and was ended",
    }


def test_a_file_that_cannot_be_used_keeps_nothing_else_from_working(service: Service, folder: Path) -> None:
    (folder / "half.py").write_text(LAW[:-40])
    (folder / "twice.py").write_text(LAW.replace("damping", "other"))
    fault = "half.py, line 12: SyntaxError: invalid syntax"
    assert own(service)["half"]["fault"] == fault, "where its author looks"
    assert service.get("/readyz").json()["controllers"] == {
        "half.py": fault,
        "twice.py": "twice.py: mine.py has a controller of the id mine too",
    }
    options = service.get("/api/v1/schema").json()["$defs"]["own.mine"]["properties"]
    assert list(options) == ["damping"], "those of the file that is used"
    outcomes = driven(service, ["half", "mine", "lqr"])
    assert {name: each.get("reason") for name, each in outcomes.items()} == {"half": fault, "mine": None, "lqr": None}
    (folder / "half.py").write_text(LAW.replace("mine", "whole"))
    assert own(service)["whole"]["fault"] is None
    (folder / "half.py").unlink()
    assert "whole" not in own(service)


def test_a_file_that_takes_too_long_is_tried_again_and_keeps_no_request_waiting(
    service: Service, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(registry, "LOADING", 2.0)
    away = folder / "away.txt"
    away.touch()
    endless = f"while pathlib.Path({str(away)!r}).exists(): time.sleep(0.01)"
    (folder / "endless.py").write_text(f"import pathlib, time\n{endless}\n{named('late')}")
    wait_until(lambda: "fault" in own(service).get("endless", {}), "its time is over")
    assert own(service)["endless"]["fault"] == "endless.py, line 2: it did not end within 2 s"
    monkeypatch.setattr(registry, "LOADING", 30.0)
    monkeypatch.setattr(registry, "TRY_AGAIN", 0.0)
    assert own(service)["endless"]["fault"], "which keeps no request waiting"
    away.unlink()
    wait_until(lambda: "late" in own(service), "it is loaded")
