"""The `ridelab` command against the real service, and with the private one it starts by itself."""

import csv
import io
import json
import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import psutil
import pyarrow.parquet as pq
import pytest

from backend.client import Interval
from sim_core import __version__
from sim_core.__main__ import main as core_main
from sim_core.catalogue import SIGNALS
from sim_core.strategies import STRATEGIES
from tests.api.cli import Cli, command, environment
from tests.api.conftest import Service
from tests.servers.process import wait_until

SCENARIO = {"road": {"length": 118, "bump": {"start": 77}}}  # nobody else's
# Half a second of one core each, so that a sweep of them is still running when it is interrupted.
LONG = {"road": {"length": 10.1, "bump": {"start": 4}}, "mpc": {"solver": "osqp", "force_limit": 500}}


def timeless(table: str) -> list[str]:
    """A run's table without its first line and what changes from run to run: how long it took."""
    return [re.sub(r" +[\d.]+ ms$", "", line) for line in table.rstrip().splitlines()[1:]]


def test_run_prints_the_cores_own_table(cli: Cli, scenario: Path, capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    printed = cli("run", scenario)
    assert core_main(["run", "--scenario", str(scenario)]) == 0
    sys.stdout.flush()
    expected = timeless(capfdbinary.readouterr().out.decode())
    assert timeless(printed)[: len(expected)] == expected
    assert printed.startswith(f"Ridelab core {__version__}, {scenario}; changes against Passive")


def test_run_over_several_roads_prints_means_intervals_and_paired_changes(
    cli: Cli, scenario: Path, tmp_path: Path
) -> None:
    words = ("run", scenario, "--strategy", "lv,lqr,passive", "--roads", "3", "--baseline", "lqr")
    printed = cli(*words)
    assert printed.startswith(
        f"Ridelab core {__version__}, {scenario}, 3 roads (seeds 1 to 3; events of 1); changes against LQR"
    )
    run = json.loads(cli(*words, "--json"))
    assert (run["roads"], run["baseline"]) == (3, "lqr")
    lv, change = (
        where["lv"]["bump"]["body_acceleration"]["peak"]
        for where in ({"lv": run["strategies"]["lv"]["metrics"]}, run["changes"])
    )
    uncertainty = change["high"] - change["mean"]
    assert f"{Interval(**lv)} ({change['mean']:+.1f} ± {uncertainty:.1f} %)" in printed
    saved = tmp_path / "saved.json"
    saved.write_text(json.dumps(run), encoding="utf-8")
    again = cli("compare", saved, scenario)
    assert "Equal within the tolerance: 210 figures" in again, "the other side drives as many roads"
    assert "mean of 3 roads" in again
    for wrong, says in (("0", "greater than or equal to 1"), ("51", "less than or equal to 50"), ("3.5", "integer")):
        cli("run", "--roads", wrong, code=2)
        assert says in cli.error
    cli("run", "--strategy", "lv", "--roads", "2", "--baseline", "lqr", code=2)
    assert cli.error.startswith("--baseline: one of the strategies that run")


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
        assert "Equal within the tolerance: 140 figures of lv, passive" in cli("compare", name, run_id), name
    changed = cli("compare", run_id, saved, "--strategy", "lv")
    assert "70 figures" in changed
    assert cli("open", run_id, "--print") == f"{address}\n"
    assert cli("open", slug, "--print").endswith(f"/s/{slug}\n")
    assert cli("open", scenario, "--set", "road.seed=3", "-s", "lv,passive", "--print") == f"{address}\n"
    assert "no run, batch or link" in (cli("open", "A" * 22, "--print", code=2), cli.error)[1]


def test_compare_tells_what_was_changed_and_by_how_much(cli: Cli, scenario: Path) -> None:
    other = scenario.with_name("other.json")
    other.write_text(json.dumps({"road": {**SCENARIO["road"], "seed": 1, "roughness": 0.0001}}), encoding="utf-8")
    printed = cli("compare", scenario, other, "--strategy", "passive", "--limit", "3", code=1)
    assert "road.roughness [m^3]: 6.4e-05 -> 0.0001" in printed
    assert re.search(r"^passive +rough_road\.\w+\.\w+ \[.+\] .* [+-][\d.]+ %$", printed, re.MULTILINE)
    told = json.loads(cli("compare", scenario, other, "--strategy", "passive", "--json", code=1))
    changes = [abs(item["change"]) for item in told["differences"] if item["change"] is not None]
    assert changes == sorted(changes, reverse=True)
    # A road that is rougher by a factor has every magnitude on it greater by that factor's root.
    roots = [item for item in told["differences"] if item["figure"] == "rough_road.body_acceleration.rms"]
    assert roots[0]["change"] == pytest.approx((0.0001 / 6.4e-05) ** 0.5 - 1, rel=1e-6)
    cli("compare", scenario, other, "--strategy", "passive", "--tolerance", "5", "--tolerance-abs", "9")


def test_a_refusal_names_the_field(cli: Cli, scenario: Path) -> None:
    scenario.write_text('{"road": {"bump": {"height": 3}}}', encoding="utf-8")
    assert cli("run", scenario, code=2) == ""
    assert cli.error == "road.bump.height: Input should be less than or equal to 1\n"
    assert cli("run", "--set", "road.bump.start=149", code=2) == ""
    assert cli.error.startswith("road.bump.start: The bump must end before the road does")
    assert cli("run", "--strategy", "best", code=2) == ""
    assert cli.error.startswith("strategies[0]: Unknown strategy best; there are lv, lv_hil, lqr")


@pytest.mark.parametrize("file_format", ["csv", "json", "parquet"])
def test_a_sweep_writes_every_row(cli: Cli, scenario: Path, tmp_path: Path, file_format: str) -> None:
    out = tmp_path / f"results.{file_format}"
    grid = ("--grid", "road.bump.height=0.03:0.05:3", "--grid", "mpc.preview=lookahead,none")
    assert cli("sweep", scenario, *grid, "-s", "lv", "-s", "passive", "--out", out) == ""
    assert re.fullmatch(r"batch [\w-]{22}: 12 of 12 runs done, 0 failed\n", cli.error)
    if file_format == "csv":
        rows: list[Any] = list(csv.DictReader(io.StringIO(out.read_text(encoding="utf-8"))))
        heights = [float(row["road.bump.height [m]"]) for row in rows]
    elif file_format == "json":
        rows = json.loads(out.read_text())["rows"]
        heights = [row["road.bump.height"] for row in rows]
    else:
        rows = pq.read_table(out).to_pylist()
        heights = [row["road.bump.height [m]"] for row in rows]
    assert heights == [0.03] * 4 + [0.04] * 4 + [0.05] * 4
    assert {row["strategy"] for row in rows} == {"lv", "passive"}


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
    assert "1 of 2 runs done, 1 failed" in cli.error
    long = cli("sweep", scenario, "--grid", "road.bump.height=0.01:0.05:25", "-s", "passive")
    assert long.splitlines()[-1] == "... 5 more; --out FILE writes all with every figure"


def test_other_sweeps(cli: Cli, scenario: Path, tmp_path: Path) -> None:
    points = tmp_path / "points.json"
    points.write_text('[{"road.bump.height": 0.02}, {"road.bump.width": 3}]', encoding="utf-8")
    ended = json.loads(cli("sweep", scenario, "--list", points, "-s", "passive", "--json"))
    assert (ended["state"], ended["total"], ended["done"]) == ("done", 2, 2)
    cube = ("--latin-hypercube", "road.bump.height=0.02:0.04", "--samples", "6", "--seed", "4")
    rows = json.loads(cli("sweep", scenario, *cube, "-s", "passive", "--out", "-", "--format", "json"))["rows"]
    assert len({row["road.bump.height"] for row in rows}) == 6
    assert all(0.02 <= row["road.bump.height"] <= 0.04 for row in rows)
    assert cli("sweep", scenario, *cube, "--dry-run").startswith("6 runs at 6 points")
    assert cli("sweep", scenario, "--grid", "road.bump.height=0.1,2", code=2) == ""
    assert cli.error == "road.bump.height: Input should be less than or equal to 1\n"


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
    figures = tmp_path / "run.json"
    cli("export", run_id, "--metrics", "--out", figures)
    assert "Equal" in cli("compare", figures, run_id)
    before = figures.read_bytes()
    cli("export", run_id, "--out", figures, "--signals", "nothing", code=2)
    assert cli.error.startswith("signals: Unknown name; there are time, position")
    assert figures.read_bytes() == before


@pytest.fixture
def elsewhere(tmp_path: Path) -> Path:
    """A working folder with a trap: a package of the same name."""
    (tmp_path / "backend").mkdir()
    (tmp_path / "backend" / "__init__.py").write_text("raise SystemExit('the wrong backend')", encoding="utf-8")
    return tmp_path


@pytest.fixture
def alone(elsewhere: Path, capfdbinary: pytest.CaptureFixture[bytes], monkeypatch: pytest.MonkeyPatch) -> Cli:
    """The command in that folder, where no service is named."""
    monkeypatch.chdir(elsewhere)
    monkeypatch.setenv("RIDELAB_WORKERS", "1")
    return Cli(capfdbinary)


@pytest.fixture
def no_service_left() -> Iterator[None]:
    """What the command started is gone soon after the command."""
    before = set(private_services())
    yield
    wait_until(lambda: not set(private_services()) - before, "the private service ends", 30)


def private_services() -> list[int]:
    processes = psutil.process_iter(["cmdline"])
    return [process.pid for process in processes if "backend.cli.embedded" in (process.info["cmdline"] or ())]


@pytest.mark.usefixtures("no_service_left")
def test_without_a_server_a_private_one_works_and_keeps_what_it_stored(alone: Cli, elsewhere: Path) -> None:
    run_id = alone("run", "bump_only", "--strategy", "passive").split()[-1]
    assert alone.error == ""
    assert (elsewhere / "data" / "ridelab.sqlite").is_file()
    # The next one opens it, and serves it until Ctrl-C.
    log = elsewhere / "out"
    with log.open("wb") as out:
        arguments = command("open", run_id, "--print")
        process = subprocess.Popen(arguments, cwd=elsewhere, env=environment(), stdout=out, stderr=out)
    said(process, log, "Serving until Ctrl-C")
    address = log.read_text().splitlines()[0]
    assert httpx.get(address).status_code in (200, 503)  # 503 where the dashboard is not built
    stored = httpx.get(address.replace(f"/r/{run_id}", f"/api/v1/runs/{run_id}")).json()
    assert list(stored["strategies"]) == ["passive"]
    process.send_signal(signal.SIGINT)
    assert process.wait(60) == 0


def said(process: subprocess.Popen[bytes], log: Path, pattern: str) -> re.Match[str]:
    """Wait for the process to say it."""

    def found() -> re.Match[str] | None:
        assert process.poll() is None, log.read_text()
        return re.search(pattern, log.read_text())

    wait_until(found, f"it says {pattern}")
    match = found()
    assert match is not None
    return match


def test_a_private_service_that_does_not_start_says_why(alone: Cli) -> None:
    assert alone("run", "--data-dir", "/dev/null/data", code=3) == ""
    assert alone.error.startswith("Ridelab does not start: ")
    assert "Traceback" not in alone.error


@pytest.mark.usefixtures("no_service_left")
@pytest.mark.parametrize("written", [True, False])
def test_ctrl_c_cancels_a_sweep_and_keeps_what_is_finished(client: httpx.Client, tmp_path: Path, written: bool) -> None:
    file = tmp_path / "long.json"
    file.write_text(json.dumps(LONG), encoding="utf-8")
    server = str(client.base_url).rstrip("/")
    out = tmp_path / "its rows.csv"
    where = ("--out", str(out)) if written else ()
    arguments = command("sweep", str(file), "--grid", "road.seed=1:80:80", *where, "--server", server)
    process = subprocess.Popen(arguments, env=environment(), stderr=subprocess.PIPE, text=True)
    batch_id = running_batch(client, 80)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=60)
    assert process.returncode == 130
    first, second = said.splitlines()
    assert re.fullmatch(rf"Cancelled; \d+ of 80 runs are finished and stay stored: batch {batch_id}", first)
    batch = client.get(f"/api/v1/batches/{batch_id}").json()
    assert batch["state"] == "cancelled"
    if not written:
        assert second == f"For its rows: ridelab export {batch_id} --out FILE --server {server}"
        return
    assert second == f"{out} has all 80 rows, those that never ran with the status cancelled"
    rows = [row["status"] for row in csv.DictReader(io.StringIO(out.read_text(encoding="utf-8")))]
    assert (rows.count("ok"), rows.count("cancelled")) == (batch["done"], 80 - batch["done"])


