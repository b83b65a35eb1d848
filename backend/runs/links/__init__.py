"""Share links: what they open, and how a chat program shows them."""
