"""docker-compose.yml's topology as plain processes, over TLS: it works, and goes on when the part that leads is killed.

`make drill` kills every other part too, and all at once.
"""

import json
import socket
import ssl
from collections.abc import Iterator
from functools import partial
from typing import Any
from urllib.parse import quote

import httpx
import psutil
import pytest
from sqlalchemy import make_url

from tests.api.own_laws import LAW
from tests.servers.compose import Topology
from tests.servers.leader import leader
from tests.servers.postgres import Postgres
from tests.servers.process import HANG_TIMEOUT, Program, ask, request, wait_until

SHORT = {"length": 120, "bump": {"start": 90}}


@pytest.fixture(scope="module")
def topology(postgres: Postgres, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Topology]:
    law = tmp_path_factory.mktemp("laws") / "mine.py"
    law.write_text(LAW)
    folder = tmp_path_factory.mktemp("topology")
    topology = Topology(folder, postgres, API_WORKERS="1", WORKER_CORES="1", RIDELAB_CONTROLLERS=str(law))
    try:
        topology.wait_until_ready()
        wait_until(lambda: both_serve(topology), "both replicas serve")
        yield topology
        check_stored_and_logged(topology)
    finally:
        topology.end()
        postgres.start()


def check_stored_and_logged(topology: Topology) -> None:
    """Whatever was killed: every result was stored once, and nothing failed unforeseen."""
    (counts,) = topology.ask_database(
        "SELECT count(*), count(DISTINCT result_key), count(key) FROM job_runs LEFT JOIN results ON key = result_key"
    )
    assert len(set(counts)) == 1, counts
    for line in "\n".join(replica.log for replica in topology.replicas).splitlines():
        assert not line.startswith("Traceback")
        entry = json.loads(line) if line.startswith("{") else {}
        ours = str(entry.get("logger", "")).startswith("backend")
        assert not (ours and entry["level"] == "error"), entry
    password = str(make_url(topology.database).password)
    lines = [line for file in (topology.folder / "secrets").iterdir() for line in file.read_text().splitlines()]
    secrets = [password, quote(password, safe=""), *(line for line in lines if len(line) > 20 and "-----" not in line)]
    for program in topology.programs:
        assert not [secret for secret in secrets if secret in program.log], program.name


@pytest.fixture
def client(topology: Topology) -> Iterator[httpx.Client]:
    with httpx.Client(base_url=topology.url, timeout=HANG_TIMEOUT) as client:
        yield client


def submit(client: httpx.Client, first_height: float, runs: int) -> str:
    """A batch of lv runs that no other test has computed; its id."""
    heights = [round(first_height + 1e-5 * number, 6) for number in range(runs)]
    sweep = {"grid": {"road.bump.height": heights}}
    body = {"scenario": {"road": SHORT}, "strategies": ["lv"], "sweep": sweep}
    response = client.post("/api/v1/batches", json=body, headers={"Idempotency-Key": f"from-{first_height}"})
    assert response.status_code == 202, response.text
    return str(response.json()["id"])


def get(client: httpx.Client, path: str) -> Any:
    """An answer by the proxy, which may say 503 for a moment while a replica is away or slow."""
    return ask(str(client.base_url).rstrip("/"), "GET", path)


def batch(client: httpx.Client, identifier: str) -> Any:
    return get(client, f"/batches/{identifier}")


def done(client: httpx.Client, identifier: str) -> int:
    """How many of its runs are stored; while it runs the rows tell."""
    rows = get(client, f"/batches/{identifier}/results")["rows"]
    return sum(row["status"] == "ok" for row in rows)


def wait_until_begun(client: httpx.Client, identifier: str) -> int:
    """Wait until some runs are stored and others are not; returns how many are."""
    wait_until(lambda: done(client, identifier) > 0, "the batch begins")
    stored = done(client, identifier)
    assert batch(client, identifier)["state"] == "running", "the test needs a longer batch"
    return stored


def assert_completes(client: httpx.Client, identifier: str, runs: int) -> None:
    """Every run once, every result stored once."""
    wait_until(lambda: batch(client, identifier)["state"] not in ("planning", "queued", "running"), "the batch ends")
    end = batch(client, identifier)
    rows = client.get(f"/api/v1/batches/{identifier}/results").json()["rows"]
    assert (end["state"], end["done"], end["failed"]) == ("done", runs, 0), {row["reason"] for row in rows}
    assert [row["run"] for row in rows] == list(range(runs))
    assert {row["status"] for row in rows} == {"ok"}
    assert len({row["metrics"]["bump"]["body_acceleration"]["peak"] for row in rows}) > runs / 2, "results of their own"


