"""The tables of today's schema; `migrations` creates them, or changes those of an older database to them."""

import sqlalchemy as sa

from backend.db.columns import UNCHECKED, Json, Now, Utc, checksum_column

metadata = sa.MetaData(
    naming_convention={
        "pk": "pk_%(table_name)s",
        "fk": "fk_%(table_name)s_%(column_0_name)s",
        "ix": "ix_%(column_0_label)s",
        "uq": "uq_%(table_name)s_%(column_0_name)s",
    }
)

# As Alembic has it, which made the tables until 0.4.0: such a service knows that they are newer.
schema_version = sa.Table(
    "alembic_version",
    metadata,
    sa.Column("version_num", sa.String(32)),
    sa.PrimaryKeyConstraint("version_num", name="alembic_version_pkc"),
)

EXPIRED = "expired"  # the status of a result whose summary is gone; runs keep which strategies they have
EXPIRED_RESULT = {"status": EXPIRED, "summary": "{}", "compute_ms": 0, "checksum": UNCHECKED}
UNEXPIRED = sa.text(f"status <> '{EXPIRED}'")

results = sa.Table(
    "results",
    metadata,
    sa.Column("key", sa.String(43), primary_key=True),
    sa.Column("strategy", sa.String(64), nullable=False),
    sa.Column("core_version", sa.String(32), nullable=False),
    sa.Column("status", sa.String(16), nullable=False),
    sa.Column("summary", sa.Text, nullable=False),
    sa.Column("compute_ms", sa.Float, nullable=False),
    sa.Column("created_at", Utc, nullable=False, default=Now()),
    checksum_column("key", "strategy", "core_version", "status", "summary", "compute_ms"),
)
# An index of some rows, said as a column's would load every dialect.
_INDEX = f"CREATE INDEX ix_results_created_at ON results (created_at) WHERE {UNEXPIRED}"
sa.event.listen(results, "after_create", lambda _, connection, **__: connection.exec_driver_sql(_INDEX))

# Measured ones, by content. What names one holds on to it.
roads = sa.Table(
    "roads",
    metadata,
    sa.Column("id", sa.String(22), primary_key=True),
    sa.Column("samples", sa.Integer, nullable=False),
    sa.Column("content", sa.LargeBinary, nullable=False),
    sa.Column("created_at", Utc, nullable=False, default=Now(), index=True),
    sa.Column("analysis", Json, nullable=True),  # of the first file; null for roads of 0.3.0 and before
    checksum_column("id", "samples", "content", "analysis"),
)


def _owners(file: str) -> sa.Table:
    """Return who sent a road or a recording: each token lists it, and it goes when the last one takes it back."""
    return sa.Table(
        f"{file}_owners",
        metadata,
        sa.Column(f"{file}_id", sa.String(22), sa.ForeignKey(f"{file}s.id", ondelete="CASCADE"), primary_key=True),
        sa.Column("owner", sa.String(64), primary_key=True, index=True),
    )


road_owners, recording_owners = _owners("road"), _owners("recording")

run_roads = sa.Table(
    "run_roads",
    metadata,
    sa.Column("run_id", sa.String(22), sa.ForeignKey("runs.id"), primary_key=True),
    sa.Column("road_id", sa.String(22), sa.ForeignKey("roads.id"), nullable=False, index=True),
)

job_roads = sa.Table(
    "job_roads",
    metadata,
    sa.Column("job_id", sa.String(22), sa.ForeignKey("jobs.id"), primary_key=True),
    sa.Column("road_id", sa.String(22), sa.ForeignKey("roads.id"), primary_key=True, index=True),
)

# Recorded drives, by content; `signals` are the catalogue's names, with commas.
recordings = sa.Table(
    "recordings",
    metadata,
    sa.Column("id", sa.String(22), primary_key=True),
    sa.Column("samples", sa.Integer, nullable=False),
    sa.Column("signals", sa.String(255), nullable=False),
    sa.Column("content", sa.LargeBinary, nullable=False),
    sa.Column("created_at", Utc, nullable=False, default=Now(), index=True),
    checksum_column("id", "samples", "signals", "content"),
)

run_recordings = sa.Table(
    "run_recordings",
    metadata,
    sa.Column("run_id", sa.String(22), sa.ForeignKey("runs.id"), primary_key=True),
    sa.Column("recording_id", sa.String(22), sa.ForeignKey("recordings.id"), primary_key=True, index=True),
)

runs = sa.Table(
    "runs",
    metadata,
    sa.Column("id", sa.String(22), primary_key=True),
    sa.Column("core_version", sa.String(32), nullable=False),
    sa.Column("schema_version", sa.Integer, nullable=False),
    sa.Column("scenario", Json, nullable=False),
    sa.Column("created_at", Utc, nullable=False, default=Now()),
    sa.Column("roads", sa.Integer, nullable=False, server_default="1"),
    sa.Column("baseline", sa.String(64), nullable=True),
    checksum_column("id", "core_version", "schema_version", "scenario", "roads", "baseline"),
)

# Road after road, on each the strategies in the order they are shown.
run_results = sa.Table(
    "run_results",
    metadata,
    sa.Column("run_id", sa.String(22), sa.ForeignKey("runs.id"), primary_key=True),
    sa.Column("position", sa.Integer, primary_key=True),
    sa.Column("result_key", sa.String(43), sa.ForeignKey("results.key"), nullable=False, index=True),
)

