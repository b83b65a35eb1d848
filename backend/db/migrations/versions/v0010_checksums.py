"""What is stored for good carries a checksum; rows of older versions have none and are not checked."""

from alembic import op
from sqlalchemy import String

from backend.db.migrations.columns import optional
from backend.db.types import Utc

revision = "0010"
down_revision = "0009"


def upgrade() -> None:
    """Apply this step."""
    for table in ("results", "pinned_series", "runs", "links", "roads", "jobs", "job_runs", "trials"):
        for column in optional(checksum=String(16)):
            op.add_column(table, column)
    for column in optional(damaged_at=Utc()):
        op.add_column("links", column)
