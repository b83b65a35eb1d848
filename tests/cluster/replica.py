"""A small server in a thread that stands for a replica of the API: it tells what it was asked, and can misbehave."""

import json
import socket
import threading
import time
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any, cast

from tests.servers.process import HANG_TIMEOUT


class Replica(ThreadingHTTPServer):
    """Answers with what it was asked.

    Attributes:
        ready: What /readyz says.
        breaks: Accept a request, then hang up without an answer.
        asked: How many requests other than health checks arrived.
        proceed: /events sends its second event only after this.
    """

    daemon_threads = True

    def __init__(self, name: str) -> None:
        super().__init__(("127.0.0.1", 0), _Handler)
        self.name = name
        self.ready = True
        self.breaks = False
        self.asked = 0
        self.proceed = threading.Event()
        threading.Thread(target=self.serve_forever, kwargs={"poll_interval": 0.05}, daemon=True).start()

    @property
    def address(self) -> str:
        """host:port."""
        return f"127.0.0.1:{self.server_address[1]}"

    def handle_error(self, *_: object) -> None:
        """A proxy that hangs up is nothing to print."""


class _Handler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def do_GET(self) -> None:
        replica = cast(Replica, self.server)
        if self.path == "/readyz":
            self._answer(200 if replica.ready else 503, {})
            return
        replica.asked += 1
        if replica.breaks:
            self.close_connection = True
            self.connection.shutdown(socket.SHUT_RDWR)
        elif self.path.endswith("/events"):
            self._stream(replica)
        else:
            length = int(self.headers.get("Content-Length", 0))
            headers = {name.lower(): value for name, value in self.headers.items()}
            self._answer(
                200, {"by": replica.name, "path": self.path, "headers": headers, "body": len(self.rfile.read(length))}
            )

    do_POST = do_GET  # noqa: N815 - the names the base class looks for

    def _answer(self, status: int, content: dict[str, Any]) -> None:
        body = json.dumps(content).encode()
        self.send_response(status)
        self.send_header("Content-Length", str(len(body)))
        self.send_header("Content-Type", "application/json")
        self.end_headers()
        self.wfile.write(body)

    def _stream(self, replica: Replica) -> None:
        self.send_response(200)
        self.send_header("Content-Type", "text/event-stream")
        self.send_header("Connection", "close")
        self.end_headers()
        self.wfile.write(b"data: first\n\n")
        self.wfile.flush()
        replica.proceed.wait(HANG_TIMEOUT)
        time.sleep(float(self.headers.get("X-Silence", 0)))
        self.wfile.write(b"data: second\n\n")

    def log_message(self, *_: object) -> None:
        pass
