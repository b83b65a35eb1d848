"""The car, linear or not, its actuators and what estimates its state."""
