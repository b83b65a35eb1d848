"""The `ridelab` command; docs/reference/cli.md shows each of its commands."""


def main() -> int:
    """Run the command line; returns the exit code (docs/reference/cli.md)."""
    from ridelab.cli.app import run
    from ridelab.cli.reporting import end_on_sigterm

    end_on_sigterm()
    return run()
