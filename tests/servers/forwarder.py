"""Forwards TCP connections to a port of this machine, and stops when told to: a network that swallows what is sent.

Nobody is told of it: connections stay open, and what was sent is acknowledged by the system.
"""

import contextlib
import socket
import threading
from collections.abc import Iterator
from typing import Literal

Direction = Literal["both", "to the server", "to the client"]
DIRECTIONS: tuple[Direction, ...] = ("both", "to the server", "to the client")
PIECE = 65536  # [bytes]


class Forwarder:
    """Listens at a port of its own and forwards to another one."""

    def __init__(self, target: int) -> None:
        self._target = target
        self._flows = {"to the server": threading.Event(), "to the client": threading.Event()}
        self._open: set[socket.socket] = set()
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port = int(self._listener.getsockname()[1])
        self.let_through()
        threading.Thread(target=self._accept, daemon=True).start()

    @contextlib.contextmanager
    def blocked(self, direction: Direction) -> Iterator[None]:
        """Forward nothing in that direction for the length of the block; what was swallowed is forwarded afterwards."""
        for name, flows in self._flows.items():
            if direction in (name, "both"):
                flows.clear()
        try:
            yield
        finally:
            self.let_through()

    def let_through(self) -> None:
        """Forward again."""
        for flows in self._flows.values():
            flows.set()

    def close(self) -> None:
        """End every connection."""
        self.let_through()
        for each in (self._listener, *tuple(self._open)):
            _end(each)

    def _accept(self) -> None:
        with contextlib.suppress(OSError):  # the listener was closed
            while True:
                client, _ = self._listener.accept()
                try:
                    server = socket.create_connection(("127.0.0.1", self._target))
                except OSError:
                    _end(client)
                    continue
                self._open |= {client, server}
                for name, source, sink in (("to the server", client, server), ("to the client", server, client)):
                    threading.Thread(target=self._forward, args=(name, source, sink), daemon=True).start()

    def _forward(self, direction: str, source: socket.socket, sink: socket.socket) -> None:
        with contextlib.suppress(OSError):
            while piece := source.recv(PIECE):
                self._flows[direction].wait()
                sink.sendall(piece)
        for each in (source, sink):
            self._open.discard(each)
            _end(each)


def _end(connection: socket.socket) -> None:
    with contextlib.suppress(OSError):
        connection.shutdown(socket.SHUT_RDWR)
    connection.close()
