"""Links, roads and recordings are listed and taken back: with tokens by their owner, without by who is alone."""

import itertools
from collections.abc import Callable
from pathlib import Path
from typing import Any

import httpx
import pytest
from fastapi import FastAPI
from sqlalchemy import func, select, update

from backend.app import create_app
from backend.db.tables import links, pinned_series, recording_owners, road_owners
from backend.settings import Settings
from backend.store import Store
from tests.api.conftest import Service
from tests.api.test_problems import check
from tests.servers import batches
from tests.servers.loops import ask

CSV = {"Content-Type": "text/csv"}
NUMBERS = itertools.count(1)
RUN = {"scenario": {"road": {"length": 40, "bump": {"start": 20}}}, "strategies": ["passive"]}


def make_link(client: httpx.Client) -> str:
    run = client.post("/api/v1/runs", json=RUN).raise_for_status().json()["id"]
    return str(client.post("/api/v1/links", json={"run_id": run}).raise_for_status().json()["slug"])


def make_road(client: httpx.Client) -> str:
    return send(client, "roads", road(next(NUMBERS)))


def road(number: int) -> str:
    return "distance [m],height [mm]\n" + "".join(f"{x},{(x * number) % 7}\n" for x in range(100))


def make_recording(client: httpx.Client) -> str:
    number = next(NUMBERS)
    rows = "".join(f"{step / 100},{(step * number) % 97}\n" for step in range(50))
    return send(client, "recordings", f"time [s],body_acceleration [m/s^2]\n{rows}")


def send(client: httpx.Client, kind: str, content: str) -> str:
    return str(client.post(f"/api/v1/{kind}", content=content, headers=CSV).raise_for_status().json()["id"])


KINDS: dict[str, Callable[[httpx.Client], str]] = {
    "links": make_link,
    "roads": make_road,
    "recordings": make_recording,
}


def listed(client: httpx.Client, kind: str, limit: int = 2) -> list[str]:
    """Every key of a list, read page by page."""
    keys, cursor = list[str](), None
    while True:
        parameters = {"limit": limit} | ({"cursor": cursor} if cursor else {})
        page = client.get(f"/api/v1/{kind}", params=parameters).raise_for_status().json()
        assert len(page[kind]) <= limit
        keys += [each.get("slug") or each["id"] for each in page[kind]]
        if (cursor := page["next"]) is None:
            return keys


@pytest.mark.parametrize("kind", KINDS)
def test_with_tokens_the_owner_alone_lists_and_takes_back(
    guarded: tuple[httpx.Client, httpx.Client], with_tokens: Service, kind: str
) -> None:
    ann, ben = guarded
    before = listed(ann, kind)
    made = [KINDS[kind](ann) for _ in range(3)]
    assert listed(ann, kind) == [*reversed(made), *before], "the newest first"
    assert not set(made) & set(listed(ben, kind))
    check(ben.delete(f"/api/v1/{kind}/{made[0]}"), 403, "other-token")
    assert ben.get(f"/api/v1/{kind}/{made[0]}").status_code == 200, "who knows it reads it"
    assert ann.delete(f"/api/v1/{kind}/{made[0]}").status_code == 204
    check(ann.get(f"/api/v1/{kind}/{made[0]}"), *((410, "revoked") if kind == "links" else (404, "not-found")))
    check(ann.delete(f"/api/v1/{kind}/{'n' * 22}"), 404, "not-found")
    with with_tokens.services.store.writing() as connection:  # as of before there was a file of tokens
        connection.execute(update(links).values(owner=None))
        connection.execute(road_owners.delete())
        connection.execute(recording_owners.delete())
    for client in guarded:
        assert listed(client, kind) == []
        check(client.delete(f"/api/v1/{kind}/{made[1]}"), 403, "other-token")


