"""The service in a terminal: what a person sees who starts it wrongly, and who stops it with Ctrl-C."""

import contextlib
import os
import signal
import sqlite3
import subprocess
import sys
from pathlib import Path

import psutil
import pytest

from tests.servers.process import wait_until


@pytest.mark.parametrize("port", ["99999", "-1", "http"])
def test_a_port_that_is_none_is_named(port: str) -> None:
    ended = subprocess.run(
        [sys.executable, "-m", "backend", "--port", port], capture_output=True, text=True, check=False
    )
    assert ended.returncode == 2
    assert ended.stderr.splitlines()[-1].endswith("error: argument --port: a number from 0 to 65535")


def test_ctrl_c_ends_a_start_that_waits(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "backend", "--port", "0", "--data-dir", str(tmp_path)]
    with contextlib.closing(sqlite3.connect(tmp_path / "ridelab.sqlite", isolation_level=None)) as stranger:
        stranger.execute("PRAGMA application_id=1")
        stranger.execute("BEGIN EXCLUSIVE")
        with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, start_new_session=True) as service:
            opened = psutil.Process(service.pid).open_files
            wait_until(lambda: any(file.path.endswith("ridelab.sqlite") for file in opened()), "it waits for the lock")
            service.send_signal(signal.SIGINT)
            _, log = service.communicate(timeout=30)
    assert service.returncode == 130
    assert "Traceback" not in log


def test_ctrl_c_ends_it_in_order(tmp_path: Path) -> None:
    """The terminal sends it to every process of the group."""
    command = [sys.executable, "-m", "backend", "--port", "0", "--data-dir", str(tmp_path)]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    ) as service:
        assert service.stdout is not None
        assert service.stdout.readline().startswith("Ridelab is at http://127.0.0.1:")
        os.killpg(service.pid, signal.SIGINT)
        _, log = service.communicate(timeout=30)
    assert service.returncode == 130
    assert "Traceback" not in log
    assert "Application shutdown complete." in log
