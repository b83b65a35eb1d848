"""Runs: stored results are answered, others are computed once; their figures, files, links and reports."""
