"""What every kind of job does over HTTP, on both kinds of database: accepted once, followed, named, listed, ended."""

from typing import Any

import httpx
import pytest

from tests.api.conftest import TOKENS, Service
from tests.api.streams import read_events
from tests.api.tuning import REQUEST
from tests.servers.process import HANG_TIMEOUT, wait_until

BODIES: dict[str, dict[str, Any]] = {
    "batches": {"strategies": ["passive"], "sweep": {"grid": {"road.seed": [801, 802]}}},
    "tunings": {**REQUEST, "limits": [], "trials": 3, "population": 3, "seeds": [1], "fresh_seeds": [11, 12]},
}
LONG: dict[str, dict[str, Any]] = {
    "batches": {**BODIES["batches"], "sweep": {"grid": {"road.seed": list(range(5000))}}},
    "tunings": {**BODIES["tunings"], "trials": 4000, "objectives": [{"kind": "paper"}]},
}


@pytest.fixture(scope="module", params=["service", "with_tokens"])
def client(request: pytest.FixtureRequest) -> Any:
    """Of a service on SQLite, and of one on PostgreSQL that wants tokens."""
    service: Service = request.getfixturevalue(request.param)
    token = next(iter(TOKENS.values()))
    headers = {"Authorization": f"Bearer {token}"} if request.param == "with_tokens" else {}
    with httpx.Client(base_url=service.base_url, headers=headers, timeout=HANG_TIMEOUT) as client:
        yield client


@pytest.fixture(params=list(BODIES))
def kind(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def submit(client: httpx.Client, kind: str, body: dict[str, Any], **headers: str) -> str:
    """Submit a job; return its address."""
    answer = client.post(f"/api/v1/{kind}", json=body, headers=headers)
    assert answer.status_code == 202, answer.text
    assert (answer.json()["state"], answer.json()["estimated_cost"]) == ("planning", None)
    address = answer.headers["location"]
    assert address == f"/api/v1/{kind}/{answer.json()['id']}"
    return str(address)


def ended(client: httpx.Client, address: str) -> Any:
    client.get(f"{address}/events").raise_for_status()  # a stream that ends with it
    return client.get(address).json()


def test_a_job_is_planned_run_and_followed_by_its_events(client: httpx.Client, kind: str) -> None:
    address = submit(client, kind, BODIES[kind])
    job = ended(client, address)
    assert (job["state"], job["reason"], job["problem"]) == ("done", None, None)
    assert job["estimated_cost"] > 0
    assert job["created_at"] <= job["started_at"] <= job["finished_at"]
    heard = read_events(client, f"{address}/events")
    assert [event["id"] for event in heard] == list(range(1, len(heard) + 1))
    states = [event["state"] for event in heard if event["event"] == "state"]
    assert list(dict.fromkeys(states)) == ["planning", "queued", "running", "done"]
    done = [event["done"] for event in heard]
    assert done == sorted(done)
    for since in ({"headers": {"Last-Event-ID": "2"}}, {"params": {"after": 2}}):
        assert read_events(client, f"{address}/events", **since) == heard[2:]


def test_an_idempotency_key_again_is_the_same_job_and_with_another_body_a_conflict(
    client: httpx.Client, kind: str
) -> None:
    key = {"Idempotency-Key": f"once-{kind}"}
    answers = [client.post(f"/api/v1/{kind}", json=LONG[kind], headers=key) for _ in range(2)]
    assert {answer.status_code for answer in answers} == {202}
    assert len({answer.json()["id"] for answer in answers}) == 1
    other = client.post(f"/api/v1/{kind}", json={**BODIES[kind], "scenario": {"road": {"seed": 5}}}, headers=key)
    assert (other.status_code, other.json()["type"].rpartition(":")[2]) == (409, "idempotency-key-reused")
    address = answers[0].headers["location"]
    client.post(f"{address}/cancel").raise_for_status()
    anew = submit(client, kind, LONG[kind], **key)
    assert anew != address, "a cancelled one gives its key away"
    client.post(f"{anew}/cancel").raise_for_status()


def test_a_job_is_cancelled_once_and_goes_on_when_it_is_resumed(client: httpx.Client, kind: str) -> None:
    address = submit(client, kind, LONG[kind])
    wait_until(lambda: client.get(address).json()["state"] == "running", "it runs")
    assert client.delete(address).json()["type"].endswith(":not-deletable")
    cancelled = client.post(f"{address}/cancel").json()
    assert cancelled["state"] == "cancelled"
    assert client.post(f"{address}/cancel").json() == cancelled
    assert read_events(client, f"{address}/events")[-1]["state"] == "cancelled"
    assert client.post(f"{address}/resume").json()["state"] in ("queued", "running")
    client.post(f"{address}/cancel").raise_for_status()
    assert client.delete(address).status_code == 204
    assert client.get(address).status_code == client.delete(address).status_code == 404


def test_jobs_are_named_and_listed_page_by_page(client: httpx.Client, kind: str) -> None:
    path, label = f"/api/v1/{kind}", f"winter {kind}"
    addresses = [submit(client, kind, {**BODIES[kind], "label": label}) for _ in range(3)]
    jobs = [ended(client, address) for address in addresses]
    assert {job["label"] for job in jobs} == {label}
    found, query = list[str](), {"limit": "2", "label": label, "state": "done"}
    while "cursor" not in query or query["cursor"]:
        page = client.get(path, params=query).json()
        assert len(page[kind]) <= 2
        found += [job["id"] for job in page[kind]]
        query["cursor"] = page["next"]
    assert found == [job["id"] for job in reversed(jobs)]
    assert client.patch(addresses[0], json={"label": "summer"}).json()["label"] == "summer"
    assert client.patch(addresses[0], json={"label": None}).json()["label"] is None
    assert client.patch(addresses[0], json={"label": ""}).json()["errors"][0]["pointer"] == "/label"
    assert client.post(f"{addresses[0]}/resume").json()["type"].endswith(":done")
