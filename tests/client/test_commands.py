"""What commands ask for and print, where the pages of docs/ do not show it."""

import csv
import io
import json
import shlex
from pathlib import Path
from typing import Any

import httpx
import pytest

from backend.http.problem_types import KINDS
from backend.runs.instants import as_answer
from backend.runs.reports import inputs
from ridelab.cli import options
from sim_core.catalogue import METRICS
from sim_core.instant import instant
from sim_core.scenario import Scenario, dotted
from sim_core.scenario.vehicles import VEHICLES
from tests import wording
from tests.client.cli import Cli
from tests.client.conftest import ADDRESS, RUN, SHORT, SLUG, Prepared

OLD = ("-s0h-wlxdeCgHw4J2eqW3g", "--0Zt9MhQy5rUqf5n_Xk7A", "-" + "k" * 21)  # the letters of options, alone and long
PEAK = "bump.body_acceleration.peak"
SEARCHES = {  # words of people's own, and fields that they have to find
    "sensor": ["estimation.acceleration_noise", "hil.noise", "mismatch.preview_noise"],
    "frequency": ["vehicle.front_spring", "vehicle.body_mass", "actuator.bandwidth", "mpc.sample_time"],
    "weight": ["vehicle.body_mass", "mismatch.body_mass", "mpc.stage_weights.cruise", "lqr.weights"],
    "hump": ["road.bump.height", "road.bump.width"],
    "pothole": ["road.bump.height"],
    "speed bump": ["road.bump.height"],
    "comfort": ["mpc.stage_weights.cruise", "lqr.weights", "vehicle.front_spring"],
    "grip": ["mpc.stage_weights.bump", "vehicle.tyre_lift_off"],
    "tire": ["vehicle.front_tyre_stiffness", "mismatch.tyres"],
    "delay": ["actuator.bandwidth", "mismatch.preview_delay", "hil.compensation"],
    "iso roughness": ["road.roughness"],
    "wheelbase": ["vehicle.cg_to_front", "vehicle.cg_to_rear"],
}


def test_the_command_a_report_prints_gives_the_same_scenario(cli: Cli) -> None:
    changes = {"road.roughness": 256e-6, "road.seed": 7, "road.bump.shape": "flat_top", "lqr.weights": [1, 2.5, 3]}
    expected = dotted.with_changes(Scenario().model_dump(mode="json"), changes)
    words = inputs.command(expected, ["passive"]).split()
    assert json.loads(cli(*words[1:], "--json"))["scenario"] == expected


def test_a_run_can_be_named_in_every_way(cli: Cli, prepared: Prepared, tmp_path: Path) -> None:
    link: Any = {"slug": SLUG, "url": f"/s/{SLUG}", "kind": "run", "created_at": "", "core_version": "1", "batch": None}
    link |= {"current_core_version": "1", "scenario": SHORT, "view": {}, "series_pinned": True}
    prepared.answers[f"GET /links/{SLUG}"] = {**link, "run": prepared.answers[f"GET /runs/{RUN}"]}
    saved, address = tmp_path / "saved.json", f"{ADDRESS}/r/{RUN}"
    saved.write_text(cli("run", address, "-s", "lv", "-s", "passive", "--json"))
    assert json.loads(saved.read_text())["units"][PEAK] == "m/s^2"
    for name in (RUN, address, saved, SLUG, f"{ADDRESS}/s/{SLUG}"):
        compared = cli("compare", name, RUN)
        assert f"Equal within the tolerance: {2 * len(METRICS)} metrics of lv, passive" in compared, name
    saved.write_text(json.dumps({**json.loads(saved.read_text()), "roads": 3}))
    assert "Equal within the tolerance" in cli("compare", saved, "paper")
    assert prepared.bodies("POST /runs")[-1]["roads"] == 3, "as many as the saved run has"
    assert cli("open", RUN, "--print") == f"{address}\n"
    assert cli("open", SLUG, "--print") == f"{ADDRESS}/s/{SLUG}\n"
    for unknown in ("A" * 22, "nothing"):
        cli("open", unknown, "--print", code=2)


@pytest.mark.parametrize("old", OLD)
def test_an_old_id_that_begins_with_a_sign_is_an_id(cli: Cli, prepared: Prepared, old: str) -> None:
    """New ones begin with a letter or a digit; those given out before stand in papers and scripts."""
    run: Any = prepared.answers[f"GET /runs/{RUN}"]
    prepared.answers |= {f"GET /runs/{old}": {**run, "id": old}, f"GET /runs/{old}/series": b"time [s]"}
    assert cli("export", "--strategy", "lv", old, "--signals", "speed", "--out", "-", "--format", "csv") == "time [s]"
    assert old in cli("open", old, "--print")
    assert "Equal within the tolerance" in cli("compare", RUN, "-s", "lv", old)
    assert cli("run", old, "--json", "-s", "lv").startswith("{")
    cli("tune", "--resume", old, code=2)
    assert "There is none of this id." in cli.error


