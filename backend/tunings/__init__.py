"""Tunings: search a strategy's weights, generation by generation, each generation a sweep."""
