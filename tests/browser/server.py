"""The real service as a process of its own, which a test can take away and bring back."""

import socket
import subprocess
import sys
import time
from pathlib import Path

import httpx

ROOT = Path(__file__).parents[2]


class Server:
    """`python -m backend` on a free port with data of its own; the port stays the same over restarts."""

    def __init__(self, data: Path) -> None:
        self._data = data
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            self._port: int = probe.getsockname()[1]
        self._process: subprocess.Popen[bytes] | None = None

    @property
    def url(self) -> str:
        """Where it serves."""
        return f"http://127.0.0.1:{self._port}"

    @property
    def database(self) -> Path:
        """Where what it keeps lies."""
        return self._data / "ridelab.sqlite"

    def start(self, seconds: float = 40) -> None:
        """Starts and waits until it is ready."""
        command = [sys.executable, "-m", "backend", "--port", str(self._port), "--data-dir", str(self._data)]
        with (self._data.parent / "server.log").open("ab") as log:
            self._process = subprocess.Popen(command, cwd=ROOT, stdout=log, stderr=log)
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
