"""Which of several replicas drives the jobs: the database knows who holds the lock, and from which port."""

from collections.abc import Iterator, Sequence
from typing import TypeVar

import psutil
from sqlalchemy import NullPool, create_engine, text

from backend.jobs.leadership import LOCK_ID
from tests.servers.process import Program, wait_until

HOLDERS = text(
    "SELECT client_port FROM pg_stat_activity JOIN pg_locks USING (pid) "
    "WHERE locktype = 'advisory' AND objid = :id AND granted"
)
T = TypeVar("T", bound=Program)


def leader(database_url: str, replicas: Sequence[T]) -> T:
    """The replica that holds the lock, once one does."""
    engine, found = create_engine(database_url, poolclass=NullPool), list[T]()

    def look() -> bool:
        with engine.connect() as connection:
            for port in connection.execute(HOLDERS, {"id": LOCK_ID}).scalars():
                found.extend(each for each in replicas if port in _ports(each))
        return bool(found)

    wait_until(look, "a replica drives")
    return found[0]


def _ports(program: Program) -> Iterator[int]:
    """The ports of its connections; none where it is dead."""
    try:
        yield from [connection.laddr.port for connection in psutil.Process(program.pid).net_connections()]
    except psutil.Error:
        return
