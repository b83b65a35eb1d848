"""Logins of the page that were ended: their cookies are worth nothing on any replica."""

from alembic import op

from backend.db.migrations.columns import key, required
from backend.db.types import Utc

revision = "0009"
down_revision = "0008"


def upgrade() -> None:
    """Apply this step."""
    op.create_table("ended_logins", key("login", 43), *required(ended_at=Utc()))