def test_a_run_a_link_and_a_batch_go_through_the_proxy(topology: Topology, client: httpx.Client) -> None:
    run = client.post("/api/v1/runs", json={"scenario": {"road": SHORT}, "strategies": ["lv", "passive"]})
    assert run.status_code == 200
    link = client.post("/api/v1/links", json={"run_id": run.json()["id"], "view": {"baseline": "passive"}})
    assert link.status_code == 201
    for number in (0, 1):
        answer = request("GET", f"{topology.replica_url(number)}/api/v1/links/{link.json()['slug']}")
        assert answer.json()["run"]["id"] == run.json()["id"], "whichever replica is asked"
    identifier = submit(client, 0.05, 20)
    with client.stream("GET", f"/api/v1/batches/{identifier}/events") as events:
        last = [line for line in events.iter_lines() if line.startswith("data:")][-1]
    assert '"done"' in last
    assert_completes(client, identifier, 20)
    assert submit(client, 0.05, 20) == identifier, "the same key, whichever replica is asked"


@pytest.mark.thorough
def test_dasks_workers_drive_a_law_of_ones_own(client: httpx.Client) -> None:
    sweep = {"grid": {"own.mine.damping": [500, 1000, 1500, 2000]}}
    body = {"scenario": {"road": SHORT}, "strategies": ["mine"], "sweep": sweep}
    identifier = client.post("/api/v1/batches", json=body).raise_for_status().json()["id"]
    assert_completes(client, identifier, 4)


def test_what_dask_opens_is_for_who_has_a_certificate(topology: Topology) -> None:
    for program in (topology.scheduler, *topology.workers):
        wait_until(partial(listens, program), "it listens")
        listening = listening_of(program)
        assert {address.ip for address in listening} == {"127.0.0.1"}
        kinds = [kind_of_port(address.port) for address in listening]
        assert sorted(kinds) == ["health", "tls"]


def listens(program: Program) -> bool:
    return len(listening_of(program)) == 2


def listening_of(program: Program) -> list[Any]:
    """The addresses it listens on; none where it is dead."""
    try:
        return [c.laddr for c in psutil.Process(program.pid).net_connections() if c.status == psutil.CONN_LISTEN]
    except psutil.Error:
        return []


def kind_of_port(port: int) -> str:
    """`health` where HTTP answers health and nothing else; `tls` where a certificate is required."""
    try:
        answers = {
            path: request("GET", f"http://127.0.0.1:{port}{path}").status_code
            for path in ("/health", "/status", "/metrics", "/info/main/workers.html", "/json/counts.json")
        }
    except httpx.TransportError:
        context = ssl.create_default_context()
        context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
        with socket.create_connection(("127.0.0.1", port)) as connection:
            secure = context.wrap_socket(connection)  # in TLS 1.3 the server says what it thinks afterwards
            with secure, pytest.raises(ssl.SSLError, match="certificate required"):
                secure.recv(1)
        return "tls"
    assert answers.pop("/health") == 200
    assert set(answers.values()) == {404}
    return "health"


def test_a_batch_goes_on_when_the_replica_that_drives_is_killed(topology: Topology, client: httpx.Client) -> None:
    """That requests go to the other one is shown in tests/cluster/test_proxy.py."""
    wait_until(lambda: both_serve(topology), "both replicas serve")
    killed, identifier = leader(topology.database, topology.replicas), submit(client, 0.06, 300)
    stored = wait_until_begun(client, identifier)
    killed.kill(stays_dead=True)
    try:
        wait_until(lambda: done(client, identifier) > stored, "the batch goes on")
        assert leader(topology.database, topology.replicas) is not killed
        assert_completes(client, identifier, 300)
    finally:
        killed.revive()
    wait_until(lambda: both_serve(topology), "it is back")


def both_serve(topology: Topology) -> bool:
    try:
        return all(request("GET", f"{topology.replica_url(n)}/readyz").status_code == 200 for n in (0, 1))
    except httpx.TransportError:
        return False
