"""Clients that are slow, greedy or do not speak HTTP: each is answered or cut off, and the others are served on."""

import contextlib
import copy
import json
import select
import socket
import threading
import time
from collections.abc import Iterator
from dataclasses import replace
from typing import Any, cast

import httpx
import pytest
import uvicorn
from fastapi import FastAPI
from starlette.datastructures import State
from starlette.responses import Response

from backend.http import lingering
from backend.http.connections import HEALTH_CONNECTIONS
from backend.http.guard import HEADERS
from backend.http.server import GuardedProtocol, server_config
from tests.servers.process import HANG_TIMEOUT, request, wait_until

Address = tuple[str, int]
JSON = b"Content-Type: application/json\r\n"


@contextlib.contextmanager
def impatient(app: FastAPI, **limits: Any) -> Iterator[tuple[Address, uvicorn.Server]]:
    """The application behind a second server with other limits: the address, and the server."""
    settings = app.state.services.settings.model_copy(update=limits)
    same = copy.copy(app)
    same.state = State({"services": replace(app.state.services, settings=settings)})
    config = server_config(same, settings)
    config.lifespan = "off"
    with running(config) as served:
        yield served


@contextlib.contextmanager
def running(config: uvicorn.Config) -> Iterator[tuple[Address, uvicorn.Server]]:
    server = uvicorn.Server(config)
    with socket.create_server(("127.0.0.1", 0)) as listener:
        thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]})
        thread.start()
        try:
            yield listener.getsockname(), server
        finally:
            server.should_exit = True
            thread.join()


@pytest.fixture(scope="module")
def hasty(service: Any) -> Iterator[Address]:
    """Waits half a second where the others wait ten or twenty."""
    with impatient(service.app, head_timeout=0.5, body_timeout=0.5) as (address, _):
        yield address


def connect(address: Address) -> socket.socket:
    return socket.create_connection(address, timeout=HANG_TIMEOUT)


def rest(connection: socket.socket) -> bytes:
    """All that comes until the other side closes."""
    pieces = []
    with contextlib.suppress(ConnectionResetError):
        while piece := connection.recv(65536):
            pieces.append(piece)
    return b"".join(pieces)


def exchange(address: Address, sent: bytes) -> bytes:
    with connect(address) as connection:
        with contextlib.suppress(ConnectionError):  # answered and closed before all was sent
            connection.sendall(sent)
        return rest(connection)


def head(answer: bytes) -> tuple[int, dict[str, str]]:
    """Status and headers of the first answer."""
    first, *lines = answer.split(b"\r\n\r\n")[0].decode("latin-1").split("\r\n")
    return int(first.split()[1]), {
        name.lower(): value.strip() for name, _, value in (line.partition(":") for line in lines)
    }


def check_problem(answer: bytes, status: int) -> dict[str, Any]:
    """A problem with every security header, whoever answered it."""
    answered_status, headers = head(answer)
    assert answered_status == status, answer
    assert headers["content-type"] == "application/problem+json"
    assert {name.lower(): value for name, value in HEADERS.items()}.items() <= headers.items()
    content: dict[str, Any] = json.loads(answer.split(b"\r\n\r\n", 1)[1])
    assert content["status"] == status
    assert content["request_id"] == headers["x-request-id"]
    return content


POST = b"POST /api/v1/runs HTTP/1.1\r\nHost: x\r\n" + JSON


@pytest.mark.parametrize(
    ("begin", "drop", "kind"),
    [
        (b"GET /healthz HTTP/1.1\r\nHost: x\r\n", b"a", "slow-head"),
        (POST + b"Transfer-Encoding: chunked\r\n\r\n", b"1\r\n \r\n", "slow-body"),
        (POST + b"Content-Length: 100\r\n\r\n{", b"", "slow-body"),
    ],
)
def test_what_never_ends_is_cut_off_in_time(hasty: Address, begin: bytes, drop: bytes, kind: str) -> None:
    with connect(hasty) as connection:
        connection.sendall(begin)
        connection.settimeout(0.1)
        answer, end = b"", time.monotonic() + HANG_TIMEOUT
        while time.monotonic() < end:  # a byte now and then wins no time
            try:
                piece = connection.recv(65536)
            except TimeoutError:
                with contextlib.suppress(OSError):
                    connection.sendall(drop)
                continue
            except ConnectionResetError:  # by the byte that came after its answer
                break
            if not piece:
                break
            answer += piece
    assert check_problem(answer, 408)["type"].endswith(kind)


def test_a_silent_connection_is_closed_in_time(hasty: Address) -> None:
    assert exchange(hasty, b"") == b""


