"""What results mean beside each other, and what to beware of."""
