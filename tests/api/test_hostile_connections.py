"""Clients that are slow, greedy or do not speak HTTP: each is answered or cut off, and the others are served on."""

import contextlib
import json
import select
import socket
import sys
from pathlib import Path
from typing import Any

import httpx
import pytest
from fastapi import FastAPI, Request

from backend.http import middleware
from backend.http.middleware import HEADERS
from backend.http.server import server_config
from backend.settings import Settings
from tests.servers.loops import ask
from tests.servers.process import HANG_TIMEOUT, Api, request
from tests.there import there

Address = tuple[str, int]
POST = b"POST /api/v1/runs HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"


@pytest.fixture
def address(client: httpx.Client) -> Address:
    assert client.base_url.port is not None
    return client.base_url.host, client.base_url.port


def connect(address: Address) -> socket.socket:
    return socket.create_connection(address, timeout=HANG_TIMEOUT)


def rest(connection: socket.socket) -> bytes:
    """Return all that comes until the other side closes."""
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
    """Return status and headers of the first answer."""
    first, *lines = answer.split(b"\r\n\r\n")[0].decode("latin-1").split("\r\n")
    return int(first.split()[1]), {
        name.lower(): value.strip() for name, _, value in (line.partition(":") for line in lines)
    }


def check_problem(answer: bytes, status: int) -> dict[str, Any]:
    """Check that an answer is a problem with every security header."""
    answered_status, headers = head(answer)
    assert answered_status == status, answer
    assert headers["content-type"] == "application/problem+json"
    assert {name.lower(): value for name, value in HEADERS.items()}.items() <= headers.items()
    content: dict[str, Any] = json.loads(answer.split(b"\r\n\r\n", 1)[1])
    assert content["status"] == status
    assert content["request_id"] == headers["x-request-id"]
    return content