@contextlib.contextmanager
def generous(
    service: Any, monkeypatch: pytest.MonkeyPatch, patience: float
) -> Iterator[tuple[Address, uvicorn.Server]]:
    """Answers everything with 16 MB, and waits so long [s] for whoever takes nothing."""
    monkeypatch.setattr(GuardedProtocol, "WRITE_TIMEOUT", patience)
    config = server_config(Response(b"x" * 16_000_000), service.services.settings)  # type: ignore[arg-type]  # any ASGI
    config.lifespan = "off"
    with running(config) as started:
        yield started


def slow_reader(address: Address) -> socket.socket:
    connection = socket.socket()
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    connection.settimeout(HANG_TIMEOUT)
    connection.connect(address)
    connection.sendall(b"GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n")
    return connection


def test_a_download_lasts_as_long_as_it_moves(service: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    with generous(service, monkeypatch, 2.0) as (address, _), slow_reader(address) as connection:
        received, end = 0, time.monotonic() + 3  # longer than nothing may be taken
        while time.monotonic() < end:
            received += len(connection.recv(1000))
            time.sleep(0.02)
        assert received < 1_000_000
        assert received + len(rest(connection)) > 16_000_000


def test_who_takes_nothing_for_long_loses_the_rest(service: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    with generous(service, monkeypatch, 0.5) as (address, server), slow_reader(address) as connection:
        assert connection.recv(1) == b"H"
        wait_until(lambda: not server.server_state.connections, "it is cut off")
        assert len(rest(connection)) < 16_000_000


@pytest.fixture
def address(client: httpx.Client) -> Address:
    assert client.base_url.port is not None
    return client.base_url.host, client.base_url.port


BODY = b'{"strategies": ["passive"]}'


@pytest.mark.parametrize(
    "request_bytes",
    [
        b"\r\n\r\n\x00\x01\x02\r\n\r\n",
        b"GET /healthz HTTP/1.1\r\n\r\n",
        b"GET /healthz HTTP/1.1\r\nHost: x\r\nHost: y\r\n\r\n",
        b"GET /he\xffalthz HTTP/1.1\r\nHost: x\r\n\r\n",
        b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03",
        b"POST /api/v1/runs HTTP/1.1\r\nHost: x\r\nContent-Length: 5\r\nContent-Length: 6\r\n\r\n123456",
    ],
    ids=lambda value: str(value[:60]),
)
def test_what_is_not_http_is_a_problem_with_every_header(address: Address, request_bytes: bytes) -> None:
    answer = exchange(address, request_bytes)
    content = check_problem(answer, 400)
    assert "althz" not in json.dumps(content)
    assert answer.count(b"HTTP/1.1 ") == 1


@pytest.mark.parametrize("connection", ["close", "keep-alive"])
@pytest.mark.parametrize(("kind", "status"), [("application/json", 413), ("text/plain", 415)])
def test_a_long_body_that_is_refused_does_not_cost_its_answer(
    address: Address, connection: str, kind: str, status: int
) -> None:
    """The client reads only once it has sent all, as most do."""
    fields = f"Content-Type: {kind}\r\nContent-Length: 3000000\r\nConnection: {connection}\r\n\r\n"
    with connect(address) as client:
        client.sendall(b"POST /api/v1/runs HTTP/1.1\r\nHost: x\r\n" + fields.encode())
        select.select([client], [], [], 30)  # it was answered, and perhaps closed
        for _ in range(30):
            client.sendall(b" " * 100_000)
        client.shutdown(socket.SHUT_WR)
        check_problem(rest(client), status)


@pytest.mark.parametrize("connection", ["close", "keep-alive"])
def test_who_sends_on_and_on_after_an_answer_is_reset(
    address: Address, connection: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(lingering, "MAX_DROPPED", 1_000_000)
    fields = f"Content-Length: 3000000000\r\nConnection: {connection}\r\n\r\n"
    with connect(address) as client:
        client.sendall(POST + fields.encode())
        with pytest.raises(ConnectionError):
            send_on_and_on(client)


def send_on_and_on(connection: socket.socket) -> None:
    for _ in range(100_000):
        connection.sendall(b" " * 65536)


@pytest.mark.parametrize("size", [9_000, 1_000_000])
def test_a_head_that_is_too_long_is_refused(address: Address, size: int) -> None:
    """Or cut off before all of it was sent, when the answer may get lost."""
    filler = b"b" * size
    for sent, status in (
        (b"GET /healthz HTTP/1.1\r\nHost: x\r\nX: " + 2 * filler + b"\r\n\r\n", {431}),
        (b"GET /healthz HTTP/1.1\r\nHost: x\r\n" + b"X: y\r\n" * (size // 3) + b"\r\n", {431}),
        (b"GET /" + filler + b" HTTP/1.1\r\nHost: x\r\n\r\n", {414, 431}),
        (b"GET /healthz?" + filler + b" HTTP/1.1\r\nHost: x\r\n\r\n", {414, 431}),
    ):
        answer = exchange(address, sent)
        if answer or size < 10_000:
            assert head(answer)[0] in status
            assert b"b" * 33 not in answer  # a request's id has 32 characters, and may hold a few in a row
            check_problem(answer, head(answer)[0])


@pytest.mark.parametrize(
    "lengths",
    [
        b"Content-Length: 6\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\nG",
        b"Transfer-Encoding: chunked\r\nContent-Length: 4\r\n\r\n5c\r\nGPOST / HTTP/1.1\r\n\r\n0\r\n\r\n",
        b"Transfer-Encoding: xchunked\r\n\r\n0\r\n\r\n",
        b"Transfer-Encoding: chunked\r\n\r\nzz\r\n\r\n",
    ],
    ids=lambda value: str(value[:60]),
)
def test_a_body_whose_length_two_servers_could_read_differently_is_refused(address: Address, lengths: bytes) -> None:
    smuggled = b"GET /api/v1/strategies HTTP/1.1\r\nHost: x\r\n\r\n"
    answer = exchange(address, b"POST /api/v1/runs HTTP/1.1\r\nHost: x\r\n" + JSON + lengths + smuggled)
    status, headers = head(answer)
    assert status in (400, 501)
    assert headers["content-type"] == "application/problem+json"
    assert headers["content-security-policy"] == HEADERS["Content-Security-Policy"]
    assert answer.count(b"HTTP/1.1 ") == 1, "what followed was taken for another request"


def test_no_answer_depends_on_the_host_or_repeats_it(address: Address) -> None:
    for host in ("evil.example", "127.0.0.1:99999", '"><script>evil'):
        for path in ("/", "/api/v1/runs/", "/api/v1/schema/", "/docs", "/nowhere"):
            sent = f"GET {path} HTTP/1.1\r\nHost: {host}\r\nX-Forwarded-Host: {host}\r\nConnection: close\r\n\r\n"
            answer = exchange(address, sent.encode())
            status, headers = head(answer)
            assert status in (200, 404, 405)
            assert "location" not in headers
            assert b"evil" not in answer


def test_a_forwarded_address_counts_only_from_a_known_proxy(service: Any) -> None:
    answers: list[str] = []
    original = service.services.gate.computing

    def spy(client: str, *rest: Any) -> Any:
        answers.append(client)
        return original(client, *rest)

    def ask(address: Address, seed: int) -> None:
        response = request(
            "POST",
            f"http://127.0.0.1:{address[1]}/api/v1/live",
            json={"strategies": ["passive"], "scenario": {"road": {"length": 138.3, "seed": seed}}},
            headers={"X-Forwarded-For": "203.0.113.7"},
        )
        assert response.status_code in (200, 500), response.text

    service.services.gate.computing = spy
    try:
        for index, proxies in enumerate(("", "10.0.0.0/8", "127.0.0.1")):
            with impatient(service.app, forwarded_allow_ips=proxies) as (address, _):
                ask(address, index)
    finally:
        service.services.gate.computing = original
    assert answers == ["127.0.0.1", "127.0.0.1", "203.0.113.7"]


def test_connections_in_use_are_served_on_and_others_may_ask_for_health(service: Any) -> None:
    """A server with room for eight, four of one client; each address of 127.0.0.0/8 is one."""
    health = b"GET /healthz HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n"
    schema = health.replace(b"/healthz", b"/api/v1/schema")
    limits = {
        "max_connections": 8,
        "max_client_connections": 4,
        "head_timeout": HANG_TIMEOUT,
        "body_timeout": HANG_TIMEOUT,
    }
    with (
        impatient(service.app, **limits) as (address, server),
        contextlib.ExitStack() as held,
    ):

        def open_one(number: int, sent: bytes = b"") -> socket.socket:
            source = (f"127.0.0.{number}", 0)
            connection = held.enter_context(
                socket.create_connection(address, timeout=HANG_TIMEOUT, source_address=source)
            )
            connection.sendall(sent)
            return connection

        idle = [open_one(2) for _ in range(20)]
        assert all(rest(connection) == b"" for connection in idle[:16]), "its oldest ones went for its newer ones"
        begun = POST + b"Content-Length: %d\r\n\r\n" % len(BODY)
        used = [open_one(number, begun) for number in (2, 3) for _ in range(4)]
        connections = cast("set[GuardedProtocol]", server.server_state.connections)
        wait_until(lambda: sum(not each.idle for each in connections) == 8, "the server waits for eight bodies")
        for number, status in ((2, 429), (4, 503)):
            refused = rest(open_one(number, schema))
            assert check_problem(refused, status)["type"].endswith(":connections")
            assert "retry-after" in head(refused)[1]
            for _ in range(HEALTH_CONNECTIONS + 2):
                open_one(number)
            assert head(rest(open_one(number, health)))[0] == 200
        used[0].sendall(BODY)
        assert used[0].recv(12) == b"HTTP/1.1 200"
