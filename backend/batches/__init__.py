"""Batches: sweeps are planned, accepted, driven over Dask and read as tables."""
