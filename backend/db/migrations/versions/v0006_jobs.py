"""Batches and tunings become kinds of one job, with a parent, a label and an owner."""

from alembic import op
from sqlalchemy import (
    Boolean,
    Column,
    DateTime,
    Float,
    ForeignKey,
    Index,
    Integer,
    String,
    Text,
    UniqueConstraint,
)

from backend.db.migrations.columns import key, optional, position, required

revision = "0006"
down_revision = "0005"

TIME = DateTime(timezone=True)

# A tuning's batches were known by their idempotency keys: "tuning <id> <attempt> <name>".
PARENT = "CASE WHEN idempotency_key LIKE 'tuning %' THEN substr(idempotency_key, 8, 22) END"
SHARED = (
    "id, state, reason, core_version, schema_version, estimated_cost, total, done, failed, idempotency_key, "
    "request_hash, created_at, started_at, finished_at"
)


def upgrade() -> None:
    """Apply this step."""
    _create_tables()
    batch = _object(scenario="scenario", strategies="strategies", fields="fields")
    tuning = _object(step=_quoted("step"), attempt="attempt", generation="generation", feasible="feasible", batch="b.b")
    job = f"INSERT INTO jobs ({SHARED}, kind, parent_id, request, sweep, progress, answer)"
    quoted_batch = "SELECT CASE WHEN batch_id IS NULL THEN 'null' ELSE '\"' || batch_id || '\"' END AS b, id AS tuning"
    op.execute(
        f"{job} SELECT {SHARED}, 'tuning', NULL, request, NULL, {tuning}, comparison "
        f"FROM tunings JOIN ({quoted_batch} FROM tunings) AS b ON b.tuning = id"
    )
    op.execute(f"{job} SELECT {SHARED}, 'sweep', {PARENT}, {batch}, sweep, '{{}}', NULL FROM batches")
    for old, new in {"batch_runs": "job_runs", "batch_events": "job_events", "tuning_events": "job_events"}.items():
        columns = (
            "position, changes, strategy, status, result_key, reason" if new == "job_runs" else "number, kind, data"
        )
        op.execute(f"INSERT INTO {new} (job_id, {columns}) SELECT {old.split('_')[0]}_id, {columns} FROM {old}")
    columns = "number, generation, weights, status, reason, feasible, objectives, limits"
    op.execute(f"INSERT INTO trials (job_id, {columns}) SELECT tuning_id, {columns} FROM tuning_trials")
    op.execute("CREATE TABLE old_links AS SELECT * FROM links")
    op.drop_table("links")
    _create_links()
    op.execute(
        "INSERT INTO links (slug, kind, run_id, job_id, view, created_at) "
        "SELECT slug, kind, run_id, batch_id, view, created_at FROM old_links"
    )
    for name in ("old_links", "tuning_events", "tuning_trials", "tunings", "batch_events", "batch_runs", "batches"):
        op.drop_table(name)


def _create_tables() -> None:
    op.create_table(
        "jobs",
        key("id", 22),
        Column("parent_id", String(22), ForeignKey("jobs.id"), index=True),
        *required(kind=String(16), state=String(16), core_version=String(32), schema_version=Integer()),
        *required(request=Text(), progress=Text(), estimated_cost=Float()),
        *required(total=Integer(), done=Integer(), failed=Integer(), request_hash=String(43), created_at=TIME),
        *optional(label=String(200), owner=String(64), reason=Text(), sweep=Text(), answer=Text()),
        *optional(idempotency_key=String(255), started_at=TIME, finished_at=TIME),
        Index("ix_jobs_state", "state"),
        Index("ix_jobs_created_at", "created_at"),
        UniqueConstraint("kind", "idempotency_key", name="uq_jobs_kind"),
    )
    op.create_table(
        "job_runs",
        *(key("job_id", 22, ForeignKey("jobs.id")), position("position")),
        *required(changes=Text(), strategy=String(64), status=String(16)),
        *optional(result_key=String(43), reason=Text()),
        Index("ix_job_runs_result_key_job_id", "result_key", "job_id"),
    )
    op.create_table(
        "job_events",
        *(key("job_id", 22, ForeignKey("jobs.id")), position("number")),
        *required(kind=String(16), data=Text()),
    )
    op.create_table(
        "trials",
        *(key("job_id", 22, ForeignKey("jobs.id")), position("number")),
        *required(generation=Integer(), weights=Text(), status=String(16), feasible=Boolean()),
        *optional(reason=Text(), objectives=Text(), limits=Text()),
    )


def _create_links() -> None:
    op.create_table(
        "links",
        key("slug", 22),
        *required(kind=String(8), view=Text(), created_at=TIME),
        Column("run_id", String(22), ForeignKey("runs.id")),
        Column("job_id", String(22), ForeignKey("jobs.id")),
    )


def _object(**members: str) -> str:
    """SQL that makes a JSON object of columns that hold JSON."""
    return "'{' || " + " || ',' || ".join(f"'\"{name}\":' || {column}" for name, column in members.items()) + " || '}'"


def _quoted(column: str) -> str:
    return f"'\"' || {column} || '\"'"
