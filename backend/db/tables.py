"""The tables of today's schema; `migrations` creates them, or changes those of an older database to them."""

from sqlalchemy import (
    Boolean,
    Column,
    Float,
    ForeignKey,
    Index,
    Integer,
    LargeBinary,
    MetaData,
    PrimaryKeyConstraint,
    String,
    Table,
    Text,
    UniqueConstraint,
    event,
    text,
)

from backend.db.columns import UNCHECKED, Json, Now, Utc, checksum_column

metadata = MetaData(
    naming_convention={
        "pk": "pk_%(table_name)s",
        "fk": "fk_%(table_name)s_%(column_0_name)s",
        "ix": "ix_%(column_0_label)s",
        "uq": "uq_%(table_name)s_%(column_0_name)s",
    }
)

schema_version = (
    Table(  # as Alembic has it, which made the tables until 0.4.0: such a service knows that they are newer
        "alembic_version",
        metadata,
        Column("version_num", String(32)),
        PrimaryKeyConstraint("version_num", name="alembic_version_pkc"),
    )
)

EXPIRED = "expired"  # the status of a result whose summary is gone; runs keep which strategies they have
EXPIRED_RESULT = {"status": EXPIRED, "summary": "{}", "compute_ms": 0, "checksum": UNCHECKED}
UNEXPIRED = text(f"status <> '{EXPIRED}'")

results = Table(
    "results",
    metadata,
    Column("key", String(43), primary_key=True),
    Column("strategy", String(64), nullable=False),
    Column("core_version", String(32), nullable=False),
    Column("status", String(16), nullable=False),
    Column("summary", Text, nullable=False),
    Column("compute_ms", Float, nullable=False),
    Column("created_at", Utc, nullable=False, default=Now()),
    checksum_column("key", "strategy", "core_version", "status", "summary", "compute_ms"),
)
# An index of some rows, said as a column's would load every dialect.
_INDEX = f"CREATE INDEX ix_results_created_at ON results (created_at) WHERE {UNEXPIRED}"
event.listen(results, "after_create", lambda _, connection, **__: connection.exec_driver_sql(_INDEX))

# Measured ones, by content. What names one holds on to it.
roads = Table(
    "roads",
    metadata,
    Column("id", String(22), primary_key=True),
    Column("samples", Integer, nullable=False),
    Column("content", LargeBinary, nullable=False),
    Column("created_at", Utc, nullable=False, default=Now(), index=True),
    Column("analysis", Json, nullable=True),  # of the first file; null for roads of 0.3.0 and before
    checksum_column("id", "samples", "content", "analysis"),
)


def _owners(file: str) -> Table:
    """Return who sent a road or a recording: each token lists it, and it goes when the last one takes it back."""
    return Table(
        f"{file}_owners",
        metadata,
        Column(f"{file}_id", String(22), ForeignKey(f"{file}s.id", ondelete="CASCADE"), primary_key=True),
        Column("owner", String(64), primary_key=True, index=True),
    )


road_owners, recording_owners = _owners("road"), _owners("recording")

run_roads = Table(
    "run_roads",
    metadata,
    Column("run_id", String(22), ForeignKey("runs.id"), primary_key=True),
    Column("road_id", String(22), ForeignKey("roads.id"), nullable=False, index=True),
)

job_roads = Table(
    "job_roads",
    metadata,
    Column("job_id", String(22), ForeignKey("jobs.id"), primary_key=True),
    Column("road_id", String(22), ForeignKey("roads.id"), primary_key=True, index=True),
)

# Recorded drives, by content; `signals` are the catalogue's names, with commas.
recordings = Table(
    "recordings",
    metadata,
    Column("id", String(22), primary_key=True),
    Column("samples", Integer, nullable=False),
    Column("signals", String(255), nullable=False),
    Column("content", LargeBinary, nullable=False),
    Column("created_at", Utc, nullable=False, default=Now(), index=True),
    checksum_column("id", "samples", "signals", "content"),
)

run_recordings = Table(
    "run_recordings",
    metadata,
    Column("run_id", String(22), ForeignKey("runs.id"), primary_key=True),
    Column("recording_id", String(22), ForeignKey("recordings.id"), primary_key=True, index=True),
)

runs = Table(
    "runs",
    metadata,
    Column("id", String(22), primary_key=True),
    Column("core_version", String(32), nullable=False),
    Column("schema_version", Integer, nullable=False),
    Column("scenario", Json, nullable=False),
    Column("created_at", Utc, nullable=False, default=Now()),
    Column("roads", Integer, nullable=False, server_default="1"),
    Column("baseline", String(64), nullable=True),
    checksum_column("id", "core_version", "schema_version", "scenario", "roads", "baseline"),
)

