"""Warm worker processes, replaced when they die or grow, ended when nobody waits for them."""
