"""The referee's own models: derived from the paper and the textbooks, sharing no line with sim_core."""
