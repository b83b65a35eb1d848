"""Runs: what is stored is answered, the rest is computed once; their figures, files, links and reports."""
