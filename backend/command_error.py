"""What ends a start or a command with a sentence."""


class CommandError(Exception):
    """Something is wrong that whoever runs the service can mend; the message says what."""
