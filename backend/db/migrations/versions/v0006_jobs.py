"""Batches and tunings become kinds of one job, with a parent, a label and an owner."""

import sqlalchemy as sa
from alembic import op

revision = "0006"
down_revision = "0005"

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
    time = sa.DateTime(timezone=True)
    op.create_table(
        "jobs",
        sa.Column("id", sa.String(22), primary_key=True),
        sa.Column("kind", sa.String(16), nullable=False),
        sa.Column("parent_id", sa.String(22), sa.ForeignKey("jobs.id"), index=True),
        sa.Column("label", sa.String(200)),
        sa.Column("owner", sa.String(64)),
        sa.Column("state", sa.String(16), nullable=False, index=True),
        sa.Column("reason", sa.Text()),
        sa.Column("core_version", sa.String(32), nullable=False),
        sa.Column("schema_version", sa.Integer(), nullable=False),
        sa.Column("request", sa.Text(), nullable=False),
        sa.Column("sweep", sa.Text()),
        sa.Column("progress", sa.Text(), nullable=False),
        sa.Column("answer", sa.Text()),
        sa.Column("estimated_cost", sa.Float(), nullable=False),
        sa.Column("total", sa.Integer(), nullable=False),
        sa.Column("done", sa.Integer(), nullable=False),
        sa.Column("failed", sa.Integer(), nullable=False),
        sa.Column("idempotency_key", sa.String(255)),
        sa.Column("request_hash", sa.String(43), nullable=False),
        sa.Column("created_at", time, nullable=False, index=True),
        sa.Column("started_at", time),
        sa.Column("finished_at", time),
        sa.UniqueConstraint("kind", "idempotency_key", name="uq_jobs_kind"),
    )
    op.create_table(
        "job_runs",
        sa.Column("job_id", sa.String(22), sa.ForeignKey("jobs.id"), primary_key=True),
        sa.Column("position", sa.Integer(), primary_key=True, autoincrement=False),
        sa.Column("changes", sa.Text(), nullable=False),
        sa.Column("strategy", sa.String(64), nullable=False),
        sa.Column("status", sa.String(16), nullable=False),
        sa.Column("result_key", sa.String(43)),
        sa.Column("reason", sa.Text()),
        sa.Index("ix_job_runs_result_key_job_id", "result_key", "job_id"),
    )
    op.create_table(
        "job_events",
        sa.Column("job_id", sa.String(22), sa.ForeignKey("jobs.id"), primary_key=True),
        sa.Column("number", sa.Integer(), primary_key=True, autoincrement=False),
        sa.Column("kind", sa.String(16), nullable=False),
        sa.Column("data", sa.Text(), nullable=False),
    )
    op.create_table(
        "trials",
        sa.Column("job_id", sa.String(22), sa.ForeignKey("jobs.id"), primary_key=True),
        sa.Column("number", sa.Integer(), primary_key=True, autoincrement=False),
        sa.Column("generation", sa.Integer(), nullable=False),
        sa.Column("weights", sa.Text(), nullable=False),
        sa.Column("status", sa.String(16), nullable=False),
        sa.Column("reason", sa.Text()),
        sa.Column("feasible", sa.Boolean(), nullable=False),
        sa.Column("objectives", sa.Text()),
        sa.Column("limits", sa.Text()),
    )


def _create_links() -> None:
    op.create_table(
        "links",
        sa.Column("slug", sa.String(22), primary_key=True),
        sa.Column("kind", sa.String(8), nullable=False),
        sa.Column("run_id", sa.String(22), sa.ForeignKey("runs.id")),
        sa.Column("job_id", sa.String(22), sa.ForeignKey("jobs.id")),
        sa.Column("view", sa.Text(), nullable=False),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
    )


def _object(**members: str) -> str:
    """SQL that makes a JSON object of columns that hold JSON."""
    return "'{' || " + " || ',' || ".join(f"'\"{name}\":' || {column}" for name, column in members.items()) + " || '}'"


def _quoted(column: str) -> str:
    return f"'\"' || {column} || '\"'"
