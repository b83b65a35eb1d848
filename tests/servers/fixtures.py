"""Fixtures every test may ask for: a real PostgreSQL, a database of either kind, the paper's reproduction."""

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.servers import leftovers
from tests.servers.postgres import Postgres


@pytest.fixture(scope="session", autouse=True)
def nothing_left_running() -> Iterator[None]:
    """Set up before and so ended after every other: what any test started has ended by then."""
    leftovers.mark()
    yield
    assert not leftovers.left_running()


@pytest.fixture(scope="session")
def postgres() -> Iterator[Postgres]:
    """One server for all tests. Who stops or kills it starts it again; `new_database` does so too."""
    server = Postgres()
    try:
        server.start()
        yield server
    finally:
        server.remove()


@pytest.fixture(params=["sqlite", "postgresql"])
def database_url(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    """The SQLAlchemy URL of an empty database of its own; the test runs once on each kind."""
    if request.param == "sqlite":
        return f"sqlite:///{tmp_path}/new/folder/ridelab.sqlite"
    server: Postgres = request.getfixturevalue("postgres")
    return server.new_database()


@pytest.fixture(scope="session")
def migrated_sqlite(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A database of the newest schema with nothing in it, for tests to copy."""
    path = tmp_path_factory.mktemp("migrated") / "ridelab.sqlite"
    migrate(f"sqlite:///{path}")
    return path


@pytest.fixture(scope="session")
def migrated_postgres(postgres: Postgres) -> str:
    """The name of one on the server."""
    url = postgres.new_database()
    migrate(url)
    return url.rpartition("/")[2]


def migrate(url: str) -> None:
    from backend.store import Store  # not for every test process

    store = Store(url)
    store.migrate()
    store.close()


@pytest.fixture(params=["sqlite", "postgresql"])
def migrated_url(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    """A `database_url` with the newest schema, copied from one that was migrated once."""
    if request.param == "sqlite":
        return f"sqlite:///{shutil.copy(request.getfixturevalue('migrated_sqlite'), tmp_path)}"
    template: str = request.getfixturevalue("migrated_postgres")
    server: Postgres = request.getfixturevalue("postgres")
    return server.new_database(template)


@pytest.fixture(scope="session")
def reproduction() -> Callable[[str], None]:
    """Puts the paper's reproduction into the database of that URL, so that its service computes none of it.

    Before the service starts or while it runs. See `tests.servers.reproduction`.
    """
    from tests.servers.reproduction import store_in_database  # half the service: not for every test process

    return store_in_database
