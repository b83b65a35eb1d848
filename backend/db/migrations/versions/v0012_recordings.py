"""Recorded drives, and the runs that show them."""

from alembic import op
from sqlalchemy import ForeignKey, Integer, LargeBinary, String

from backend.db.migrations.columns import key, optional, required
from backend.db.types import Utc

revision = "0012"
down_revision = "0011"


def upgrade() -> None:
    """Apply this step."""
    columns = required(samples=Integer(), signals=String(255), content=LargeBinary(), created_at=Utc())
    op.create_table("recordings", key("id", 22), *columns, *optional(checksum=String(16)))
    op.create_table(
        "run_recordings", key("run_id", 22, ForeignKey("runs.id")), key("recording_id", 22, ForeignKey("recordings.id"))
    )
    op.create_index("ix_recordings_created_at", "recordings", ["created_at"])
    op.create_index("ix_run_recordings_recording_id", "run_recordings", ["recording_id"])
