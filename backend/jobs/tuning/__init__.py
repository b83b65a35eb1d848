"""Tunings: search a strategy's weights, a generation of trials after the other, each generation a sweep."""
