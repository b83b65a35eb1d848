"""The schema of release 0.2.0, which is where every database begins."""

from typing import Any

from alembic import op
from sqlalchemy import Boolean, Column, DateTime, Float, ForeignKey, Index, Integer, LargeBinary, String, Text

from backend.db.migrations.columns import key, optional, position, required

revision = "0004"
down_revision = None


def upgrade() -> None:
    """Apply this step."""
    op.create_table(
        "results",
        key("key", 43),
        *required(strategy=String(64), core_version=String(32), status=String(16), summary=Text()),
        *required(compute_ms=Float(), created_at=DateTime(timezone=True)),
    )
    op.create_table(
        "runs",
        key("id", 22),
        *required(core_version=String(32), schema_version=Integer(), scenario=Text()),
        *required(created_at=DateTime(timezone=True)),
    )
    op.create_table(
        "run_results",
        key("run_id", 22, ForeignKey("runs.id")),
        position("position"),
        Column("result_key", String(43), ForeignKey("results.key"), nullable=False),
    )
    op.create_index("ix_run_results_result_key", "run_results", ["result_key"])
    op.create_table(
        "batches",
        *_job(scenario=Text(), strategies=Text(), sweep=Text(), fields=Text()),
        Index("ix_batches_state", "state"),
    )
    op.create_table(
        "batch_runs",
        key("batch_id", 22, ForeignKey("batches.id")),
        position("position"),
        *required(changes=Text(), strategy=String(64), status=String(16)),
        *optional(result_key=String(43), reason=Text()),
        Index("ix_batch_runs_batch_id_result_key", "batch_id", "result_key"),
    )
    _events("batch")
    op.create_table(
        "links",
        key("slug", 22),
        *required(kind=String(8)),
        Column("run_id", String(22), ForeignKey("runs.id")),
        Column("batch_id", String(22), ForeignKey("batches.id")),
        *required(view=Text(), created_at=DateTime(timezone=True)),
    )
    op.create_table(
        "pinned_series",
        key("result_key", 43, ForeignKey("results.key")),
        *required(content=LargeBinary(), created_at=DateTime(timezone=True)),
    )
    op.create_table(
        "tunings",
        *_job(step=String(16), attempt=Integer(), request=Text(), feasible=Integer(), generation=Integer()),
        Column("batch_id", String(22), ForeignKey("batches.id")),
        Column("comparison", Text()),
        Index("ix_tunings_state", "state"),
    )
    op.create_table(
        "tuning_trials",
        key("tuning_id", 22, ForeignKey("tunings.id")),
        position("number"),
        *required(generation=Integer(), weights=Text(), status=String(16)),
        Column("reason", Text()),
        *required(feasible=Boolean()),
        *optional(objectives=Text(), limits=Text()),
    )
    _events("tuning")


def _events(kind: str) -> None:
    owner = key(f"{kind}_id", 22, ForeignKey(f"{kind}es.id" if kind == "batch" else f"{kind}s.id"))
    op.create_table(f"{kind}_events", owner, position("number"), *required(kind=String(16), data=Text()))


def _job(**own: Any) -> list[Column[Any]]:
    """What batches and tunings have in common, and what is their own."""
    return [
        key("id", 22),
        *required(state=String(16)),
        Column("reason", Text()),
        *required(core_version=String(32), schema_version=Integer(), **own),
        *required(estimated_cost=Float(), total=Integer(), done=Integer(), failed=Integer()),
        Column("idempotency_key", String(255), unique=True),
        *required(request_hash=String(43), created_at=DateTime(timezone=True)),
        *optional(started_at=DateTime(timezone=True), finished_at=DateTime(timezone=True)),
    ]
