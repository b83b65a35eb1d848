"""Processes that compute: warm, replaced when they die or grow, ended with whoever waits for them."""
