"""The numbered events of jobs. An event is added in the transaction that changes the job (`add_event`)."""

from collections.abc import Sequence

import orjson
from sqlalchemy import Connection, Row, func, insert, select

from backend.db.database import RowStore
from backend.db.tables import job_events, jobs
from backend.json_types import JsonObject
from backend.store.job import UNFINISHED

EVENTS_AT_ONCE = 500  # events read at once


class JobEventStore(RowStore):
    """Reads events; every method is one short transaction."""

    def of(self, job_id: str, after: int, limit: int = EVENTS_AT_ONCE) -> Sequence[Row[int, str, str]]:
        """Return the events behind event `after`: each its number, its kind and its data as JSON text."""
        with self._database.reading() as connection:
            return _events(connection, job_id, after, limit)

    def news(self, job_id: str, after: int) -> tuple[Sequence[Row[int, str, str]], bool]:
        """Return the events behind event `after`, and whether the job has ended."""
        with self._database.reading() as connection:
            state = connection.execute(select(jobs.c.state).where(jobs.c.id == job_id)).scalar_one_or_none()
            # Behind the state: an end that is seen has its event.
            events = _events(connection, job_id, after, EVENTS_AT_ONCE)
        return events, state not in UNFINISHED and len(events) < EVENTS_AT_ONCE

    def history(self, job_id: str) -> list[JsonObject]:
        """Return the data of its progress events since its last restart."""
        events = self.of(job_id, 0, limit=1_000_000)
        begun = max((event.number for event in events if event.kind == "restart"), default=0)
        return [orjson.loads(event.data) for event in events if event.kind == "progress" and event.number > begun]


def add_event(connection: Connection, job_id: str, kind: str, details: JsonObject | None = None) -> None:
    """Add an event with the job as this transaction leaves it."""
    columns = (jobs.c.state, jobs.c.done, jobs.c.failed, jobs.c.total, jobs.c.progress)
    job = connection.execute(select(*columns).where(jobs.c.id == job_id)).one()
    last = connection.execute(
        select(func.coalesce(func.max(job_events.c.number), 0)).where(job_events.c.job_id == job_id)
    ).scalar_one()
    counts = {"state": job.state, "done": job.done, "failed": job.failed, "total": job.total or None}
    data = orjson.dumps({**counts, **job.progress, **(details or {})}).decode()
    connection.execute(insert(job_events), {"job_id": job_id, "number": last + 1, "kind": kind, "data": data})


def _events(connection: Connection, job_id: str, after: int, limit: int) -> Sequence[Row[int, str, str]]:
    query = (
        select(job_events.c.number, job_events.c.kind, job_events.c.data)
        .where(job_events.c.job_id == job_id, job_events.c.number > after)
        .order_by(job_events.c.number)
        .limit(limit)
    )
    return connection.execute(query).all()
