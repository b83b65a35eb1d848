"""Measured roads, and what names them."""

import sqlalchemy as sa
from alembic import op

revision = "0007"
down_revision = "0006"


def upgrade() -> None:
    """Apply this step."""
    op.create_table(
        "roads",
        sa.Column("id", sa.String(22), primary_key=True),
        sa.Column("samples", sa.Integer(), nullable=False),
        sa.Column("content", sa.LargeBinary(), nullable=False),
        sa.Column("created_at", sa.DateTime(timezone=True), nullable=False),
    )
    for user in ("run", "job"):
        op.create_table(
            f"{user}_roads",
            sa.Column(f"{user}_id", sa.String(22), sa.ForeignKey(f"{user}s.id"), primary_key=True),
            sa.Column("road_id", sa.String(22), sa.ForeignKey("roads.id"), nullable=False, primary_key=user == "job"),
        )
        op.create_index(f"ix_{user}_roads_road_id", f"{user}_roads", ["road_id"])
