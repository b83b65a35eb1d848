"""What retention looks for is found in indexes: a summary, a sweep or a road need not be read for its row's age."""

from alembic import op
from sqlalchemy import text

revision = "0008"
down_revision = "0007"


def upgrade() -> None:
    """Apply this step."""
    unexpired = text("status <> 'expired'")
    op.create_index(
        "ix_results_created_at", "results", ["created_at"], sqlite_where=unexpired, postgresql_where=unexpired
    )
    op.create_index("ix_roads_created_at", "roads", ["created_at"])
    op.drop_index("ix_jobs_parent_id", "jobs")
    op.create_index("ix_jobs_parent_id_finished_at", "jobs", ["parent_id", "finished_at"])
    op.create_index("ix_links_run_id", "links", ["run_id"])
    op.create_index("ix_links_job_id", "links", ["job_id"])
