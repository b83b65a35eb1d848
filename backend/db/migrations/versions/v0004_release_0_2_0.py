"""The schema of release 0.2.0, which is where every database begins."""

from typing import Any

from alembic import op
from sqlalchemy import Boolean, Column, DateTime, Float, ForeignKey, Index, Integer, LargeBinary, String, Text
from sqlalchemy.schema import SchemaItem

revision = "0004"
down_revision = None


def upgrade() -> None:
    """Apply this step."""
    _create(
        "results",
        _key("key", 43),
        *_required(strategy=String(64), core_version=String(32), status=String(16), summary=Text()),
        *_required(compute_ms=Float(), created_at=DateTime(timezone=True)),
    )
    _create(
        "runs",
        _key("id", 22),
        *_required(core_version=String(32), schema_version=Integer(), scenario=Text()),
        *_required(created_at=DateTime(timezone=True)),
    )
    _create(
        "run_results",
        _key("run_id", 22, ForeignKey("runs.id")),
        _position("position"),
        Column("result_key", String(43), ForeignKey("results.key"), nullable=False),
    )
    op.create_index("ix_run_results_result_key", "run_results", ["result_key"])
    _create(
        "batches",
        *_job(scenario=Text(), strategies=Text(), sweep=Text(), fields=Text()),
        Index("ix_batches_state", "state"),
    )
    _create(
        "batch_runs",
        _key("batch_id", 22, ForeignKey("batches.id")),
        _position("position"),
        *_required(changes=Text(), strategy=String(64), status=String(16)),
        Column("result_key", String(43)),
        Column("reason", Text()),
        Index("ix_batch_runs_batch_id_result_key", "batch_id", "result_key"),
    )
    _events("batch")
    _create(
        "links",
        _key("slug", 22),
        *_required(kind=String(8)),
        Column("run_id", String(22), ForeignKey("runs.id")),
        Column("batch_id", String(22), ForeignKey("batches.id")),
        *_required(view=Text(), created_at=DateTime(timezone=True)),
    )
    _create(
        "pinned_series",
        _key("result_key", 43, ForeignKey("results.key")),
        *_required(content=LargeBinary(), created_at=DateTime(timezone=True)),
    )
    _create(
        "tunings",
        *_job(step=String(16), attempt=Integer(), request=Text(), feasible=Integer(), generation=Integer()),
        Column("batch_id", String(22), ForeignKey("batches.id")),
        Column("comparison", Text()),
        Index("ix_tunings_state", "state"),
    )
    _create(
        "tuning_trials",
        _key("tuning_id", 22, ForeignKey("tunings.id")),
        _position("number"),
        *_required(generation=Integer(), weights=Text(), status=String(16)),
        Column("reason", Text()),
        *_required(feasible=Boolean()),
        Column("objectives", Text()),
        Column("limits", Text()),
    )
    _events("tuning")


def _create(name: str, *items: SchemaItem) -> None:
    op.create_table(name, *items)


def _events(kind: str) -> None:
    owner = _key(f"{kind}_id", 22, ForeignKey(f"{kind}es.id" if kind == "batch" else f"{kind}s.id"))
    _create(f"{kind}_events", owner, _position("number"), *_required(kind=String(16), data=Text()))


def _job(**own: Any) -> list[Column[Any]]:
    """What batches and tunings have in common, and what is their own."""
    return [
        _key("id", 22),
        *_required(state=String(16)),
        Column("reason", Text()),
        *_required(core_version=String(32), schema_version=Integer(), **own),
        *_required(estimated_cost=Float(), total=Integer(), done=Integer(), failed=Integer()),
        Column("idempotency_key", String(255), unique=True),
        *_required(request_hash=String(43), created_at=DateTime(timezone=True)),
        Column("started_at", DateTime(timezone=True)),
        Column("finished_at", DateTime(timezone=True)),
    ]


def _required(**columns: Any) -> list[Column[Any]]:
    return [Column(name, kind, nullable=False) for name, kind in columns.items()]


def _key(name: str, length: int, *foreign: SchemaItem) -> Column[str]:
    return Column(name, String(length), *foreign, primary_key=True)


def _position(name: str) -> Column[int]:
    return Column(name, Integer(), primary_key=True, autoincrement=False)
