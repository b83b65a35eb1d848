"""Pure functions over many results."""
