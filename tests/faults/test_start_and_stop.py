"""The service in a terminal: what a person sees who starts it wrongly, and who stops it with Ctrl-C."""

import contextlib
import os
import re
import shlex
import signal
import sqlite3
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import psutil
import pytest

from tests.client.cli import environment
from tests.faults.conftest import Process
from tests.faults.test_batches import HEAVY
from tests.servers.process import HANG_TIMEOUT, wait_until


@pytest.mark.parametrize(
    ("host", "names", "says"),
    [
        ("127.0.0.1", {}, r"Ridelab is at http://127\.0\.0\.1:\d+"),
        # As the image does by itself.
        (
            "0.0.0.0",  # noqa: S104
            {"RIDELAB_ALLOWED_HOSTS": "localhost,127.0.0.1"},
            r"Ridelab is at http://localhost:\d+; its data are in FOLDER, .*; links .* open on this machine alone",
        ),
    ],
)
def test_ctrl_c_ends_it_in_order(tmp_path: Path, host: str, names: dict[str, str], says: str) -> None:
    """The terminal sends it to every process of the group."""
    command = [sys.executable, "-m", "backend", "--host", host, "--port", "0", "--data-dir", str(tmp_path)]
    with subprocess.Popen(
        command,
        env=environment() | names,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as service:
        assert service.stdout is not None
        assert re.fullmatch(says.replace("FOLDER", re.escape(str(tmp_path))), service.stdout.readline().rstrip())
        os.killpg(service.pid, signal.SIGINT)
        _, log = service.communicate(timeout=HANG_TIMEOUT)
    assert service.returncode == 130
    assert "Traceback" not in log
    assert "Application shutdown complete." in log


def test_a_start_on_a_full_disk_says_so(tmp_path: Path) -> None:
    """Here no file may become larger than a block, and a new database is larger."""
    start = (
        f"ulimit -f 1; exec {shlex.quote(sys.executable)} -m backend --port 0 --data-dir {shlex.quote(str(tmp_path))}"
    )
    ended = subprocess.run(["bash", "-c", start], capture_output=True, text=True, timeout=HANG_TIMEOUT, check=False)
    assert ended.returncode == 2
    (line,) = ended.stderr.splitlines()
    assert line.startswith(f"Ridelab does not start: {tmp_path}/ridelab.sqlite: ")
    assert list(tmp_path.iterdir()) == []


# As process 1, as which a container starts it: there the system itself does nothing at SIGTERM.
FIRST = ("unshare", "--pid", "--fork", "--kill-child")
needs_root = pytest.mark.skipif(os.getuid() != 0, reason="only root makes a process namespace")


@pytest.mark.parametrize(
    ("before", "sent", "code"),
    [
        pytest.param((), signal.SIGINT, 130, marks=pytest.mark.thorough),
        pytest.param(FIRST, signal.SIGTERM, 143, marks=needs_root),
    ],
    ids=["Ctrl-C", "process 1"],
)
def test_a_start_that_waits_is_ended(tmp_path: Path, before: tuple[str, ...], sent: signal.Signals, code: int) -> None:
    command = [*before, sys.executable, "-m", "backend", "--port", "0", "--data-dir", str(tmp_path)]
    with contextlib.closing(sqlite3.connect(tmp_path / "ridelab.sqlite", isolation_level=None)) as stranger:
        stranger.execute("PRAGMA application_id=1")
        stranger.execute("BEGIN EXCLUSIVE")
        with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, start_new_session=True) as outside:
            service = psutil.Process(outside.pid)
            if before:
                wait_until(service.children, "it is there")
                (service,) = service.children()
            files = service.open_files
            wait_until(lambda: any(file.path.endswith("ridelab.sqlite") for file in files()), "it waits for the lock")
            service.send_signal(sent)
            _, log = outside.communicate(timeout=HANG_TIMEOUT)
    assert outside.returncode == code
    assert "Traceback" not in log


def test_whom_an_end_in_order_cannot_wait_for_is_told_to_come_again(tmp_path: Path) -> None:
    """Not uvicorn's own 500 in plain text; and such an end is no failure."""
    with Process(tmp_path, "ends") as service, ThreadPoolExecutor(1) as pool:
        service.wait_until_ready()
        asked = pool.submit(service.client.post, "/api/v1/runs", json={"scenario": HEAVY, "strategies": ["lv"]})
        service.wait_for_busy()
        code = service.terminate()
        answer = asked.result()
    assert (answer.status_code, answer.headers["content-type"]) == (503, "application/problem+json"), answer.text
    assert answer.json()["type"].endswith(":unavailable")
    assert int(answer.headers["retry-after"]) > 0
    assert code == 0
    assert "Traceback" not in service.log
