"""Runs: stored results are answered, others are computed once; their figures, files, links and reports."""

WARM_UP = "backend.runs.warm_up"  # a worker imports it before its first task
