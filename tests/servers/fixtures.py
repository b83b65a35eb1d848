"""Fixtures every test may ask for: a real PostgreSQL, and a database of either kind."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.servers.postgres import Postgres


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