REMOVED = "removed"  # the kind of a deleted job that has rows left

# Every kind of job: a sweep (the batches of the API), a tuning, a reproduction of the paper. A tuning is the parent of
# its sweeps. `sweep` is read only where it is needed: it may have 100,000 points.
jobs = sa.Table(
    "jobs",
    metadata,
    sa.Column("id", sa.String(22), primary_key=True),
    sa.Column("kind", sa.String(16), nullable=False),
    sa.Column("parent_id", sa.String(22), sa.ForeignKey("jobs.id"), nullable=True),
    sa.Column("label", sa.String(200), nullable=True),
    sa.Column("owner", sa.String(64), nullable=True),
    sa.Column("state", sa.String(16), nullable=False, index=True),
    sa.Column("reason", sa.Text, nullable=True),
    sa.Column("core_version", sa.String(32), nullable=False),
    sa.Column("schema_version", sa.Integer, nullable=False),
    sa.Column("request", Json, nullable=False),
    sa.Column("sweep", Json, nullable=True),
    sa.Column("progress", Json, nullable=False),
    sa.Column("answer", Json, nullable=True),
    sa.Column("estimated_cost", sa.Float, nullable=False),
    sa.Column("total", sa.Integer, nullable=False),
    sa.Column("done", sa.Integer, nullable=False),
    sa.Column("failed", sa.Integer, nullable=False),
    sa.Column("idempotency_key", sa.String(255), nullable=True),
    sa.Column("request_hash", sa.String(43), nullable=False),
    sa.Column("created_at", Utc, nullable=False, default=Now(), index=True),
    sa.Column("started_at", Utc, nullable=True),
    sa.Column("finished_at", Utc, nullable=True),
    sa.UniqueConstraint("kind", "idempotency_key"),
    sa.Index("ix_jobs_parent_id_finished_at", "parent_id", "finished_at"),
)

# One row a run: a point of the sweep under one strategy. `changes` are the values of the job's `fields` there.
job_runs = sa.Table(
    "job_runs",
    metadata,
    sa.Column("job_id", sa.String(22), sa.ForeignKey("jobs.id"), primary_key=True),
    sa.Column("position", sa.Integer, primary_key=True),
    sa.Column("changes", sa.Text, nullable=False),
    sa.Column("strategy", sa.String(64), nullable=False),
    sa.Column("status", sa.String(16), nullable=False),
    sa.Column("result_key", sa.String(43), nullable=True),
    sa.Column("reason", sa.Text, nullable=True),
    sa.Index("ix_job_runs_result_key_job_id", "result_key", "job_id"),
)

job_events = sa.Table(
    "job_events",
    metadata,
    sa.Column("job_id", sa.String(22), sa.ForeignKey("jobs.id"), primary_key=True),
    sa.Column("number", sa.Integer, primary_key=True),
    sa.Column("kind", sa.String(16), nullable=False),
    sa.Column("data", sa.Text, nullable=False),
)

# A tuning's, of complete generations only: what a crash interrupts is asked for and run again, to the same trials.
trials = sa.Table(
    "trials",
    metadata,
    sa.Column("job_id", sa.String(22), sa.ForeignKey("jobs.id"), primary_key=True),
    sa.Column("number", sa.Integer, primary_key=True),
    sa.Column("generation", sa.Integer, nullable=False),
    sa.Column("weights", Json, nullable=False),
    sa.Column("status", sa.String(16), nullable=False),
    sa.Column("reason", sa.Text, nullable=True),
    sa.Column("feasible", sa.Boolean, nullable=False),
    sa.Column("objectives", Json, nullable=True),
    sa.Column("limits", Json, nullable=True),
)

# A link that was taken back names nothing any more.
links = sa.Table(
    "links",
    metadata,
    sa.Column("slug", sa.String(22), primary_key=True),
    sa.Column("kind", sa.String(8), nullable=False),
    sa.Column("run_id", sa.String(22), sa.ForeignKey("runs.id"), nullable=True, index=True),
    sa.Column("job_id", sa.String(22), sa.ForeignKey("jobs.id"), nullable=True, index=True),
    sa.Column("view", Json, nullable=False),
    sa.Column("created_at", Utc, nullable=False, default=Now()),
    sa.Column("damaged_at", Utc, nullable=True),  # something that it shows was found damaged then
    sa.Column("owner", sa.String(64), nullable=True),
    sa.Column("revoked_at", Utc, nullable=True),
    sa.Column("pin_of", sa.String(22), nullable=True),  # the link whose view has this one's run pinned beside its own
    checksum_column("slug", "kind", "run_id", "job_id", "view"),
    sa.Index("ix_links_created_at", "created_at"),
    sa.Index("ix_links_owner_created_at", "owner", "created_at"),
    sa.Index("ix_links_pin_of", "pin_of"),
)

pinned_series = sa.Table(
    "pinned_series",
    metadata,
    sa.Column("result_key", sa.String(43), sa.ForeignKey("results.key"), primary_key=True),
    sa.Column("content", sa.LargeBinary, nullable=False),
    sa.Column("created_at", Utc, nullable=False, default=Now()),
    checksum_column("result_key", "content"),
)

# Of the page, ended before their time.
ended_logins = sa.Table(
    "ended_logins",
    metadata,
    sa.Column("login", sa.String(43), primary_key=True),
    sa.Column("ended_at", Utc, nullable=False, default=Now()),
)
