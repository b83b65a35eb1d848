"""`python -m backend.cli.embedded`: a service that ends with the command that started it.

It holds the other end of this process's standard input: however it ends, the input ends with it.
"""

import os
import signal
import sys
import threading


def _end_with_the_command() -> None:
    while os.read(0, 4096):
        pass
    os.kill(os.getpid(), signal.SIGTERM)


if __name__ == "__main__":
    from backend.__main__ import main

    threading.Thread(target=_end_with_the_command, daemon=True).start()
    sys.exit(main(["--port", "0", *sys.argv[1:]]))
