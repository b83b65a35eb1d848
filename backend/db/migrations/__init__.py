"""Schema migrations (Alembic), run by the service itself when it starts."""
