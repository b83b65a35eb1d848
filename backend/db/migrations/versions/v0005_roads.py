"""Runs over several roads."""

import sqlalchemy as sa
from alembic import op

revision = "0005"
down_revision = "0004"


def upgrade() -> None:
    """Apply this step."""
    op.add_column("runs", sa.Column("roads", sa.Integer(), nullable=False, server_default="1"))
    op.add_column("runs", sa.Column("baseline", sa.String(64), nullable=True))
