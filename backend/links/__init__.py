"""Share links: what they show, and their preview in a chat program."""
