"""Measured roads: read from CSV, stored by content, handed to whatever drives them."""
