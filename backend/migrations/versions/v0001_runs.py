"""Runs and their content-addressed results."""

import sqlalchemy as sa
from alembic import op

revision = "0001"
down_revision = None


def upgrade() -> None:
    """Apply this step."""
    op.create_table(
        "results",
        sa.Column("key", sa.String(43), nullable=False),
        sa.Column("strategy", sa.String(64), nullable=False),
        sa.Column("core_version", sa.String(32), nullable=False),
        sa.Column("status", sa.String(16), nullable=False),
        sa.Column("summary", sa.Text(), nullable=False),
        sa.Column("compute_ms", sa.Float(), nullable=False),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.PrimaryKeyConstraint("key", name="pk_results"),
    )
    op.create_table(
        "runs",
        sa.Column("id", sa.String(22), nullable=False),
        sa.Column("core_version", sa.String(32), nullable=False),
        sa.Column("schema_version", sa.Integer(), nullable=False),
        sa.Column("scenario", sa.Text(), nullable=False),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_runs"),
    )
    op.create_table(
        "run_results",
        sa.Column("run_id", sa.String(22), nullable=False),
        sa.Column("position", sa.Integer(), nullable=False),
        sa.Column("result_key", sa.String(43), nullable=False),
        sa.ForeignKeyConstraint(["run_id"], ["runs.id"], name="fk_run_results_run_id"),
        sa.ForeignKeyConstraint(["result_key"], ["results.key"], name="fk_run_results_result_key"),
        sa.PrimaryKeyConstraint("run_id", "position", name="pk_run_results"),
    )
    op.create_index("ix_run_results_result_key", "run_results", ["result_key"])


def downgrade() -> None:
    """Take this step back."""
    op.drop_table("run_results")
    op.drop_table("runs")
    op.drop_table("results")
