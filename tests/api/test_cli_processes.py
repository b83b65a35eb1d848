"""What the `ridelab` command starts and leaves behind: private services, Ctrl-C, SIGTERM, readers that go away."""

import contextlib
import csv
import io
import json
import os
import re
import signal
import sqlite3
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import httpx
import psutil
import pytest

from ridelab.cli import service
from ridelab.cli.following import submit_job
from ridelab.cli.service import Services
from ridelab.client import Ridelab
from ridelab.errors import JobEndedError, RidelabAPIError, RidelabConnectionError
from ridelab.jobs import Batch
from tests.api.conftest import Service
from tests.client.cli import Cli, command, environment
from tests.servers.process import HANG_TIMEOUT, request, wait_until

# Half a second of one core each, so that a sweep of them is still running when it is interrupted.
LONG = {"road": {"length": 10.1, "bump": {"start": 4}}, "mpc": {"solver": "osqp", "force_limit": 500}}


@pytest.fixture
def elsewhere(tmp_path: Path) -> Path:
    """A working folder with data, and with a trap: a package of the same name."""
    (tmp_path / "data").mkdir()
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
    """The processes that the command started end soon after the command."""
    before = set(private_services())
    yield
    wait_until(lambda: not set(private_services()) - before, "the private service ends")


def private_services(among: Iterable[psutil.Process] | None = None) -> list[int]:
    pids = []
    for process in psutil.process_iter() if among is None else among:
        with contextlib.suppress(psutil.Error):  # it has ended
            if "--until-input-ends" in process.cmdline():
                pids.append(process.pid)
    return pids


@pytest.mark.usefixtures("no_service_left")
def test_without_a_server_a_private_one_works_until_ctrl_c_and_keeps_what_it_stored(elsewhere: Path) -> None:
    log = elsewhere / "out"
    with log.open("wb") as out:
        arguments = command("open", "bump_only", "--strategy", "passive", "--print")
        process = subprocess.Popen(arguments, cwd=elsewhere, env=environment(), stdout=out, stderr=out)
    wait_until(lambda: "Serving until Ctrl-C" in log.read_text() or process.poll() is not None, "it serves")
    address = log.read_text().splitlines()[0]
    assert request("GET", address).status_code in (200, 503)  # 503 where the dashboard is not built
    stored = request("GET", address.replace("/r/", "/api/v1/runs/")).json()
    assert list(stored["strategies"]) == ["passive"]
    process.send_signal(signal.SIGINT)
    assert process.wait(HANG_TIMEOUT) == 0
    with contextlib.closing(sqlite3.connect(elsewhere / "data" / "ridelab.sqlite")) as database:
        assert database.execute("SELECT id FROM runs").fetchall() == [(stored["id"],)]


def test_a_private_service_that_does_not_start_says_why(alone: Cli) -> None:
    assert alone("run", "--data-dir", "/dev/null/data", code=3) == ""
    assert alone.error.startswith("Ridelab does not start: ")
    assert "Traceback" not in alone.error


