"""A run: what excites the car, the closed loop, and what it records."""
