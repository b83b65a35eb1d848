"""Standalone HTML reports: one file that says everything about a result and needs nothing else to be read."""
