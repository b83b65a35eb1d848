"""Schema migrations (Alembic), run by the service itself when it starts."""

from pathlib import Path

from sqlalchemy import Connection

REVISIONS = sorted(file.name[1:5] for file in (Path(__file__).parent / "versions").glob("v*.py"))


def upgrade(connection: Connection, revision: str) -> None:
    """Bring the database to that revision, or to `head`, in the connection's transaction."""
    from alembic import command  # a fifteenth of a start: not for one on a database of the newest schema
    from alembic.config import Config

    config = Config()
    config.set_main_option("script_location", "backend.db:migrations")
    config.attributes["connection"] = connection
    command.upgrade(config, revision)
