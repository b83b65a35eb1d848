"""The car and what it drives on: half-car, its stepping, the road."""
