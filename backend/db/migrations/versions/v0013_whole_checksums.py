"""Every row has a checksum, or says that it is of a version without them; that of a job covers more of it.

A job's covers its kind, parent, reason and core version too. The checksum of a damaged job stays wrong.
"""

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
TABLES = ("results", "pinned_series", "runs", "links", "roads", "recordings", "jobs", "job_runs", "trials")
UNCHECKED = "unchecked"


def upgrade() -> None:
    """Apply this step."""
    names = {*NOW, LAST, "checksum"}
    jobs = table(
        "jobs", *(column(name, Json) if name in ("request", "sweep", "answer") else column(name) for name in names)
    )
    connection = op.get_bind()
    for name in TABLES:
        if connection.dialect.name == "postgresql":  # for replicas of 0.3.0, which know no checksums
            op.alter_column(name, "checksum", server_default=UNCHECKED)
        each = table(name, column("checksum"))
        connection.execute(update(each).where(each.c.checksum.is_(None)).values(checksum=UNCHECKED))
    for job_id in connection.execute(select(jobs.c.id).where(jobs.c.checksum != UNCHECKED)).scalars().all():
        try:
            row = connection.execute(select(jobs).where(jobs.c.id == job_id)).one()._mapping
        except (DamagedError, ValueError):  # JSON or text that is none
            continue
        if row["checksum"] == digest_of(row[name] for name in (*BEFORE, LAST)):
            new = digest_of(row[name] for name in (*NOW, LAST))
            connection.execute(update(jobs).where(jobs.c.id == job_id).values(checksum=new))
