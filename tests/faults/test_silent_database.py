"""The network between the service and PostgreSQL swallows what is sent, in both directions or in one.

Nothing ends the connections: without limits of its own the service would wait for ever.
"""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing

import psycopg
import pytest
from sqlalchemy import make_url

from backend.db import limited_connection
from backend.db.limited_connection import LimitedConnection, NoAnswerError
from backend.settings import Settings
from backend.store import Store
from tests.api.conftest import Service, serve
from tests.servers.batches import wait_for
from tests.servers.forwarder import DIRECTIONS, Direction, Forwarder
from tests.servers.postgres import Postgres
from tests.servers.process import reserved_port, wait_until

SHORT = {"road": {"length": 121.3, "bump": {"start": 80}}}
ASKING = 12  # more than there are threads for the database


@pytest.fixture(scope="module")
def forwarder(postgres: Postgres) -> Iterator[Forwarder]:
    with closing(Forwarder(postgres.port)) as forwarder:
        yield forwarder


@pytest.fixture(scope="module")
def url(postgres: Postgres, forwarder: Forwarder, migrated_postgres: str) -> str:
    """Of a database behind the forwarder."""
    address = make_url(postgres.new_database(migrated_postgres))
    return address.set(port=forwarder.port).render_as_string(hide_password=False)


@pytest.fixture(scope="module")
def service(url: str, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    folder = tmp_path_factory.mktemp("silent")
    yield from serve(Settings(data_dir=folder, database_url=url, workers=1, batch_workers=1))


@pytest.fixture
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    """The limits are shorter than those shipped, so that the tests are too."""
    monkeypatch.setattr(LimitedConnection, "answer_timeout", 2.0)
    monkeypatch.setattr(limited_connection, "CONNECT_TIMEOUT", 2)


@pytest.mark.usefixtures("impatient")
@pytest.mark.parametrize(
    "direction", [pytest.param(name, marks=[pytest.mark.thorough] * (name != "both")) for name in DIRECTIONS]
)
def test_who_asks_meanwhile_gets_503_and_afterwards_an_answer(
    service: Service, forwarder: Forwarder, direction: Direction
) -> None:
    stored = service.run(["passive"], SHORT).json()
    path = f"/api/v1/runs/{stored['id']}"
    with forwarder.blocked(direction), ThreadPoolExecutor(ASKING + 2) as clients:
        new = clients.submit(service.run, ["passive"], {"road": {"length": 122.3}})
        unready = clients.submit(service.get, "/readyz")
        answers = [*clients.map(lambda _: service.get(path), range(ASKING)), new.result()]
        assert {answer.status_code for answer in answers} == {503}
        assert all(int(answer.headers["retry-after"]) > 0 for answer in answers)
        assert unready.result().json()["store"] is False
        assert service.get("/healthz").status_code == 200
    wait_until(lambda: service.get("/readyz").status_code == 200, "the service is ready again")
    assert service.get(path).json()["id"] == stored["id"]
    sweep = {"grid": {"road.seed": [1, 2]}}
    batch = service.post("/api/v1/batches", json={"scenario": SHORT, "strategies": ["passive"], "sweep": sweep})
    assert wait_for(service, batch.json()["id"])["done"] == 2, "somebody drives the jobs again"


def test_a_server_that_waits_gives_up_before_its_client(url: str) -> None:
    """So that an ordinary lock or a slow disk is not taken for a network that is cut."""
    with closing(Store(url)) as store, store.reading() as connection:
        limits = "SELECT setting::float / 1000 FROM pg_settings WHERE name IN ({})"
        names = "'statement_timeout', 'idle_in_transaction_session_timeout'"
        statement, idle = connection.exec_driver_sql(limits.format(names) + " ORDER BY name DESC").scalars()
    assert 0 < statement < LimitedConnection.answer_timeout
    assert idle > 0


def test_a_server_that_is_found_away_only_after_a_while_fails_what_queues_behind(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """As the name of a container that is away: else each would wait as long, one after the other."""
    refused = {"host": "127.0.0.1", "port": reserved_port()}
    with pytest.raises(psycopg.OperationalError) as at_once:
        LimitedConnection.connect(**refused)
    assert not isinstance(at_once.value, NoAnswerError)
    monkeypatch.setattr(limited_connection, "SLOW", 0.0)
    with pytest.raises(NoAnswerError, match="refused"):
        LimitedConnection.connect(**refused)


def test_what_may_take_long_is_waited_for_and_only_that(url: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(LimitedConnection, "answer_timeout", 0.5)
    with closing(Store(url)) as store:
        with store.writing(large=True) as connection:
            connection.exec_driver_sql("SELECT pg_sleep(1)")
        store.ping()
        with store.engine.connect() as connection:
            driver = connection.connection.driver_connection
            assert isinstance(driver, LimitedConnection)
            assert driver.answer_timeout == 0.5
