"""`python -m ridelab`: the `ridelab` command where it is not on the path."""

import sys

from ridelab.cli import main

if __name__ == "__main__":
    sys.exit(main())
