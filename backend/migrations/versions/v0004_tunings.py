"""Tunings, their trials and the events that tell how they get on."""

import sqlalchemy as sa
from alembic import op

revision = "0004"
down_revision = "0003"


def upgrade() -> None:
    """Apply this step."""
    op.create_table(
        "tunings",
        sa.Column("id", sa.String(22), nullable=False),
        sa.Column("state", sa.String(16), nullable=False),
        sa.Column("reason", sa.Text(), nullable=True),
        sa.Column("step", sa.String(16), nullable=False),
        sa.Column("attempt", sa.Integer(), nullable=False),
        sa.Column("core_version", sa.String(32), nullable=False),
        sa.Column("schema_version", sa.Integer(), nullable=False),
        sa.Column("request", sa.Text(), nullable=False),
        sa.Column("estimated_cost", sa.Float(), nullable=False),
        sa.Column("total", sa.Integer(), nullable=False),
        sa.Column("done", sa.Integer(), nullable=False),
        sa.Column("failed", sa.Integer(), nullable=False),
        sa.Column("feasible", sa.Integer(), nullable=False),
        sa.Column("generation", sa.Integer(), nullable=False),
        sa.Column("batch_id", sa.String(22), nullable=True),
        sa.Column("comparison", sa.Text(), nullable=True),
        sa.Column("idempotency_key", sa.String(255), nullable=True),
        sa.Column("request_hash", sa.String(43), nullable=False),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.Column("started_at", sa.DateTime(timezone=True), nullable=True),
        sa.Column("finished_at", sa.DateTime(timezone=True), nullable=True),
        sa.ForeignKeyConstraint(["batch_id"], ["batches.id"], name="fk_tunings_batch_id"),
        sa.PrimaryKeyConstraint("id", name="pk_tunings"),
        sa.UniqueConstraint("idempotency_key", name="uq_tunings_idempotency_key"),
    )
    op.create_index("ix_tunings_state", "tunings", ["state"])
    op.create_table(
        "tuning_trials",
        sa.Column("tuning_id", sa.String(22), nullable=False),
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("generation", sa.Integer(), nullable=False),
        sa.Column("weights", sa.Text(), nullable=False),
        sa.Column("status", sa.String(16), nullable=False),
        sa.Column("reason", sa.Text(), nullable=True),
        sa.Column("feasible", sa.Boolean(), nullable=False),
        sa.Column("objectives", sa.Text(), nullable=True),
        sa.Column("limits", sa.Text(), nullable=True),
        sa.ForeignKeyConstraint(["tuning_id"], ["tunings.id"], name="fk_tuning_trials_tuning_id"),
        sa.PrimaryKeyConstraint("tuning_id", "number", name="pk_tuning_trials"),
    )
    op.create_table(
        "tuning_events",
        sa.Column("tuning_id", sa.String(22), nullable=False),
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("kind", sa.String(16), nullable=False),
        sa.Column("data", sa.Text(), nullable=False),
        sa.ForeignKeyConstraint(["tuning_id"], ["tunings.id"], name="fk_tuning_events_tuning_id"),
        sa.PrimaryKeyConstraint("tuning_id", "number", name="pk_tuning_events"),
    )


def downgrade() -> None:
    """Take this step back."""
    op.drop_table("tuning_events")
    op.drop_table("tuning_trials")
    op.drop_table("tunings")
