"""`python -m backend.cli`: the `ridelab` command where it is not installed."""

import sys

from backend.cli import main

if __name__ == "__main__":
    sys.exit(main())