# Road after road, on each the strategies in the order they are shown.
run_results = Table(
    "run_results",
    metadata,
    Column("run_id", String(22), ForeignKey("runs.id"), primary_key=True),
    Column("position", Integer, primary_key=True),
    Column("result_key", String(43), ForeignKey("results.key"), nullable=False, index=True),
)

REMOVED = "removed"  # the kind of a deleted job that has rows left

# Every kind of job: a sweep (the batches of the API), a tuning, a reproduction of the paper. A tuning is the parent of
# its sweeps. `sweep` is read only where it is needed: it may have 100,000 points.
jobs = Table(
    "jobs",
    metadata,
    Column("id", String(22), primary_key=True),
    Column("kind", String(16), nullable=False),
    Column("parent_id", String(22), ForeignKey("jobs.id"), nullable=True),
    Column("label", String(200), nullable=True),
    Column("owner", String(64), nullable=True),
    Column("state", String(16), nullable=False, index=True),
    Column("reason", Text, nullable=True),
    Column("core_version", String(32), nullable=False),
    Column("schema_version", Integer, nullable=False),
    Column("request", Json, nullable=False),
    Column("sweep", Json, nullable=True),
    Column("progress", Json, nullable=False),
    Column("answer", Json, nullable=True),
    Column("estimated_cost", Float, nullable=False),
    Column("total", Integer, nullable=False),
    Column("done", Integer, nullable=False),
    Column("failed", Integer, nullable=False),
    Column("idempotency_key", String(255), nullable=True),
    Column("request_hash", String(43), nullable=False),
    Column("created_at", Utc, nullable=False, default=Now(), index=True),
    Column("started_at", Utc, nullable=True),
    Column("finished_at", Utc, nullable=True),
    UniqueConstraint("kind", "idempotency_key"),
    Index("ix_jobs_parent_id_finished_at", "parent_id", "finished_at"),
)

# One row a run: a point of the sweep under one strategy. `changes` are the values of the job's `fields` there.
job_runs = Table(
    "job_runs",
    metadata,
    Column("job_id", String(22), ForeignKey("jobs.id"), primary_key=True),
    Column("position", Integer, primary_key=True),
    Column("changes", Text, nullable=False),
    Column("strategy", String(64), nullable=False),
    Column("status", String(16), nullable=False),
    Column("result_key", String(43), nullable=True),
    Column("reason", Text, nullable=True),
    Index("ix_job_runs_result_key_job_id", "result_key", "job_id"),
)

job_events = Table(
    "job_events",
    metadata,
    Column("job_id", String(22), ForeignKey("jobs.id"), primary_key=True),
    Column("number", Integer, primary_key=True),
    Column("kind", String(16), nullable=False),
    Column("data", Text, nullable=False),
)

# A tuning's, of complete generations only: what a crash interrupts is asked for and run again, to the same trials.
trials = Table(
    "trials",
    metadata,
    Column("job_id", String(22), ForeignKey("jobs.id"), primary_key=True),
    Column("number", Integer, primary_key=True),
    Column("generation", Integer, nullable=False),
    Column("weights", Json, nullable=False),
    Column("status", String(16), nullable=False),
    Column("reason", Text, nullable=True),
    Column("feasible", Boolean, nullable=False),
    Column("objectives", Json, nullable=True),
    Column("limits", Json, nullable=True),
)

# A link that was taken back names nothing any more.
links = Table(
    "links",
    metadata,
    Column("slug", String(22), primary_key=True),
    Column("kind", String(8), nullable=False),
    Column("run_id", String(22), ForeignKey("runs.id"), nullable=True, index=True),
    Column("job_id", String(22), ForeignKey("jobs.id"), nullable=True, index=True),
    Column("view", Json, nullable=False),
    Column("created_at", Utc, nullable=False, default=Now()),
    Column("damaged_at", Utc, nullable=True),  # something that it shows was found damaged then
    Column("owner", String(64), nullable=True),
    Column("revoked_at", Utc, nullable=True),
    Column("pin_of", String(22), nullable=True),  # the link whose view has this one's run pinned beside its own
    checksum_column("slug", "kind", "run_id", "job_id", "view"),
    Index("ix_links_created_at", "created_at"),
    Index("ix_links_owner_created_at", "owner", "created_at"),
    Index("ix_links_pin_of", "pin_of"),
)

pinned_series = Table(
    "pinned_series",
    metadata,
    Column("result_key", String(43), ForeignKey("results.key"), primary_key=True),
    Column("content", LargeBinary, nullable=False),
    Column("created_at", Utc, nullable=False, default=Now()),
    checksum_column("result_key", "content"),
)

# Of the page, ended before their time.
ended_logins = Table(
    "ended_logins",
    metadata,
    Column("login", String(43), primary_key=True),
    Column("ended_at", Utc, nullable=False, default=Now()),
)
