"""The reverse proxy with its real configuration: what it lets through, for how long, and what it does when one dies."""

import contextlib
import re
import select
import socket
import ssl
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from backend.http.problems import Problem
from backend.settings import MAX_BODY_BYTES
from sim_core.tables.text import MAX_BYTES
from tests.cluster.replica import Replica
from tests.servers.haproxy import Proxy
from tests.servers.process import HANG_TIMEOUT, request, wait_until
from tests.servers.programs import make_secrets

LONGEST, LONGEST_ROAD = MAX_BODY_BYTES, MAX_BYTES
REQUEST_TIMEOUT = 2.0  # what the hasty proxy gives a request to arrive; ten seconds in production [s]


@pytest.fixture(scope="module")
def replicas() -> Iterator[list[Replica]]:
    servers = [Replica("one"), Replica("two")]
    yield servers
    for server in servers:
        server.shutdown()
        server.server_close()


@pytest.fixture(scope="module")
def certificate(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A certificate as the script creates it for docker-compose.yml: for localhost, self-signed, with its key."""
    return next(path for path in make_secrets(tmp_path_factory.mktemp("certificate")) if path.name == "proxy.pem")


@pytest.fixture(scope="module")
def proxy(replicas: list[Replica], certificate: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Proxy]:
    """One that waits for a request as long as a busy machine needs."""
    limits = {"PROXY_REQUEST_TIMEOUT": f"{HANG_TIMEOUT:.0f}s", "PROXY_CLIENT_CONNECTIONS": "50"}
    yield from started(replicas, tmp_path_factory.mktemp("proxy"), PROXY_CERTIFICATE=str(certificate), **limits)


@pytest.fixture(scope="module")
def hasty(replicas: list[Replica], certificate: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Proxy]:
    """One that does not wait long."""
    limits = {"PROXY_REQUEST_TIMEOUT": f"{REQUEST_TIMEOUT:.0f}s"}
    yield from started(replicas, tmp_path_factory.mktemp("hasty"), PROXY_CERTIFICATE=str(certificate), **limits)


def started(replicas: list[Replica], folder: Path, **environment: str) -> Iterator[Proxy]:
    with Proxy(folder, [replica.address for replica in replicas], **environment) as proxy:
        wait_until(lambda: proxy.answers("/"), "a replica is found ready")
        yield proxy


@pytest.fixture
def client(proxy: Proxy, replicas: list[Replica]) -> Iterator[httpx.Client]:
    for replica in replicas:
        replica.ready, replica.breaks = True, False
    with httpx.Client(base_url=proxy.url, timeout=HANG_TIMEOUT) as client:
        wait_until(lambda: who_serves(client) == {"one", "two"}, "both replicas are in use")
        yield client


def who_serves(client: httpx.Client) -> set[str]:
    """The replicas that answered a few requests; empty where none did."""
    answers = [client.get("/", headers={"Connection": "close"}) for _ in range(6)]
    return {answer.json().get("by", "") for answer in answers if answer.status_code == 200}


def assert_problem(response: httpx.Response, status: int) -> None:
    assert response.status_code == status
    assert response.headers["Content-Type"] == "application/problem+json"
    content = Problem.model_validate(response.json())
    assert content.status == status
    assert content.request_id == response.headers["X-Request-ID"] != ""
    assert response.headers["X-Content-Type-Options"] == "nosniff"
    assert "default-src 'none'" in response.headers["Content-Security-Policy"]


def raw(proxy: Proxy, sent: bytes, drop: bytes = b"") -> bytes:
    """Send these bytes, then again and again that drop until an answer comes; all of it until the proxy hangs up."""
    answer = b""
    with socket.create_connection(("127.0.0.1", proxy.port), timeout=HANG_TIMEOUT) as connection:
        connection.sendall(sent)
        while drop and not select.select([connection], [], [], 0.1)[0]:
            connection.sendall(drop)
        while received := connection.recv(65536):
            answer += received
    return answer


@pytest.mark.parametrize(
    ("begin", "drop"),
    [
        (b"GET / HTTP/1.1\r\nHost: x\r\n", b"X: y\r\n"),
        (b"POST /api/v1/runs HTTP/1.1\r\nHost: x\r\nContent-Length: 100000\r\n\r\n", b" " * 100),
    ],
)
def test_what_drips_is_answered_408_and_no_replica_hears_of_it(
    hasty: Proxy, replicas: list[Replica], begin: bytes, drop: bytes
) -> None:
    before = sum(replica.asked for replica in replicas)
    assert raw(hasty, begin, drop).startswith(b"HTTP/1.1 408 ")
    assert sum(replica.asked for replica in replicas) == before


@pytest.mark.parametrize(
    ("longest", "path", "others"),
    [
        (LONGEST, "/api/v1/runs", ()),
        # A road's file may be longer.
        (LONGEST_ROAD, "/api/v1/roads", ("/api/v1/runs?/api/v1/roads", "/api/v1/roads/x", "//api/v1/roads")),
    ],
)
def test_the_longest_body_passes_and_a_longer_one_is_refused(
    client: httpx.Client, replicas: list[Replica], longest: int, path: str, others: tuple[str, ...]
) -> None:
    assert client.post(path, content=b" " * longest).json()["body"] == longest
    before = sum(replica.asked for replica in replicas)
    refused = client.post(path, content=b" " * (longest + 1))
    assert_problem(refused, 413)
    assert str(longest) in refused.json()["detail"]
    for other in others:
        assert_problem(client.post(other, content=b" " * (LONGEST + 1)), 413)
    assert_problem(client.post("/api/v1/runs", content=iter([b" " * 65536] * 32)), 413)  # in pieces
    assert sum(replica.asked for replica in replicas) == before


def test_one_address_may_not_hold_every_connection(proxy: Proxy, client: httpx.Client) -> None:
    with contextlib.ExitStack() as stack:
        address = ("127.0.0.1", proxy.port)
        connections = [stack.enter_context(socket.create_connection(address)) for _ in range(70)]

        def closed() -> int:
            return len(select.select(connections, [], [], 0)[0])

        wait_until(lambda: closed() >= 15, "those beyond fifty are closed")
        assert closed() < 50
    wait_until(lambda: proxy.answers("/"), "its own connections are free again")


def test_who_asks_is_what_the_proxy_sees(client: httpx.Client) -> None:
    names = ("X-Forwarded-For", "X-Forwarded-Proto", "X-Forwarded-Host", "Forwarded", "X-Real-IP")
    heard = client.get("/", headers=dict.fromkeys(names, "1.2.3.4")).json()["headers"]
    forwarded = {name: value for name, value in heard.items() if "forwarded" in name or name == "x-real-ip"}
    assert forwarded == {"x-forwarded-for": "127.0.0.1", "x-forwarded-proto": "http"}


def test_metrics_are_for_inside_however_they_are_spelt(proxy: Proxy, client: httpx.Client) -> None:
    assert_problem(client.get("/metrics"), 403)
    for target in ("/metrics/", "//metrics", "/%6detrics", "/METRICS", "/metrics?x=1", "http://x/metrics"):
        answer = raw(proxy, f"GET {target} HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n".encode())
        assert answer.startswith(b"HTTP/1.1 403 ")
    path = "/s/abc?x=%20metrics"
    assert client.get(path).json()["path"] == path, "others pass as they are"


def test_a_harmless_name_of_a_request_passes_and_another_one_is_replaced(client: httpx.Client) -> None:
    for name, passes in (("trace-1", True), ("x" * 65, False), ("a b", False)):
        heard = client.get("/", headers={"X-Request-ID": name}).json()["headers"]["x-request-id"]
        assert (heard == name) is passes
        assert re.fullmatch(r"[\w.-]{1,64}", heard)


def test_events_come_at_once_and_may_take_their_time(hasty: Proxy, replicas: list[Replica]) -> None:
    silence = {"X-Silence": str(1.5 * REQUEST_TIMEOUT)}
    url = f"{hasty.url}/api/v1/batches/x/events"
    with httpx.stream("GET", url, headers=silence, timeout=HANG_TIMEOUT) as response:
        lines = response.iter_lines()
        assert next(lines) == "data: first", "before the second is even sent"
        for replica in replicas:
            replica.proceed.set()
        assert "data: second" in list(lines)


@pytest.mark.parametrize(
    ("method", "path", "headers"),
    [("GET", "/x", {}), ("POST", "/api/v1/runs", {}), ("POST", "/api/v1/batches", {"Idempotency-Key": "k"})],
)
def test_a_request_its_replica_dropped_goes_to_another(
    client: httpx.Client, replicas: list[Replica], method: str, path: str, headers: dict[str, str]
) -> None:
    replicas[0].breaks = True
    before = replicas[0].asked
    answers = [client.request(method, path, headers={"Connection": "close", **headers}) for _ in range(4)]
    assert {answer.json()["by"] for answer in answers} == {"two"}
    assert replicas[0].asked > before, "it was tried"


def test_what_must_not_be_done_twice_is_not_sent_twice(client: httpx.Client, replicas: list[Replica]) -> None:
    for replica in replicas:
        replica.breaks = True
    before = sum(replica.asked for replica in replicas)
    assert_problem(client.post("/api/v1/batches", content=b"{}"), 502)
    assert sum(replica.asked for replica in replicas) == before + 1


def test_a_replica_that_is_not_ready_gets_nothing_and_without_any_it_says_when_to_come_again(
    client: httpx.Client, replicas: list[Replica]
) -> None:
    replicas[0].ready = False
    wait_until(lambda: who_serves(client) == {"two"}, "the other serves all")
    replicas[1].ready = False
    wait_until(lambda: client.get("/").status_code == 503, "both are found not ready")
    response = client.get("/")
    assert_problem(response, 503)
    assert int(response.headers["Retry-After"]) > 0


def test_with_a_certificate_it_speaks_tls(proxy: Proxy, client: httpx.Client, certificate: Path) -> None:
    context = ssl.create_default_context(cafile=str(certificate))
    response = httpx.get(f"https://127.0.0.1:{proxy.tls_port}", verify=context, timeout=HANG_TIMEOUT)
    assert response.json()["headers"]["x-forwarded-proto"] == "https"
    assert "max-age" in response.headers["Strict-Transport-Security"]
    old = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    old.load_verify_locations(certificate)
    old.set_ciphers("DEFAULT@SECLEVEL=0")
    with pytest.warns(DeprecationWarning, match="TLSv1_1"):
        old.maximum_version = ssl.TLSVersion.TLSv1_1
    with pytest.raises(httpx.ConnectError):
        httpx.get(f"https://127.0.0.1:{proxy.tls_port}", verify=old, timeout=HANG_TIMEOUT)


def test_plain_http_is_sent_on_to_https_where_that_is_named(tmp_path: Path, certificate: Path) -> None:
    there = "https://lab.example.com:8443"
    with Proxy(tmp_path, ["127.0.0.1:9"], PROXY_CERTIFICATE=str(certificate), PROXY_REDIRECT=there) as proxy:
        answer = request("POST", f"{proxy.url}/api/v1/runs?x=1")
        assert (answer.status_code, answer.headers["location"]) == (308, f"{there}/api/v1/runs?x=1")
        secure = f"https://127.0.0.1:{proxy.tls_port}/"
        context = ssl.create_default_context(cafile=str(certificate))
        assert httpx.get(secure, verify=context, timeout=HANG_TIMEOUT).status_code == 503
