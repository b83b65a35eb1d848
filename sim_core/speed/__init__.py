"""How the car is driven along the road: speed plan, brakes, fuzzy controller, driving stages."""