@pytest.mark.parametrize("kind", ["roads", "recordings"])
def test_what_two_have_sent_goes_with_the_last_of_them(
    guarded: tuple[httpx.Client, httpx.Client], kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tests.api.test_lists.NUMBERS", itertools.repeat(96))
    made = {KINDS[kind](client) for client in guarded}
    assert len(made) == 1, "equal content has one id"
    (key,) = made
    for client, left in zip(guarded, (200, 404), strict=True):
        assert key in listed(client, kind)
        assert client.delete(f"/api/v1/{kind}/{key}").status_code == 204
        assert key not in listed(client, kind)
        assert client.get(f"/api/v1/{kind}/{key}").status_code == left


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> FastAPI:
    """A service without tokens, which was not started: lists need no workers."""
    app = create_app(Settings(data_dir=tmp_path_factory.mktemp("alone")))
    app.state.services.store.migrate()
    return app


HERE = ("127.0.0.1", "localhost"), ("::1", "[::1]:8000"), ("::ffff:127.0.0.1", "127.0.0.1:8000")
ELSEWHERE = ("192.0.2.7", "localhost"), ("2001:db8::1", "localhost"), ("127.0.0.1", "localhost.example.com")
FORWARDED = {"X-Forwarded-For": "127.0.0.1"}, {"X-Forwarded-Proto": "https"}, {"Forwarded": "for=127.0.0.1"}


@pytest.mark.parametrize("kind", KINDS)
def test_without_tokens_a_service_lists_and_takes_back_for_its_own_machine_alone(alone: FastAPI, kind: str) -> None:
    """Which asks it by its own name, and through no proxy."""

    def answers(peer: str, host: str, **more: str) -> list[httpx.Response]:
        addresses = ("GET", f"/api/v1/{kind}"), ("DELETE", f"/api/v1/{kind}/{'n' * 22}")
        return [ask(alone, *each, headers={"Host": host, **more}, peer=peer) for each in addresses]

    for peer, host in HERE:
        page, missing = answers(peer, host)
        assert page.json() == {kind: [], "next": None}
        check(missing, 404, "not-found")
    refused = [answers(*each) for each in ELSEWHERE] + [answers(*HERE[0], **each) for each in FORWARDED]
    for answer in itertools.chain(*refused):
        assert "RIDELAB_ONE_USER=yes" in check(answer, 403, "not-alone").detail


def test_who_says_that_one_person_uses_the_service_may_list_from_anywhere(tmp_path: Path) -> None:
    settings = Settings.from_environment({"RIDELAB_ONE_USER": "yes"}, data_dir=tmp_path)
    app = create_app(settings)
    app.state.services.store.migrate()
    headers = {"Host": "lab.example.com", "X-Forwarded-For": "192.0.2.7"}
    for kind in KINDS:
        assert ask(app, "GET", f"/api/v1/{kind}", headers=headers, peer="192.0.2.7").json()[kind] == []


def test_what_a_run_a_job_or_a_link_names_stays_and_says_how_many_do(service: Service) -> None:
    profile = make_road(service)
    scenario = {"road": {"profile": profile, "length": 40, "bump": {"start": 20}}}
    run = service.run(["passive"], scenario).raise_for_status().json()
    sweep = {"grid": {"road.bump.height": [0.02]}}
    body = {"scenario": scenario, "strategies": ["passive"], "sweep": sweep}
    batch = service.post("/api/v1/batches", json=body).raise_for_status().json()
    for target in ({"run_id": run["id"]}, {"batch_id": batch["id"]}):
        link = service.post("/api/v1/links", json=target).raise_for_status().json()
    refused = check(service.delete(f"/api/v1/roads/{profile}"), 409, "in-use")
    assert refused.detail == "This measured road stays: 1 run, 1 job and 2 links name it."
    batches.wait_for(service, batch["id"])
    assert service.delete(f"/api/v1/links/{link['slug']}").status_code == 204
    assert service.delete(f"/api/v1/batches/{batch['id']}").status_code == 204, "a link that is taken back keeps none"
    refused = check(service.delete(f"/api/v1/roads/{profile}"), 409, "in-use")
    assert refused.detail == "This measured road stays: 1 run and 1 link name it."

    recording = make_recording(service)
    assert service.run(["passive", f"recording:{recording}"]).status_code == 200
    refused = check(service.delete(f"/api/v1/recordings/{recording}"), 409, "in-use")
    assert refused.detail == "This recording stays: 1 run names it."


def test_a_link_that_is_taken_back_opens_nothing_and_pins_nothing(service: Service, fresh: dict[str, Any]) -> None:
    """Its own time histories and those of the runs it compares with, unless another link shows them."""
    beside = service.run(["passive"], {"road": {"length": 41, "bump": {"start": 20}}}).json()["id"]
    store: Store = service.services.store
    one, other = (
        service.post("/api/v1/links", json={"run_id": fresh["id"], "view": view}).raise_for_status().json()["slug"]
        for view in ({"pins": [{"name": "beside", "run": beside}]}, {})
    )
    assert [key for key in listed(service, "links", 50) if key in (one, other)] == [other, one]

    def pinned() -> set[str]:
        with store.reading() as connection:
            return set(connection.execute(select(pinned_series.c.result_key)).scalars())

    before = pinned()
    for _ in range(2):
        assert service.delete(f"/api/v1/links/{one}").status_code == 204
    assert len(before - pinned()) == 1, "of the run beside; the other link still shows its own"
    assert service.get(f"/api/v1/links/{other}").json()["series_pinned"] is True
    check(service.get(f"/api/v1/links/{one}"), 410, "revoked")
    page = service.get(f"/s/{one}")
    assert (page.status_code, "og:" in page.text, "This link was taken back" in page.text) == (410, False, True)
    (row,) = [each for each in service.get("/api/v1/links").json()["links"] if each["slug"] == one]
    assert row["revoked_at"] > row["created_at"]
    assert (row["run_id"], row["batch_id"], row["kind"]) == (None, None, "run")
    with store.reading() as connection:
        assert connection.execute(select(func.count()).where(links.c.slug == one)).scalar() == 1, "not that beside"
    assert service.delete(f"/api/v1/links/{other}").status_code == 204
    assert len(before - pinned()) == 3
