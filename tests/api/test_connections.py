"""Connections that clients keep open, with a real server: which are closed, which served, and what a refusal says."""

import contextlib
import socket
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import pytest
import uvicorn

from backend.http.connections import HEALTH_CONNECTIONS
from tests.api.test_hostile_connections import BODY, JSON, Address, check_problem, head, impatient, rest
from tests.servers.process import wait_until

HEALTH = b"GET /healthz HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n"
SCHEMA = HEALTH.replace(b"/healthz", b"/api/v1/schema")
HALF = b"POST /api/v1/runs HTTP/1.1\r\nHost: x\r\n" + JSON + b"Content-Length: %d\r\n\r\n" % len(BODY)


@dataclass(frozen=True)
class Narrow:
    """A server with room for eight connections, four of one client."""

    address: Address
    server: uvicorn.Server

    def answering(self) -> int:
        """How many connections wait for an answer."""
        return sum(not connection.idle for connection in self.server.server_state.connections)


@pytest.fixture(scope="module")
def narrow(service: Any) -> Iterator[Narrow]:
    with impatient(service.app, max_connections=8, max_client_connections=4) as (address, server):
        yield Narrow(address, server)


@pytest.fixture
def held() -> Iterator[contextlib.ExitStack]:
    with contextlib.ExitStack() as stack:
        yield stack


def open_one(held: contextlib.ExitStack, narrow: Narrow, number: int, sent: bytes = b"") -> socket.socket:
    """A connection of the client with that number."""
    source = (f"127.0.0.{number}", 0)
    connection = held.enter_context(socket.create_connection(narrow.address, timeout=30, source_address=source))
    connection.sendall(sent)
    return connection


def test_idle_connections_of_one_client_keep_nobody_out(narrow: Narrow, held: contextlib.ExitStack) -> None:
    idle = [open_one(held, narrow, 2) for _ in range(20)]
    assert all(rest(connection) == b"" for connection in idle[:16]), "its oldest ones went for its newer ones"
    for number in range(3, 13):
        assert head(rest(open_one(held, narrow, number, SCHEMA)))[0] == 200
    idle[-1].sendall(SCHEMA)
    assert head(rest(idle[-1]))[0] == 200


def test_connections_in_use_are_served_on_and_others_may_ask_for_health(
    narrow: Narrow, held: contextlib.ExitStack
) -> None:
    used = [open_one(held, narrow, number, HALF) for number in (2, 3) for _ in range(4)]
    wait_until(lambda: narrow.answering() == 8, "the server waits for eight bodies", 10)
    for number in (2, 4):
        refused = rest(open_one(held, narrow, number, SCHEMA))
        assert check_problem(refused, 503)["type"].endswith(":connections")
        assert "retry-after" in head(refused)[1]
        for _ in range(HEALTH_CONNECTIONS + 2):
            open_one(held, narrow, number)
        assert head(rest(open_one(held, narrow, number, HEALTH)))[0] == 200
    used[0].sendall(BODY)
    assert used[0].recv(12) == b"HTTP/1.1 200"
