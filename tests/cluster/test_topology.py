"""docker-compose.yml's topology as plain processes, over TLS: what needs no engine; the rest is in tests/compose."""

import json
from collections.abc import Iterator
from urllib.parse import quote

import httpx
import pytest
from sqlalchemy import make_url

from tests.api.own_laws import LAW
from tests.servers.accepted import Accepted
from tests.servers.compose import Topology
from tests.servers.postgres import Postgres
from tests.servers.process import ask, request, wait_until

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
        check_logs(topology)
    finally:
        topology.end()
        postgres.start()


def check_logs(topology: Topology) -> None:
    """Check that nothing failed unforeseen, and that no log has a secret."""
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


def test_a_run_a_link_and_a_batch_go_through_the_proxy(topology: Topology) -> None:
    body = {"scenario": {"road": SHORT}, "strategies": ["lv", "passive"]}
    run = ask(topology.url, "POST", "/runs", json=body)["id"]
    slug = ask(topology.url, "POST", "/links", json={"run_id": run, "view": {"baseline": "passive"}})["slug"]
    for number in (0, 1):
        assert ask(topology.replica_url(number), "GET", f"/links/{slug}")["run"]["id"] == run, "whichever is asked"
    accepted = Accepted(topology.url, topology.database, seed=2, runs=20, strategies=("mine", "passive"))
    batch = accepted.submit()
    events = request("GET", f"{topology.url}/api/v1/batches/{batch}/events")  # a stream that ends with it
    assert '"done"' in [line for line in events.text.splitlines() if line.startswith("data:")][-1]
    accepted.finish()


def both_serve(topology: Topology) -> bool:
    try:
        return all(request("GET", f"{topology.replica_url(n)}/readyz").status_code == 200 for n in (0, 1))
    except httpx.TransportError:
        return False