@pytest.mark.usefixtures("no_service_left")
def test_ctrl_c_on_an_export_leaves_the_batch_alone(service: Service, tmp_path: Path) -> None:
    client = service.client
    body = {"scenario": LONG, "strategies": ["lv"], "sweep": {"grid": {"road.seed": list(range(200, 277))}}}
    client.post("/api/v1/batches", json=body).raise_for_status()
    batch_id = running_batch(client, 77)
    server, out = str(client.base_url).rstrip("/"), tmp_path / "rows.csv"
    arguments = command("export", batch_id, "--wait", "--out", str(out), "--server", server)
    process = subprocess.Popen(arguments, env=environment(), stderr=subprocess.PIPE, text=True)
    wait_until(lambda: service.app.state.admission.load["streams"] == 1, "it waits for the batch")
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=60)
    assert process.returncode == 130
    assert said.startswith("Stopped waiting; the batch goes on.")
    assert f"ridelab export {batch_id}" in said
    assert not out.exists()
    assert client.post(f"/api/v1/batches/{batch_id}/cancel").json()["done"] < 77
    events = client.get(f"/api/v1/batches/{batch_id}/events").text
    assert events.count('"cancelled"') == 1, "by this test alone"


@pytest.mark.usefixtures("no_service_left")
@pytest.mark.parametrize(
    ("how", "code", "message"),
    [(signal.SIGINT, 130, "Interrupted, nothing was submitted\n"), (signal.SIGKILL, -signal.SIGKILL, "")],
)
def test_a_private_service_that_still_starts_ends_with_its_command(
    elsewhere: Path, how: signal.Signals, code: int, message: str
) -> None:
    before = set(private_services())
    arguments = command("sweep", "--grid", "road.seed=1:80:80", "--out", "rows.csv")
    process = subprocess.Popen(arguments, cwd=elsewhere, env=environment(), stderr=subprocess.PIPE, text=True)
    wait_until(lambda: set(private_services()) - before, "it starts its service")
    process.send_signal(how)
    _, said = process.communicate(timeout=60)
    assert (process.returncode, said) == (code, message)
    assert not (elsewhere / "rows.csv").exists()


