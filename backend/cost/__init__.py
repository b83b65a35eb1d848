"""What a run costs, before it is driven, and whether it is more than one run may cost."""
