"""The database: its tables, connections and threads; the stores write its rows."""
