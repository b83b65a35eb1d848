"""Measured roads: read from CSV, stored by content, added to the scenarios that name them."""
