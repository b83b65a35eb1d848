"""Links and the time histories they pin."""

import sqlalchemy as sa
from alembic import op

revision = "0003"
down_revision = "0002"


def upgrade() -> None:
    """Apply this step."""
    op.create_table(
        "links",
        sa.Column("slug", sa.String(22), nullable=False),
        sa.Column("kind", sa.String(8), nullable=False),
        sa.Column("run_id", sa.String(22), nullable=True),
        sa.Column("batch_id", sa.String(22), nullable=True),
        sa.Column("view", sa.Text(), nullable=False),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.ForeignKeyConstraint(["run_id"], ["runs.id"], name="fk_links_run_id"),
        sa.ForeignKeyConstraint(["batch_id"], ["batches.id"], name="fk_links_batch_id"),
        sa.PrimaryKeyConstraint("slug", name="pk_links"),
    )
    op.create_table(
        "pinned_series",
        sa.Column("result_key", sa.String(43), nullable=False),
        sa.Column("content", sa.LargeBinary(), nullable=False),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
        sa.ForeignKeyConstraint(["result_key"], ["results.key"], name="fk_pinned_series_result_key"),
        sa.PrimaryKeyConstraint("result_key", name="pk_pinned_series"),
    )


def downgrade() -> None:
    """Take this step back."""
    op.drop_table("pinned_series")
    op.drop_table("links")