@pytest.mark.parametrize(
    "begin",
    [b"Transfer-Encoding: chunked\r\n\r\n1\r\n \r\n", b"Content-Length: 100\r\n\r\n{"],
    ids=["chunked", "sized"],
)
def test_a_body_that_comes_too_slowly_is_ended(address: Address, begin: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(middleware, "GRACE", 0.2)
    assert check_problem(exchange(address, POST + begin), 408)["type"].endswith("slow-body")


def test_a_body_may_take_longer_where_it_keeps_coming(address: Address, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each byte wins more time here than the next one takes."""
    monkeypatch.setattr(middleware, "GRACE", 0.5)
    monkeypatch.setattr(middleware, "LEAST_RATE", 1.0)
    body = b'{"strategies": ["passive"]}'
    with connect(address) as connection:
        connection.sendall(POST + b"Content-Length: %d\r\nConnection: close\r\n\r\n" % len(body))
        for number in range(5):
            connection.sendall(body[number : number + 1])
            select.select([connection], [], [], 0.2)
        connection.sendall(body[5:])
        assert head(rest(connection))[0] == 200


@pytest.mark.parametrize("connection", ["close", "keep-alive"])
@pytest.mark.parametrize(("kind", "status"), [("application/json", 413), ("text/plain", 415)])
def test_a_long_body_that_is_refused_does_not_cost_its_answer(
    address: Address, connection: str, kind: str, status: int
) -> None:
    """The client reads only once it has sent all, as most do."""
    fields = f"Content-Type: {kind}\r\nContent-Length: 3000000\r\nConnection: {connection}\r\n\r\n"
    with connect(address) as client:
        client.sendall(b"POST /api/v1/runs HTTP/1.1\r\nHost: x\r\n" + fields.encode() + b" " * 3_000_000)
        client.shutdown(socket.SHUT_WR)
        check_problem(rest(client), status)


def test_who_sends_on_and_on_after_a_refusal_is_cut_off(address: Address, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(middleware, "MOST_DROPPED", 1_000_000)
    with connect(address) as client:
        client.sendall(POST + b"Content-Length: 3000000000\r\n\r\n")
        with pytest.raises(ConnectionError):
            send_on_and_on(client)


def send_on_and_on(connection: socket.socket) -> None:
    for _ in range(100_000):
        connection.sendall(b" " * 65536)


@pytest.mark.parametrize(
    "sent",
    [
        b"\r\n\r\n\x00\x01\x02\r\n\r\n",
        b"GET /healthz HTTP/1.1\r\n\r\n",
        b"GET /healthz HTTP/1.1\r\nHost: x\r\nHost: y\r\n\r\n",
        b"GET /he\xffalthz HTTP/1.1\r\nHost: x\r\n\r\n",
        b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03",
        b"GET /healthz HTTP/1.1\r\nHost: x\r\nX: " + 100_000 * b"b",
        POST + b"Content-Length: 5\r\nContent-Length: 6\r\n\r\n123456GET /healthz HTTP/1.1\r\n\r\n",
        POST + b"Content-Length: 6\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\nGET /healthz HTTP/1.1\r\n\r\n",
        POST + b"Transfer-Encoding: chunked\r\nContent-Length: 4\r\n\r\n5c\r\nGPOST / HTTP/1.1\r\n\r\n0\r\n\r\n",
        POST + b"Transfer-Encoding: xchunked\r\n\r\n0\r\n\r\nGET /healthz HTTP/1.1\r\n\r\n",
        POST + b"Transfer-Encoding: chunked\r\n\r\nzz\r\n\r\nGET /healthz HTTP/1.1\r\n\r\n",
    ],
    ids=lambda value: str(value[:60]),
)
def test_what_two_servers_could_read_differently_is_refused_once_and_not_repeated(
    address: Address, sent: bytes
) -> None:
    answer = exchange(address, sent)
    assert head(answer)[0] in (400, 431, 501)
    assert answer.count(b"HTTP/1.1 ") == 1, "what followed was taken for another request"
    assert b"althz" not in answer
    assert b"b" * 33 not in answer  # a request's id has 32 characters, and may hold a few in a row


@pytest.mark.parametrize(
    ("sent", "status"),
    [
        (b"GET /healthz HTTP/1.1\r\nHost: x\r\nX: " + 18_000 * b"b" + b"\r\n\r\n", 431),
        (b"GET /healthz HTTP/1.1\r\nHost: x\r\n" + b"X: y\r\n" * 3_000 + b"\r\n", 431),
        (b"GET /" + 9_000 * b"b" + b" HTTP/1.1\r\nHost: x\r\n\r\n", 414),
        (b"GET /healthz?" + 9_000 * b"b" + b" HTTP/1.1\r\nHost: x\r\n\r\n", 414),
    ],
    ids=["header", "headers", "path", "query"],
)
def test_a_head_that_is_too_long_is_a_problem(address: Address, sent: bytes, status: int) -> None:
    answer = exchange(address, sent)
    assert b"b" * 33 not in answer
    check_problem(answer, status)


def test_no_answer_depends_on_the_host_or_repeats_it(address: Address) -> None:
    for host in ("evil.example", "127.0.0.1:99999", '"><script>evil'):
        for path in ("/", "/api/v1/runs/", "/api/v1/schema/", "/docs", "/nowhere"):
            sent = f"GET {path} HTTP/1.1\r\nHost: {host}\r\nX-Forwarded-Host: {host}\r\nConnection: close\r\n\r\n"
            answer = exchange(address, sent.encode())
            status, headers = head(answer)
            assert status in (200, 404, 405)
            assert "location" not in headers
            assert b"evil" not in answer


@pytest.mark.parametrize(
    ("proxies", "client"), [("", "127.0.0.1"), ("10.0.0.0/8", "127.0.0.1"), ("127.0.0.1", "203.0.113.7")]
)
def test_a_forwarded_address_counts_only_from_a_known_proxy(proxies: str, client: str) -> None:
    app = FastAPI()

    @app.get("/")
    def host(request: Request) -> str:
        return there(request.client).host

    config = server_config(app, Settings(forwarded_allow_ips=proxies))
    config.load()
    assert ask(config.loaded_app, "GET", "/", headers={"X-Forwarded-For": "203.0.113.7"}).json() == client


class Limited(Api):
    """A service that is allowed few open files at first."""

    PROGRAM = (
        "-c",
        "import os, resource, sys; resource.setrlimit(resource.RLIMIT_NOFILE, (128, 4096)); "
        f"os.execv({sys.executable!r}, [{sys.executable!r}, '-m', 'backend', *sys.argv[1:]])",
    )


def test_a_service_as_it_starts_answers_this_machines_names_beside_many_idle_connections(tmp_path: Path) -> None:
    with Limited(tmp_path) as api, contextlib.ExitStack() as held:
        api.wait_until_ready()
        idle = [held.enter_context(connect(("127.0.0.1", api.port))) for _ in range(800)]
        for host, status in (("localhost", 200), (f"127.0.0.1:{api.port}", 200), ("[::1]", 200), ("evil.example", 421)):
            assert request("GET", f"{api.url}/api/v1/login", headers={"Host": host}).status_code == status
        idle[0].sendall(b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n")
        assert idle[0].recv(12) == b"HTTP/1.1 200"
        same_machine = {"Origin": "http://localhost:3000", "Host": f"localhost:{api.port}"}
        body = {"strategies": ["passive"]}
        assert request("POST", f"{api.url}/api/v1/runs", json=body, headers=same_machine).status_code == 403
