"""The `ridelab` command: serve, run, sweep, compare, open, export. docs/cli.md shows each.

Nothing is imported before it is needed: processes that a service spawns pass through here too.
"""


def main() -> int:
    """Run the command line; returns the exit code (docs/cli.md)."""
    from backend.cli.app import run

    return run()
