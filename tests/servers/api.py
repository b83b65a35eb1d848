"""The service as an operator runs it: `python -m backend`, started again when it dies, on a port that stays."""

import contextlib
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import httpx

from tests.servers.process import HANG_TIMEOUT, Program, request, reserved_port, wait_until


class Api(Program):
    """One replica; `PROGRAM` is what Python runs."""

    PROGRAM: Sequence[str] = ("-m", "backend")

    def __init__(self, folder: Path, *, name: str = "api", **environment: str) -> None:
        self.port = reserved_port()
        command = [sys.executable, *self.PROGRAM, "--port", str(self.port), "--data-dir", str(folder / "data")]
        super().__init__(name, command, folder=folder, environment=environment, restart=True)

    @property
    def url(self) -> str:
        """Where it serves."""
        return f"http://127.0.0.1:{self.port}"

    @property
    def ready(self) -> bool:
        """Whether it says so now."""
        with contextlib.suppress(httpx.TransportError):
            return request("GET", f"{self.url}/readyz").status_code == 200
        return False

    def wait_until_ready(self) -> None:
        """Wait for it."""
        wait_until(lambda: self.ready, f"{self.name} is ready")


def ask(url: str, method: str, path: str, **options: Any) -> Any:
    """The JSON of an answer with a good status; while the service is down or full it is asked again."""
    end = time.monotonic() + HANG_TIMEOUT
    while time.monotonic() < end:
        with contextlib.suppress(httpx.TransportError):
            answer = request(method, f"{url}/api/v1{path}", **options)
            if answer.is_success:
                return answer.json()
            assert answer.status_code in (429, 502, 503, 504), f"{answer.status_code} {answer.text}"
        time.sleep(0.2)
    raise TimeoutError(f"{url} did not answer {method} {path}")