@pytest.mark.parametrize(
    ("error", "stays"),
    [
        (RidelabAPIError(422, "Something is wrong"), False),
        (JobEndedError("The batch 1 was cancelled"), False),
        (RidelabAPIError(500, "Something went wrong"), True),
        (RidelabConnectionError("No service answers there"), True),
        (JobEndedError("The tuning 1 failed: it is in the service's log"), True),
    ],
)
def test_the_log_of_a_private_service_stays_where_the_service_failed(
    error: Exception, stays: bool, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    serves = "import sys; print('Ridelab is at http://127.0.0.1:9', flush=True); sys.stdin.read()"
    monkeypatch.setattr(service, "server_command", lambda *_, **__: [sys.executable, "-c", serves])
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    with pytest.raises(type(error)), service.private(None):
        raise error
    logs = list(tmp_path.iterdir())
    assert [log.read_text() for log in logs] == ["Ridelab is at http://127.0.0.1:9\n"] * stays
    said = capsys.readouterr().err
    assert all(str(log) in said for log in logs)


def stopped(client: httpx.Client, how: signal.Signals, seeds: str, folder: Path, *more: str) -> tuple[str, int, str]:
    """A sweep of 80 long runs that gets this signal in the middle: the batch's id, the exit code and what was said."""
    file = folder / "long.json"
    file.write_text(json.dumps(LONG), encoding="utf-8")
    server = str(client.base_url).rstrip("/")
    arguments = command("sweep", str(file), "--grid", f"road.seed={seeds}:80", *more, "--server", server)
    process = subprocess.Popen(arguments, env=environment(), stderr=subprocess.PIPE, text=True)
    batch_id = running_batch(client, 80)
    process.send_signal(how)
    _, said = process.communicate(timeout=HANG_TIMEOUT)
    return batch_id, process.returncode, said


@pytest.mark.usefixtures("no_service_left")
@pytest.mark.parametrize("written", [True, pytest.param(False, marks=pytest.mark.thorough)])
def test_ctrl_c_cancels_a_sweep_and_keeps_what_is_finished(client: httpx.Client, tmp_path: Path, written: bool) -> None:
    out = tmp_path / "its rows.csv"
    where = ("--out", str(out)) if written else ()
    batch_id, code, said = stopped(client, signal.SIGINT, "1:80", tmp_path, *where)
    first, *others = said.splitlines()
    assert code == 130
    assert re.fullmatch(rf"Cancelled; \d+ of 80 are finished and stay stored: batch {batch_id}", first)
    batch = client.get(f"/api/v1/batches/{batch_id}").json()
    assert batch["state"] == "cancelled"
    if not written:
        assert others[0].startswith(f"For its rows: ridelab export {batch_id} --wait --out FILE --server ")
        return
    assert others == [f"Wrote {out}: all 80 rows, those that never ran with the status cancelled"]
    rows = [row["status"] for row in csv.DictReader(io.StringIO(out.read_text(encoding="utf-8")))]
    assert (rows.count("ok"), rows.count("cancelled")) == (batch["done"], 80 - batch["done"])


def test_ctrl_c_while_a_sweep_is_submitted_cancels_it_and_its_results_can_still_be_taken(client: httpx.Client) -> None:
    """The service has taken it, and its answer has not come yet."""
    server = str(client.base_url).rstrip("/")
    taken = []
    with Ridelab(server) as ridelab, Services(server, None) as services:

        def submit(key: str) -> Batch:
            batch = ridelab.submit(LONG, ["suspension_only"], {"grid": {"road.seed": list(range(201, 281))}}, key)
            taken.append(batch.id)
            if len(taken) == 1:
                raise KeyboardInterrupt
            return batch

        batch, code = submit_job(submit, services)
        assert code == 130
        assert taken == [batch.id, batch.id]
        assert batch.state == "cancelled"


@pytest.mark.usefixtures("no_service_left")
def test_sigterm_names_the_batch_and_leaves_it_alone(client: httpx.Client, tmp_path: Path) -> None:
    batch_id, code, said = stopped(client, signal.SIGTERM, "101:180", tmp_path)
    assert code == 143
    again = f"ridelab export {batch_id} --wait --out FILE --server "
    assert said.startswith(f"Ended; the batch {batch_id} goes on. To wait for it: {again}")
    assert client.post(f"/api/v1/batches/{batch_id}/cancel").json()["done"] < 80


@pytest.mark.usefixtures("no_service_left")
def test_ctrl_c_on_an_export_leaves_the_batch_alone(service: Service, tmp_path: Path) -> None:
    body = {"scenario": LONG, "strategies": ["lv"], "sweep": {"grid": {"road.seed": list(range(200, 277))}}}
    batch_id = service.post("/api/v1/batches", json=body).raise_for_status().json()["id"]
    server, out = str(service.base_url).rstrip("/"), tmp_path / "rows.csv"
    arguments = command("export", batch_id, "--wait", "--out", str(out), "--server", server)
    process = subprocess.Popen(arguments, env=environment(), stderr=subprocess.PIPE, text=True)
    wait_until(lambda: service.services.gate.load["streams"] == 1, "it waits for the batch")
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=HANG_TIMEOUT)
    assert process.returncode == 130
    assert said.startswith(f"Stopped waiting; the batch {batch_id} goes on.")
    assert f"ridelab export {batch_id}" in said
    assert not out.exists()
    assert service.post(f"/api/v1/batches/{batch_id}/cancel").json()["done"] < 77


@pytest.mark.usefixtures("no_service_left")
@pytest.mark.parametrize(
    ("how", "code", "message"),
    [
        (signal.SIGINT, 130, "Interrupted: nothing was submitted, no file was written\n"),
        pytest.param(signal.SIGKILL, -signal.SIGKILL, "", marks=pytest.mark.thorough),
    ],
)
def test_a_private_service_that_still_starts_ends_with_its_command(
    elsewhere: Path, how: signal.Signals, code: int, message: str
) -> None:
    arguments = command("sweep", "--grid", "road.seed=1:80:80", "--out", "rows.csv")
    process = subprocess.Popen(arguments, cwd=elsewhere, env=environment(), stderr=subprocess.PIPE, text=True)
    wait_until(lambda: private_services(psutil.Process(process.pid).children()), "it starts its service")
    process.send_signal(how)
    _, said = process.communicate(timeout=HANG_TIMEOUT)
    assert (process.returncode, said) == (code, message)
    assert not (elsewhere / "rows.csv").exists()


def running_batch(client: httpx.Client, total: int) -> str:
    """The id of the newest batch once it runs and has so many runs."""

    def newest() -> dict[str, Any]:
        batches: list[dict[str, Any]] = client.get("/api/v1/batches?limit=1").json()["batches"]
        return batches[0] if batches else {}

    wait_until(lambda: (newest().get("total"), newest().get("state")) == (total, "running"), "the batch begins")
    return str(newest()["id"])


def test_a_reader_that_goes_away_is_no_error(client: httpx.Client) -> None:
    read, write = os.pipe()
    os.close(read)
    arguments = command("run", "--strategy", "passive", "--json", "--server", str(client.base_url))
    run = subprocess.run(arguments, env=environment(), stdout=write, stderr=subprocess.PIPE, check=False)
    os.close(write)
    assert (run.returncode, run.stderr) == (141, b"")
