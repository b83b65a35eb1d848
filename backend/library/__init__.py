"""What there is to choose from: fields, presets, vehicles, strategies, signals, figure templates."""
