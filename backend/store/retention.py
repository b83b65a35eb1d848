"""Removal of what is old: jobs without a label or a link, results that nothing shows, roads that nothing names.

A run stays with its scenario and its strategies, so that it can be computed again; of its results the summaries go.
"""

from datetime import datetime

from sqlalchemy import Select, and_, delete, exists, func, or_, select, update

from backend.db.database import Database
from backend.db.tables import (
    job_events,
    job_roads,
    job_runs,
    jobs,
    links,
    pinned_series,
    results,
    roads,
    run_results,
    run_roads,
    trials,
)
from backend.store.job import FINAL
from backend.store.runs import EXPIRED

PAGE = 500  # jobs, results or roads in one transaction


class RetentionStore:
    """Removes old rows; every method is one short transaction."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def size(self) -> int:
        """Size of results, pinned time histories and rows of jobs [bytes]; the database's own overhead is extra."""
        columns = (results.c.summary, pinned_series.c.content, job_runs.c.changes, jobs.c.sweep, roads.c.content)
        with self._database.reading() as connection:
            sizes = [
                connection.execute(select(func.coalesce(func.sum(func.length(column)), 0))).scalar_one()
                for column in columns
            ]
        return int(sum(sizes))

    def oldest(self) -> datetime | None:
        """When the last row of the oldest removable page was stored; None where nothing is removable."""
        with self._database.reading() as connection:
            pages = [
                connection.execute(select(func.max(page.c.created))).scalar_one()
                for page in (each(None).subquery() for each in (_removable_jobs, _removable_results, _removable_roads))
            ]
        return min((created for created in pages if created is not None), default=None)

    def remove_jobs(self, before: datetime) -> int:
        """Remove a page of jobs that ended before then, with the jobs they submitted; returns how many."""
        with self._database.writing() as connection:
            ids = list(connection.execute(select(_removable_jobs(before).subquery().c.id)).scalars())
            family = select(jobs.c.id).where(or_(jobs.c.id.in_(ids), jobs.c.parent_id.in_(ids)))
            members = list(connection.execute(family).scalars())
            for table in (job_runs, job_roads, job_events, trials):
                connection.execute(delete(table).where(table.c.job_id.in_(members)))
            connection.execute(delete(jobs).where(jobs.c.parent_id.in_(ids)))
            connection.execute(delete(jobs).where(jobs.c.id.in_(ids)))
        return len(ids)

    def remove_results(self, before: datetime) -> int:
        """Remove a page of results stored before then that no job and no link needs; returns how many.

        Of a result that runs have, the summary alone is removed.
        """
        with self._database.writing() as connection:
            keys = list(connection.execute(select(_removable_results(before).subquery().c.key)).scalars())
            in_runs = select(run_results.c.result_key).where(run_results.c.result_key.in_(keys))
            in_use = list(connection.execute(in_runs.distinct()).scalars())
            connection.execute(
                update(results).where(results.c.key.in_(in_use)).values(status=EXPIRED, summary="{}", compute_ms=0)
            )
            connection.execute(delete(results).where(results.c.key.in_(set(keys) - set(in_use))))
        return len(keys)

    def remove_roads(self, before: datetime) -> int:
        """Remove a page of roads stored before then that no run and no job names; returns how many."""
        with self._database.writing() as connection:
            ids = list(connection.execute(select(_removable_roads(before).subquery().c.id)).scalars())
            connection.execute(delete(roads).where(roads.c.id.in_(ids)))
        return len(ids)


def _removable_roads(before: datetime | None) -> Select[tuple[str, datetime]]:
    query = select(roads.c.id, roads.c.created_at.label("created")).where(
        ~exists().where(run_roads.c.road_id == roads.c.id), ~exists().where(job_roads.c.road_id == roads.c.id)
    )
    return (query if before is None else query.where(roads.c.created_at < before)).order_by("created").limit(PAGE)


def _removable_jobs(before: datetime | None) -> Select[tuple[str, datetime]]:
    member = jobs.alias()  # the job itself, or one that it submitted
    named = or_(
        member.c.label.is_not(None),
        member.c.state.not_in(FINAL),
        exists().where(links.c.job_id == member.c.id),
    )
    family = or_(member.c.id == jobs.c.id, member.c.parent_id == jobs.c.id)
    query = select(jobs.c.id, jobs.c.finished_at.label("created")).where(
        jobs.c.parent_id.is_(None), jobs.c.state.in_(FINAL), ~exists().where(family, named)
    )
    return (query if before is None else query.where(jobs.c.finished_at < before)).order_by("created").limit(PAGE)


def _removable_results(before: datetime | None) -> Select[tuple[str, datetime]]:
    shown = exists().where(and_(links.c.run_id == run_results.c.run_id, run_results.c.result_key == results.c.key))
    query = select(results.c.key, results.c.created_at.label("created")).where(
        results.c.status != EXPIRED,
        ~exists().where(job_runs.c.result_key == results.c.key),
        ~exists().where(pinned_series.c.result_key == results.c.key),
        ~shown,
    )
    return (query if before is None else query.where(results.c.created_at < before)).order_by("created").limit(PAGE)