def test_a_run_says_what_its_numbers_do_not(
    cli: Cli, outcomes: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    late = {"target_reached": False, "bump_complete": False, "qp_failures": 2}
    monkeypatch.setitem(outcomes, "lv", outcomes["lv"] | {"events": outcomes["lv"]["events"] | late})
    printed = cli("run", "-s", "lv,passive")
    for said in ("target speed", "rear axle", "2 QPs"):
        assert any(said in line for line in printed.splitlines() if line.startswith("LV control  "))
    failed = {"status": "failed", "cached": False, "compute_ms": 1.0, "reason": "no controller"}
    monkeypatch.setitem(outcomes, "lv", failed)
    assert "\nLV control  failed: no controller" in cli("run", "-s", "lv,passive", code=1)


def test_a_run_prints_the_changes_that_the_service_answers(cli: Cli, prepared: Prepared) -> None:
    """Against the baseline and against another run, with half of their intervals where they have some."""
    run: Any = prepared.answers["POST /runs"]
    metric = "bump.body_acceleration.peak"

    def answer(body: Any) -> Any:
        answered = run(body)
        answered["comparison"]["changes"]["lv"][metric]["change"] = -12.34
        change = {"change": 5.0, "low": 3.0, "high": 7.0, "beyond_variation": True}
        return answered | {"comparison": answered["comparison"] | {"changes_against": {"lv": {metric: change}}}}

    prepared.answers["POST /runs"] = answer
    alone = cli("run", "-s", "lv,passive")
    assert " (-12.3 %)" in alone
    assert "against run" not in alone
    beside = cli("run", "-s", "lv,passive", "--against", RUN)
    assert f"peak on the bump, changes against run {RUN}" in beside
    assert " (+5.0 ± 2.0 %)" in beside
    assert [body.get("against") for body in prepared.bodies("POST /runs")] == [None, RUN]


def test_a_sweep_whose_runs_failed_has_them_and_an_exit_code_and_is_exported_later(
    cli: Cli, prepared: Prepared, outcomes: dict[str, Any], scenario: Path, tmp_path: Path
) -> None:
    rows: list[dict[str, Any]] = [{"run": 0, "road.seed": 0, "strategy": "lv", "status": "ok", **outcomes["lv"]}]
    rows += [{"run": 1, "road.seed": 20, "strategy": "lv", "status": "failed", "reason": "too steep"}]
    field = {"name": "road.seed", "unit": "1", "linked_to": None}
    what = {"fields": [field], "scenario": SHORT, "strategies": ["lv"]}
    batch = prepared.job("batch", "done", done=1, failed=1, **what)
    prepared.answers |= {
        f"GET /batches/{batch}/results": {"rows": rows},
        "POST /links": {"slug": SLUG, "url": f"/s/{SLUG}"},
    }
    sweep = ("sweep", scenario, "--grid", "road.seed=0,20")
    assert json.loads(cli(*sweep, "--json", code=1))["rows"][-1]["reason"] == "too steep"
    assert cli.error == f"batch {batch}: done, 1 of 2 done, 1 failed\n"
    assert cli(*sweep, "--detach") == f"{batch}\n"
    assert f"ridelab export {batch} --wait --out FILE --server {ADDRESS}" in cli.error
    out = tmp_path / "later.json"
    assert cli("export", batch, "--wait", "--out", out) == ""
    assert json.loads(out.read_text())["rows"] == json.loads(json.dumps(rows))
    assert cli("open", batch, "--print") == f"{ADDRESS}/s/{SLUG}\n"
    cli("compare", batch, "paper", code=2)


def test_an_instant_of_a_stored_run_has_the_address_that_shows_it(cli: Cli, prepared: Prepared) -> None:
    seen = instant(Scenario.model_validate(SHORT), "lv", position=45.0)
    answer = prepared.answers[f"GET /runs/{RUN}/instant"] = as_answer("lv", seen).model_dump_json().encode()
    asked = ("instant", RUN, "--position", "45")  # of the run's first strategy
    *_, blank, address = cli(*asked).splitlines()
    assert (blank, address) == ("", f"{ADDRESS}/r/{RUN}?instant=lv~{round(seen.position, 2):g}")
    assert json.loads(cli(*asked, "--json")) == {"run_id": RUN, **json.loads(answer)}


def test_a_runs_metrics_are_exported_and_a_refusal_leaves_the_file(cli: Cli, tmp_path: Path) -> None:
    lines = list(csv.DictReader(io.StringIO(cli("export", RUN, "--metrics", "--out", "-", "--format", "csv"))))
    assert lines[1]["unit"] == "m/s^2"
    assert len(lines) == 2 * len(METRICS)
    figures = tmp_path / "run.json"
    cli("export", RUN, "--metrics", "--out", figures)
    assert "Equal" in cli("compare", figures, RUN)
    before = figures.read_bytes()
    cli("export", RUN, "--out", figures, code=2)
    assert "There is none of this id." in cli.error, "its time histories"
    assert figures.read_bytes() == before


def test_links_are_listed_and_taken_back(cli: Cli, prepared: Prepared) -> None:
    times = {"created_at": "2026-11-28T12:03:59.59+00:00", "revoked_at": None}
    address = f"{ADDRESS}/s/{SLUG}"
    link = {"slug": SLUG, "url": address, "kind": "run", "run_id": RUN, "batch_id": None, **times}
    prepared.answers["GET /links"] = {"links": [link], "next": None}
    prepared.answers[f"DELETE /links/{SLUG}"] = b""
    assert cli("links", "list").splitlines()[1].split() == [SLUG, "run", RUN, "2026-11-28", "12:03"]
    assert json.loads(cli("links", "list", "--json")) == [link]
    assert json.loads(cli("links", "revoke", SLUG, address, "--json")) == [{"slug": SLUG}] * 2
    assert [name for name, _ in prepared.asked].count(f"DELETE /links/{SLUG}") == 2
    cli("links", "revoke", "A" * 22, code=2)


def test_jobs_are_shown_followed_stopped_and_removed(cli: Cli, prepared: Prepared) -> None:
    batch = prepared.job("batch", fields=[{"name": "road.seed"}], strategies=["lv"], created_at="2026-01-02T03:04:05")
    tuning = prepared.job("tuning", "running", limits=[], strategy="lqr", created_at="2026-01-03T03:04:05")
    for name, path in (("batches", batch), ("tunings", tuning)):
        job: Any = prepared.answers[f"GET /{name}/{path}"]
        prepared.answers |= {f"DELETE /{name}/{path}": {}, f"PATCH /{name}/{path}": {**job, "label": "winter"}}
        prepared.answers[f"GET /{name}"] = {name: [job], "next": None}
        prepared.answers[f"POST /{name}/{path}/cancel"] = {**job, "state": "cancelled"}
        prepared.answers[f"POST /{name}/{path}/resume"] = {**job, "state": "running"}
    assert json.loads(cli("jobs", "follow", batch, "--json"))["id"] == batch
    assert cli.error == f"batch {batch}: done, 2 of 2 done, 0 failed\n"
    cli("jobs", "follow", tuning, "--timeout", "0", code=3)
    for command, state in (("cancel", "cancelled"), ("resume", "running")):
        cli("jobs", command, tuning)
        assert cli.error.startswith(f"tuning {tuning}: {state}, ")
    listed = [line.split()[:3] for line in cli("jobs", "list").splitlines()[1:]]
    assert listed == [["tuning", tuning, "running"], ["batch", batch, "done"]]
    assert json.loads(cli("jobs", "list", "--json"))[0]["kind"] == "tuning"
    assert f"ridelab export {batch} --wait --out FILE" in cli("jobs", "show", batch)
    assert json.loads(cli("jobs", "label", batch, "winter", "--json"))["label"] == "winter"
    cli("jobs", "label", batch, "")
    assert prepared.bodies(f"PATCH /batches/{batch}") == [{"label": "winter"}, {"label": None}]
    cli("jobs", "delete", tuning, batch)
    assert cli.error == f"tuning {tuning}: deleted\nbatch {batch}: deleted\n"
    assert json.loads(cli("jobs", "delete", batch, "--json")) == [{"kind": "batch", "id": batch}]
    cli("jobs", "show", "A" * 22, code=2)


def test_a_tuning_that_is_done_is_shown_again_or_goes_on(cli: Cli, prepared: Prepared) -> None:
    best = {"number": 3, "weights": {"lqr.weights": [2, 1, 1]}}
    tuning = prepared.job("tuning", best=[best], knee=None, scenario=SHORT)
    job: Any = prepared.answers[f"GET /tunings/{tuning}"]
    prepared.answers[f"POST /tunings/{tuning}/resume"] = job
    assert json.loads(cli("tune", "--resume", tuning, "--json", "--out", "tuned.json")) == job
    assert json.loads(Path("tuned.json").read_text()) == {**SHORT, "lqr": {"weights": [2, 1, 1]}}
    assert not prepared.bodies(f"POST /tunings/{tuning}/resume"), "nothing is computed"
    cli("tune", "--resume", tuning, "--json", "--trials", "12")
    assert len(prepared.bodies(f"POST /tunings/{tuning}/resume")) == 1


def test_where_nothing_keeps_the_limits_the_exit_code_is_1(cli: Cli, prepared: Prepared) -> None:
    tuning = prepared.job("tuning", best=[None], knee=None)
    cli("tune", "--json", code=1)
    assert f"tuning {tuning}: done" in cli.error, "nothing keeps its limits"
    problem = {"type": "urn:problem-type:ridelab:no-solution", "status": 422, "detail": "No value.", "errors": []}
    prepared.answers["POST /solve"] = httpx.Response(422, json=problem)
    cli("solve", "--field", "road.bump.height=0.1:0.2", "--limit", f"{PEAK}=4", "-s", "lv", code=1)
    assert cli.error == "No value.\n"


@pytest.mark.parametrize("words", wording.asked_in("sent"))
@pytest.mark.usefixtures("scenario")
def test_what_is_typed_is_what_a_service_is_asked_for(cli: Cli, prepared: Prepared, words: str) -> None:
    """Values and limits are in the units of their fields; a robustness study is a sweep of what is uncertain."""
    Path("claims.json").write_text(json.dumps([{"metric": "events.airborne_ms", "max": 0}]))
    batch, tuning = prepared.job("batch"), prepared.job("tuning")
    prepared.answers[f"GET /batches/{batch}/summary"] = {"batch": batch}
    printed = cli(*shlex.split(words))
    assert batch in printed or tuning in printed
    (asked,) = (body for name, body in prepared.asked if name in ("POST /batches", "POST /tunings"))
    wording.check("sent", words, asked)


def test_the_papers_count_is_asked_for_by_readings_and_seeds(cli: Cli, prepared: Prepared, tmp_path: Path) -> None:
    prepared.answers |= {"GET /paper": {"reached": 36}, "GET /paper/report.html": b"<html>"}
    file = tmp_path / "paper.html"
    words = ("--seeds", "21-60", "--interpretation", "favourable", "--reading", "preview=none")
    assert json.loads(cli("paper", "--json", "--report", file, *words)) == {"reached": 36}
    assert str(file) in cli.error
    assert file.read_bytes() == b"<html>"


def test_the_shell_completes_names_that_a_service_gave(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    cli("run", "-s", "passive")
    monkeypatch.setenv("_RIDELAB_COMPLETE", "complete_bash")
    for words, completed in (
        ("run pap", "paper"),
        ("run --set road.bump.he", "road.bump.height="),
        ("sweep -s lv,lq", "lv,lqr"),
        ("compare a b --metric comfort.vib", "comfort.vibration_dose"),
        ("run --set vehicle = va", "van_loaded"),  # as bash splits it
    ):
        monkeypatch.setenv("COMP_WORDS", "\n".join(["ridelab", *words.split()]))
        monkeypatch.setenv("COMP_CWORD", str(len(words.split())))
        monkeypatch.setattr(options, "completed_field", "")
        assert completed in cli().split(), words


@pytest.mark.parametrize(("words", "found"), SEARCHES.items())
def test_a_field_is_found_by_the_words_that_people_have_for_it(cli: Cli, words: str, found: list[str]) -> None:
    listed = {line.split()[0] for line in cli("fields", *words.split()).splitlines()[1:]}
    assert set(found) <= listed
    assert len(listed) < 30, "a word that finds everything finds nothing"


def test_names_are_listed_with_what_a_script_needs(cli: Cli) -> None:
    assert {each["name"] for each in json.loads(cli("metrics", "--json"))} == set(METRICS)
    listed = {each["name"]: each for each in json.loads(cli("fields", "--json"))}
    assert set(listed) == {name for name in dotted.fields() if not name.rpartition(".")[2].isdigit()}
    height, clearance = listed["road.bump.height"], listed["vehicle.bump_stop_clearance"]
    assert (height["unit"], height["default"], height["minimum"], height["maximum"]) == ("m", 0.1, -1, 1)
    assert (clearance["default"], clearance["minimum"]) == (None, 0.005)
    assert "kerb" in listed["road.bump.shape"]["choices"]
    assert cli("vehicles") == cli("vehicle")
    assert {each["name"] for each in json.loads(cli("vehicles", "--json"))} == set(VEHICLES)
    assert cli("presets", "watts", "circular").count("watts_hump") == 1
    assert {each["name"] for each in json.loads(cli("problems", "--json"))} == set(KINDS)
    cli("strategies", "no", "such", code=2)
