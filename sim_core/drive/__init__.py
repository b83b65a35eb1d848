"""What a run shares whatever its suspension does: speed plan, driving stages, sampled road, preview."""
