"""Alembic's environment: `Store.migrate` hands over a connection that is already inside a transaction."""

from alembic import context

from backend.db.tables import metadata

context.configure(connection=context.config.attributes["connection"], target_metadata=metadata, transactional_ddl=True)
context.run_migrations()
