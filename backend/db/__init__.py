"""The database: its tables, connections and threads; what is stored in it is written by the stores."""
