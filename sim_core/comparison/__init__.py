"""Comparison of several strategies' results."""
