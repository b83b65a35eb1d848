"""The reverse proxy as it runs in production: the same program, the same configuration, other servers behind it."""

import os
from collections.abc import Sequence
from pathlib import Path

import httpx

from tests.servers.process import ROOT, Program, request, reserved_port, wait_until
from tests.servers.programs import find

CONFIGURATION = ROOT / "backend/deploy/haproxy.cfg"


class Proxy(Program):
    """HAProxy on a free port, its replicas at these addresses (host:port)."""

    def __init__(self, folder: Path, replicas: Sequence[str], **environment: str) -> None:
        self.port = reserved_port()
        self.tls_port = reserved_port()
        servers = folder / "servers.cfg"
        lines = [f"    server api{number} {address}" for number, address in enumerate(replicas, 1)]
        servers.write_text("\n".join(["backend api from replicas", *lines, ""]))
        command = [find("haproxy", package="haproxy"), "-db", "-f", str(CONFIGURATION), "-f", str(servers)]
        bind = {"PROXY_BIND": f"127.0.0.1:{self.port}", "PROXY_TLS_BIND": f"127.0.0.1:{self.tls_port}"}
        super().__init__("proxy", command, folder=folder, environment=bind | environment)
        wait_until(lambda: self.answers("/proxyz") or not self.running, "HAProxy starts")
        if not self.running:
            raise RuntimeError(f"HAProxy did not start:{os.linesep}{self.log}")

    @property
    def url(self) -> str:
        """Where it serves."""
        return f"http://127.0.0.1:{self.port}"

    def answers(self, path: str) -> bool:
        """Whether it answers that path with 200."""
        try:
            return request("GET", self.url + path).status_code == 200
        except httpx.TransportError:
            return False
