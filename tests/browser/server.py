"""The real service as a process of its own, which a test can take away and bring back."""

import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import httpx

from tests.servers.process import ROOT, free_port


class Server:
    """`python -m backend` on a free port with data of its own; the port stays the same over restarts."""

    def __init__(self, data: Path) -> None:
        self._data = data
        self._port = free_port()
        self._process: subprocess.Popen[bytes] | None = None

    @property
    def url(self) -> str:
        """Where it serves."""
        return f"http://127.0.0.1:{self._port}"

    @property
    def database(self) -> Path:
        """Where what it keeps lies."""
        return self._data / "ridelab.sqlite"

    def submit(self, sweep: dict[str, Any], strategies: list[str]) -> str:
        """Submits a batch over the paper's scenario, as a script does; returns its page's path."""
        body = {"scenario": {}, "strategies": strategies, "sweep": sweep}
        answer = httpx.post(f"{self.url}/api/v1/batches", json=body, timeout=60).raise_for_status().json()
        return f"/b/{answer['id']}"

    def start(self, seconds: float = 40) -> None:
        """Starts and waits until it is ready."""
        # A page asks for one thing at a time: more workers would only take longer to start.
        few = {"RIDELAB_WORKERS": "1", "RIDELAB_BATCH_WORKERS": "1"}
        command = [sys.executable, "-m", "backend", "--port", str(self._port), "--data-dir", str(self._data)]
        with (self._data.parent / "server.log").open("ab") as log:
            self._process = subprocess.Popen(command, cwd=ROOT, env=os.environ | few, stdout=log, stderr=log)
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            try:
                if httpx.get(f"{self.url}/readyz").status_code == 200:
                    return
            except httpx.TransportError:
                pass
            if self._process.poll() is not None:
                break
            time.sleep(0.05)
        raise RuntimeError(f"The server did not get ready:\n{(self._data.parent / 'server.log').read_text()[-3000:]}")

    def stop(self) -> None:
        """Ends it as an operator would."""
        if self._process is not None:
            self._process.terminate()
            self._process.wait(15)
            self._process = None
