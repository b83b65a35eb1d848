"""Sweeps, which the API calls batches: every point under every strategy. A robustness study is a sweep too."""
