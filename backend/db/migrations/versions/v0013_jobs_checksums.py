"""The checksum of a job covers its kind, parent, reason and core version too; that of a damaged job stays wrong."""

from alembic import op
from sqlalchemy import column, select, table, update

from backend.db.checksum import digest_of
from backend.db.types import Json
from backend.errors import DamagedError

revision = "0013"
down_revision = "0012"

BEFORE = ("id", "label", "owner", "schema_version", "request", "sweep", "answer", "estimated_cost", "total")
NOW = ("id", "kind", "parent_id", "label", "owner", "reason", "core_version", *BEFORE[3:])
LAST = "request_hash"


def upgrade() -> None:
    """Apply this step."""
    names = {*NOW, LAST, "checksum"}
    jobs = table(
        "jobs", *(column(name, Json) if name in ("request", "sweep", "answer") else column(name) for name in names)
    )
    connection = op.get_bind()
    for job_id in connection.execute(select(jobs.c.id).where(jobs.c.checksum.is_not(None))).scalars().all():
        try:
            row = connection.execute(select(jobs).where(jobs.c.id == job_id)).one()._mapping
        except DamagedError:
            continue
        if row["checksum"] == digest_of(row[name] for name in (*BEFORE, LAST)):
            new = digest_of(row[name] for name in (*NOW, LAST))
            connection.execute(update(jobs).where(jobs.c.id == job_id).values(checksum=new))
