"""Where reports are made: beside the event loop, one at a time."""

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

from backend.runs.reports.page import Report

# One thread: a report is mostly compressing, which leaves the event loop alone; the next one waits.
_thread = ThreadPoolExecutor(1, thread_name_prefix="report")


async def made(make: Callable[[], Report]) -> Report:
    """The report that `make` makes."""
    return await asyncio.get_running_loop().run_in_executor(_thread, make)
