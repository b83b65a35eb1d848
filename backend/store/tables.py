"""The tables; the migrations in backend/migrations make them, and a test holds the two together."""

from sqlalchemy import (
    Boolean,
    Column,
    DateTime,
    Float,
    ForeignKey,
    Index,
    Integer,
    LargeBinary,
    MetaData,
    String,
    Table,
    Text,
)

metadata = MetaData(
    naming_convention={
        "pk": "pk_%(table_name)s",
        "fk": "fk_%(table_name)s_%(column_0_name)s",
        "ix": "ix_%(column_0_label)s",
        "uq": "uq_%(table_name)s_%(column_0_name)s",
    }
)

results = Table(
    "results",
    metadata,
    Column("key", String(43), primary_key=True),
    Column("strategy", String(64), nullable=False),
    Column("core_version", String(32), nullable=False),
    Column("status", String(16), nullable=False),
    Column("summary", Text, nullable=False),
    Column("compute_ms", Float, nullable=False),
    Column("created_at", DateTime(timezone=True), nullable=False),
)

runs = Table(
    "runs",
    metadata,
    Column("id", String(22), primary_key=True),
    Column("core_version", String(32), nullable=False),
    Column("schema_version", Integer, nullable=False),
    Column("scenario", Text, nullable=False),
    Column("created_at", DateTime(timezone=True), nullable=False),
    Column("roads", Integer, nullable=False, server_default="1"),
    Column("baseline", String(64), nullable=True),
)

# Road after road, on each the strategies in the order they are shown.
run_results = Table(
    "run_results",
    metadata,
    Column("run_id", String(22), ForeignKey("runs.id"), primary_key=True),
    Column("position", Integer, primary_key=True),
    Column("result_key", String(43), ForeignKey("results.key"), nullable=False, index=True),
)

batches = Table(
    "batches",
    metadata,
    Column("id", String(22), primary_key=True),
    Column("state", String(16), nullable=False),
    Column("reason", Text, nullable=True),
    Column("core_version", String(32), nullable=False),
    Column("schema_version", Integer, nullable=False),
    Column("scenario", Text, nullable=False),
    Column("strategies", Text, nullable=False),
    Column("sweep", Text, nullable=False),
    Column("fields", Text, nullable=False),
    Column("estimated_cost", Float, nullable=False),
    Column("total", Integer, nullable=False),
    Column("done", Integer, nullable=False),
    Column("failed", Integer, nullable=False),
    Column("idempotency_key", String(255), nullable=True, unique=True),
    Column("request_hash", String(43), nullable=False),
    Column("created_at", DateTime(timezone=True), nullable=False),
    Column("started_at", DateTime(timezone=True), nullable=True),
    Column("finished_at", DateTime(timezone=True), nullable=True),
    Index("ix_batches_state", "state"),
)

# One row a run: a point of the sweep under one strategy. `changes` are the values of the batch's `fields` there.
batch_runs = Table(
    "batch_runs",
    metadata,
    Column("batch_id", String(22), ForeignKey("batches.id"), primary_key=True),
    Column("position", Integer, primary_key=True),
    Column("changes", Text, nullable=False),
    Column("strategy", String(64), nullable=False),
    Column("status", String(16), nullable=False),
    Column("result_key", String(43), nullable=True),
    Column("reason", Text, nullable=True),
    Index("ix_batch_runs_batch_id_result_key", "batch_id", "result_key"),
)

batch_events = Table(
    "batch_events",
    metadata,
    Column("batch_id", String(22), ForeignKey("batches.id"), primary_key=True),
    Column("number", Integer, primary_key=True),
    Column("kind", String(16), nullable=False),
    Column("data", Text, nullable=False),
)

links = Table(
    "links",
    metadata,
    Column("slug", String(22), primary_key=True),
    Column("kind", String(8), nullable=False),
    Column("run_id", String(22), ForeignKey("runs.id"), nullable=True),
    Column("batch_id", String(22), ForeignKey("batches.id"), nullable=True),
    Column("view", Text, nullable=False),
    Column("created_at", DateTime(timezone=True), nullable=False),
)

pinned_series = Table(
    "pinned_series",
    metadata,
    Column("result_key", String(43), ForeignKey("results.key"), primary_key=True),
    Column("content", LargeBinary, nullable=False),
    Column("created_at", DateTime(timezone=True), nullable=False),
)

tunings = Table(
    "tunings",
    metadata,
    Column("id", String(22), primary_key=True),
    Column("state", String(16), nullable=False),
    Column("reason", Text, nullable=True),
    Column("step", String(16), nullable=False),
    Column("attempt", Integer, nullable=False),
    Column("core_version", String(32), nullable=False),
    Column("schema_version", Integer, nullable=False),
    Column("request", Text, nullable=False),
    Column("estimated_cost", Float, nullable=False),
    Column("total", Integer, nullable=False),
    Column("done", Integer, nullable=False),
    Column("failed", Integer, nullable=False),
    Column("feasible", Integer, nullable=False),
    Column("generation", Integer, nullable=False),
    Column("batch_id", String(22), ForeignKey("batches.id"), nullable=True),
    Column("comparison", Text, nullable=True),
    Column("idempotency_key", String(255), nullable=True, unique=True),
    Column("request_hash", String(43), nullable=False),
    Column("created_at", DateTime(timezone=True), nullable=False),
    Column("started_at", DateTime(timezone=True), nullable=True),
    Column("finished_at", DateTime(timezone=True), nullable=True),
    Index("ix_tunings_state", "state"),
)

# Only of complete generations: what a crash interrupts is asked for and run again, to the same trials.
tuning_trials = Table(
    "tuning_trials",
    metadata,
    Column("tuning_id", String(22), ForeignKey("tunings.id"), primary_key=True),
    Column("number", Integer, primary_key=True),
    Column("generation", Integer, nullable=False),
    Column("weights", Text, nullable=False),
    Column("status", String(16), nullable=False),
    Column("reason", Text, nullable=True),
    Column("feasible", Boolean, nullable=False),
    Column("objectives", Text, nullable=True),
    Column("limits", Text, nullable=True),
)

tuning_events = Table(
    "tuning_events",
    metadata,
    Column("tuning_id", String(22), ForeignKey("tunings.id"), primary_key=True),
    Column("number", Integer, primary_key=True),
    Column("kind", String(16), nullable=False),
    Column("data", Text, nullable=False),
)
