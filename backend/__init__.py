"""Ridelab's web service: stores, computes and shows what `sim_core` simulates."""
