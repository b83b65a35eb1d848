"""Measured roads keep what their first file amounts to; those of older versions have none."""

from alembic import op

from backend.db.migrations.columns import optional
from backend.db.types import Json

revision = "0011"
down_revision = "0010"


def upgrade() -> None:
    """Apply this step."""
    for column in optional(analysis=Json()):
        op.add_column("roads", column)
