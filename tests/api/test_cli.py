"""The `ridelab` command against the real service."""

import csv
import io
import json
import re
import subprocess
from pathlib import Path

import httpx
import pyarrow.parquet as pq
import pytest

from backend.runs.reports import inputs
from sim_core.catalogue import SIGNALS
from sim_core.scenario import Scenario, dotted
from tests.api.cli import Cli, command, environment

SCENARIO = {"road": {"length": 118, "bump": {"start": 77}}}  # nobody else's


def test_the_command_a_report_prints_gives_the_same_scenario(cli: Cli) -> None:
    changes = {"road.roughness": 256e-6, "road.seed": 7, "road.bump.shape": "flat_top", "lqr.weights": [1, 2.5, 3]}
    expected = dotted.with_changes(Scenario().model_dump(mode="json"), changes)
    words = inputs.command(expected, ["passive"]).split()
    assert json.loads(cli(*words[1:], "--json"))["scenario"] == expected


def test_a_road_class_is_named_wherever_its_roughness_may_stand(cli: Cli, scenario: Path) -> None:
    named, number = (
        json.loads(cli("run", scenario, "-s", "passive", "--set", f"road.roughness={value}", "--json"))
        for value in ("C", 256e-6)
    )
    assert named["id"] == number["id"]
    assert named["scenario"]["road"]["roughness"] == 256e-6
    cli("sweep", scenario, "--grid", "road.roughness=A,C", "-s", "passive", "--out", scenario.with_suffix(".json"))
    saved = json.loads(scenario.with_suffix(".json").read_text())
    assert [row["road.roughness"] for row in saved["rows"]] == [16e-6, 256e-6]
    cli("run", scenario, "--set", "road.roughness=I", code=2)
    assert "road.roughness: Input should be a number or a road class of ISO 8608, A to H" in cli.error


def test_a_saved_run_over_several_roads_is_compared_with_as_many(cli: Cli, scenario: Path, tmp_path: Path) -> None:
    saved = tmp_path / "saved.json"
    saved.write_text(cli("run", scenario, "--strategy", "lv,passive", "--roads", "3", "--json"), encoding="utf-8")
    again = cli("compare", saved, scenario)
    assert "Equal within the tolerance: 140 metrics" in again
    assert "mean of 3 roads" in again


def test_a_run_can_be_named_in_every_way(cli: Cli, client: httpx.Client, scenario: Path, tmp_path: Path) -> None:
    address = cli("run", scenario, "--strategy", "lv,passive", "--set", "road.seed=3").splitlines()[-1]
    assert address.startswith(f"{client.base_url}/r/".replace("//r", "/r"))
    run_id = address.rpartition("/")[2]
    saved = tmp_path / "saved.json"
    saved.write_text(cli("run", address, "-s", "lv", "-s", "passive", "--json"), encoding="utf-8")
    run = json.loads(saved.read_text())
    assert run["id"] == run_id
    assert run["units"]["bump.body_acceleration.peak"] == "m/s^2"
    slug = client.post("/api/v1/links", json={"run_id": run_id}).json()["slug"]
    for name in (run_id, address, saved, slug, address.replace(f"/r/{run_id}", f"/s/{slug}")):
        assert "Equal within the tolerance: 140 metrics of lv, passive" in cli("compare", name, run_id), name
    assert cli("open", run_id, "--print") == f"{address}\n"
    assert cli("open", slug, "--print").endswith(f"/s/{slug}\n")
    assert cli("open", scenario, "--set", "road.seed=3", "-s", "lv,passive", "--print") == f"{address}\n"
    for unknown, said in (("A" * 22, "no run, batch or link"), ("nothing", "neither a file, nor a preset (paper,")):
        cli("open", unknown, "--print", code=2)
        assert said in cli.error


def test_a_sweep_shows_its_first_rows_and_failed_runs_in_the_exit_code(cli: Cli, scenario: Path) -> None:
    printed = cli("sweep", scenario, "--grid", "road.bump.start=70,117", code=1)
    head, good, bad = printed.splitlines()
    assert re.split(r" {2,}", head)[:3] == ["road.bump.start [m]", "strategy", "status"]
    assert re.split(r" {2,}", head)[4:] == [
        "bump.body_acceleration.peak [m/s^2]",
        "bump.front_tyre_load.peak [N]",
        "reason",
    ]
    assert good.split()[:3] == ["70", "lv", "ok"]
    assert bad.split()[:3] == ["117", "lv", "failed"]
    assert "road.bump.start: The bump must end before the road does" in bad
    assert "done, 1 of 2 done, 1 failed" in cli.error
    long = cli("sweep", scenario, "--grid", "road.bump.height=0.01:0.05:25", "-s", "passive")
    assert long.splitlines()[-1] == "... 5 more; --out FILE writes all with every metric"
    whole = json.loads(cli("sweep", scenario, "--grid", "road.bump.start=70,117", "--json", code=1))
    assert whole["total"] == 2
    assert [(row["road.bump.start"], row["status"]) for row in whole["rows"]] == [(70, "ok"), (117, "failed")]


def test_a_run_says_what_its_numbers_do_not(cli: Cli, scenario: Path) -> None:
    late = ["--set", "speed.detection_distance=5", "--set", "speed.target_speed_kmh=10"]
    assert "\nLV control  target speed not reached\n" in cli("run", scenario, "-s", "lv,passive", *late)
    assert "not reached" not in cli("run", scenario, "-s", "lv,passive")


