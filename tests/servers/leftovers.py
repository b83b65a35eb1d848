"""Finds processes that tests started and did not end."""

import os
import time

import psutil

from tests.servers.process import FORK_SERVER, HANG_TIMEOUT

MARK = "STARTED_BY_TESTS_OF"  # in the environment of whatever this process starts
OURS = ("multiprocessing.resource_tracker", FORK_SERVER)  # Python's own; they end with the process that runs the tests


def mark() -> None:
    """Mark this process, so that all that it starts, and all that those start, can be listed."""
    os.environ[MARK] = str(os.getpid())


def left_running() -> list[str]:
    """Processes that do not end by themselves, as pid and command; they are killed."""
    end = time.monotonic() + HANG_TIMEOUT
    while (left := _marked()) and time.monotonic() < end:
        time.sleep(0.1)
    for process in left:
        process.kill()
    return [f"{process.pid}: {command}" for process, command in left.items()]


def _marked() -> dict[psutil.Process, str]:
    commands = {}
    for process in psutil.process_iter():
        try:
            if process.environ().get(MARK) == str(os.getpid()) and process.status() != psutil.STATUS_ZOMBIE:
                command = " ".join(process.cmdline())
                ours = process.ppid() == os.getpid() and any(each in command for each in OURS)
                if not ours and process.pid != os.getpid():
                    commands[process] = command
        except psutil.Error:  # it ended, or is not ours to look at
            continue
    return commands