def running_batch(client: httpx.Client, total: int) -> str:
    """The id of the newest batch once it runs and has so many runs."""

    def newest() -> dict[str, Any]:
        found: list[dict[str, Any]] = client.get("/api/v1/batches?limit=1").json()["batches"]
        return found[0] if found else {}

    wait_until(lambda: (newest().get("total"), newest().get("state")) == (total, "running"), "the batch begins")
    return str(newest()["id"])


def test_a_reader_that_goes_away_is_no_error(client: httpx.Client) -> None:
    read, write = os.pipe()
    os.close(read)
    arguments = command("run", "--strategy", "passive", "--json", "--server", str(client.base_url))
    run = subprocess.run(arguments, env=environment(), stdout=write, stderr=subprocess.PIPE, check=False)
    os.close(write)
    assert (run.returncode, run.stderr) == (141, b"")


def test_serve_is_the_service_itself(elsewhere: Path) -> None:
    arguments = command("serve", "--port", "0", "--data-dir", "mine")
    mine = environment(RIDELAB_SERVER="http://127.0.0.1:9")  # the commands' variable, no setting of the service
    log = elsewhere / "log"
    with log.open("wb") as out:
        process = subprocess.Popen(arguments, cwd=elsewhere, env=mine, stdout=out, stderr=out)
    address = said(process, log, r"Ridelab is at (\S+)\n")[1]
    assert httpx.get(f"{address}/healthz").status_code == 200
    assert (elsewhere / "mine" / "ridelab.sqlite").is_file()
    process.terminate()
    assert process.wait(60) in (0, -signal.SIGTERM)  # uvicorn passes the signal on once it has ended well


def test_the_installed_command_is_this_one() -> None:
    installed = Path(sys.executable).parent / "ridelab"
    run = subprocess.run([installed, "--version"], cwd="/", capture_output=True, text=True, check=False)
    assert (run.returncode, run.stdout) == (0, f"Ridelab {__version__}\n"), run.stderr


def test_strategies_are_all_of_them_unless_named(cli: Cli, scenario: Path) -> None:
    assert set(json.loads(cli("run", scenario, "--json"))["strategies"]) == set(STRATEGIES)