def test_a_sweep_left_alone_is_exported_later(cli: Cli, scenario: Path, client: httpx.Client, tmp_path: Path) -> None:
    batch_id = cli("sweep", scenario, "--grid", "road.seed=21:26:6", "--detach").strip()
    assert "--wait" in cli.error
    out = tmp_path / "later.csv"
    assert cli("export", batch_id, "--wait", "--out", out) == ""
    assert [row["status"] for row in csv.DictReader(io.StringIO(out.read_text(encoding="utf-8")))] == ["ok"] * 6
    address = cli("open", batch_id, "--print").strip()
    slug = address.rpartition("/")[2]
    assert client.get(f"/api/v1/links/{slug}").json()["batch"]["id"] == batch_id
    again = tmp_path / "again.parquet"
    cli("export", address, "--out", again)
    assert pq.read_table(again).num_rows == 6
    assert "compare takes single runs" in (cli("compare", address, "paper", code=2), cli.error)[1]


def test_a_runs_time_histories_and_figures_are_exported(cli: Cli, scenario: Path, tmp_path: Path) -> None:
    run_id = cli("run", scenario, "-s", "lv,passive").split("/r/")[1].strip()
    out = tmp_path / "series.csv"
    cli("export", run_id, "--out", out, "--signals", "speed,front_force", "--points", "200")
    rows = list(csv.DictReader(io.StringIO(out.read_text(encoding="utf-8"))))
    assert list(rows[0]) == ["strategy", "time [s]", "position [m]", "speed [m/s]", "front_force [N]"]
    assert {row["strategy"] for row in rows} == {"lv", "passive"}
    whole = tmp_path / "series.parquet"
    cli("export", run_id, "--out", whole, "--strategy", "lv")
    assert pq.read_table(whole).num_columns == len(SIGNALS)
    lines = list(csv.DictReader(io.StringIO(cli("export", run_id, "--metrics", "--out", "-", "--format", "csv"))))
    assert lines[1] == {**lines[1], "strategy": "lv", "metric": "rough_road.body_acceleration.peak", "unit": "m/s^2"}
    assert len(lines) == 140
    figures = tmp_path / "run.json"
    cli("export", run_id, "--metrics", "--out", figures)
    assert "Equal" in cli("compare", figures, run_id)
    before = figures.read_bytes()
    cli("export", run_id, "--out", figures, "--signals", "nothing", code=2)
    assert cli.error.startswith("signals: Unknown name; there are time, position")
    assert figures.read_bytes() == before


def test_jobs_are_listed_shown_followed_and_stopped(cli: Cli, scenario: Path) -> None:
    words = ("--grid", "road.seed=31:40:10", "-s", "passive", "--detach", "--label", "ten roads")
    batch_id = cli("sweep", scenario, *words).strip()
    cli("jobs", "follow", batch_id)
    assert cli.error == f"batch {batch_id}: done, 10 of 10 done, 0 failed\n"
    tuning_id = cli("tune", scenario, "--strategy", "lqr", "--trials", "4000", "--detach").strip()
    cli("jobs", "follow", tuning_id, "--timeout", "0.2", code=3)
    assert re.match(f"The tuning {tuning_id} is (queued|running) after 0.2 s", cli.error)
    cli("jobs", "delete", tuning_id, code=2)
    assert cli.error.startswith("It has not ended, or a link shows it: cancel it first")
    cli("jobs", "cancel", tuning_id)
    assert cli.error.startswith(f"tuning {tuning_id}: cancelled, ")
    listed = cli("jobs", "list").splitlines()
    assert [line.split()[:3] for line in listed[1:3]] == [
        ["tuning", tuning_id, "cancelled"],
        ["batch", batch_id, "done"],
    ]
    assert json.loads(cli("jobs", "list", "--json"))[0]["kind"] == "tuning"
    shown = cli("jobs", "show", batch_id)
    assert re.search(r"^swept: +road\.seed$", shown, re.MULTILINE)
    assert f"ridelab export {batch_id} --wait --out FILE" in shown
    assert cli("jobs", "list", "--label", "ten roads").splitlines()[1].endswith("ten roads")
    cli("jobs", "label", batch_id, "")
    cli("jobs", "list", "--label", "ten roads")
    assert cli.error == "There are none\n"
    cli("jobs", "resume", tuning_id)
    assert re.match(f"tuning {tuning_id}: (queued|running), ", cli.error)
    cli("jobs", "cancel", tuning_id)
    cli("jobs", "delete", tuning_id, batch_id)
    assert cli.error == f"tuning {tuning_id}: deleted\nbatch {batch_id}: deleted\n"
    cli("jobs", "show", batch_id, code=2)
    assert "no batch or tuning of this id" in cli.error


def test_the_shell_completes_names_that_a_service_gave(
    cli: Cli, scenario: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    cli("run", scenario, "-s", "passive")
    for words, completed in (
        ("run pap", "paper"),
        ("run --set road.bump.he", "road.bump.height="),
        ("sweep -s lv,lq", "lv,lqr"),
        ("compare a b --metric comfort.vib", "comfort.vibration_dose"),
    ):
        variables = {"COMP_WORDS": f"ridelab {words}", "COMP_CWORD": str(len(words.split()))}
        run = subprocess.run(
            command(),
            env=environment(_RIDELAB_COMPLETE="complete_bash", XDG_CACHE_HOME=str(tmp_path), **variables),
            capture_output=True,
            text=True,
            check=False,
        )
        assert completed in run.stdout.split(), (words, run)
