"""The `ridelab` command for tests: in this process, or as one of its own."""

import os
import sys
from pathlib import Path

import pytest

from ridelab.cli import app

ROOT = Path(__file__).parents[2]


class Cli:
    """The command in this process, with the tests' service."""

    def __init__(self, capfdbinary: pytest.CaptureFixture[bytes]) -> None:
        self._captured = capfdbinary
        self.error = ""

    def __call__(self, *arguments: str | Path, code: int = 0) -> str:
        exit_code = app.run([str(argument) for argument in arguments])
        sys.stdout.flush()
        captured = self._captured.readouterr()
        self.error = captured.err.decode()
        assert exit_code == code, self.error
        return captured.out.decode()


def command(*arguments: str) -> list[str]:
    return [sys.executable, "-P", "-m", "ridelab", *arguments]


SMALL = {"RIDELAB_WORKERS": "1", "RIDELAB_BATCH_WORKERS": "1"}


def environment(**more: str) -> dict[str, str]:
    """No service is named; one that the command starts has a single worker, which is ready soonest."""
    base = {name: value for name, value in os.environ.items() if not name.startswith("RIDELAB_")}
    return {**base, "PYTHONPATH": os.pathsep.join((str(ROOT), str(ROOT / "client"))), **SMALL, **more}
