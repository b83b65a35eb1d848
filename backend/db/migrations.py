"""The schema: a new database has that of `tables`; steps bring one of 0.4.0, which is the oldest that opens, to it.

A step is for good: it does not change with the tables of later versions.
"""

from sqlalchemy import Connection, text

from backend.db.tables import metadata, schema_version


def _owners(thing: str) -> tuple[str, str]:
    """Return what makes the table of who sent a road or a recording."""
    columns = f"{thing}_id VARCHAR(22) NOT NULL, owner VARCHAR(64) NOT NULL"
    primary = f"CONSTRAINT pk_{thing}_owners PRIMARY KEY ({thing}_id, owner)"
    foreign = f"CONSTRAINT fk_{thing}_owners_{thing}_id FOREIGN KEY ({thing}_id) REFERENCES {thing}s (id)"
    return (
        f"CREATE TABLE {thing}_owners ({columns}, {primary}, {foreign} ON DELETE CASCADE)",
        f"CREATE INDEX ix_{thing}_owners_owner ON {thing}_owners (owner)",
    )


BASELINE = "0013"  # of 0.4.0
# By revision its statements, and those that only PostgreSQL needs. Until 0.4.0 every failure was stored, also one that
# the machine was to blame for; those have no kind, and are computed again once they are asked for.
STEPS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "0014": (
        (
            "UPDATE results SET status = 'expired', summary = '{\"failed\"\\:true}', compute_ms = 0, "
            "checksum = 'unchecked' WHERE status = 'failed' AND summary NOT LIKE '%\"kind\"\\:%'",
            "ALTER TABLE links ADD COLUMN owner VARCHAR(64)",
            "ALTER TABLE links ADD COLUMN revoked_at {time}",
            "ALTER TABLE links ADD COLUMN pin_of VARCHAR(22)",
            "CREATE INDEX ix_links_pin_of ON links (pin_of)",
            "CREATE INDEX ix_links_created_at ON links (created_at)",
            "CREATE INDEX ix_links_owner_created_at ON links (owner, created_at)",
            *_owners("road"),
            *_owners("recording"),
            "ALTER TABLE jobs DROP COLUMN checksum",
            "ALTER TABLE job_runs DROP COLUMN checksum",
            "ALTER TABLE trials DROP COLUMN checksum",
        ),
        tuple(
            f"ALTER TABLE {table} ALTER COLUMN checksum DROP DEFAULT"
            for table in ("results", "pinned_series", "runs", "links", "roads", "recordings")
        ),
    ),
}
REVISIONS = (BASELINE, *STEPS)


def create(connection: Connection) -> None:
    """Make the tables of an empty database."""
    metadata.create_all(connection, checkfirst=False)
    connection.execute(schema_version.insert().values(version_num=REVISIONS[-1]))


def upgrade(connection: Connection, stored: str) -> None:
    """Take the steps that follow the stored revision."""
    for revision in REVISIONS[REVISIONS.index(stored) + 1 :]:
        for_all, for_servers = STEPS[revision]
        is_server = connection.dialect.name == "postgresql"
        time = "TIMESTAMP WITH TIME ZONE" if is_server else "DATETIME"
        for statement in for_all + (for_servers if is_server else ()):
            connection.execute(text(statement.replace("{time}", time)))
        connection.execute(schema_version.update().values(version_num=revision))
