"""A typed client of a Ridelab service: `with Ridelab(url) as ridelab: ridelab.run({}, ["lv"])`.

It needs httpx alone; NumPy and pandas are imported when arrays and frames are asked for.
docs/reference/api.md shows it at work.
"""

from ridelab.client import Ridelab
from ridelab.errors import (
    ErrorPlace,
    JobEndedError,
    JobTimeoutError,
    RidelabAPIError,
    RidelabClientError,
    RidelabConnectionError,
)
from ridelab.jobs import Batch, Job, Tuning
from ridelab.requirements import RequirementResult
from ridelab.results import Interval, Link, LinkedResult, Outcome, RunResult, Solution, Stage, Statistics
from ridelab.streams import Event

__version__ = "0.5.0"  # the core's; a test holds them equal

__all__ = [
    "Batch",
    "ErrorPlace",
    "Event",
    "Interval",
    "Job",
    "JobEndedError",
    "JobTimeoutError",
    "Link",
    "LinkedResult",
    "Outcome",
    "RequirementResult",
    "Ridelab",
    "RidelabAPIError",
    "RidelabClientError",
    "RidelabConnectionError",
    "RunResult",
    "Solution",
    "Stage",
    "Statistics",
    "Tuning",
]
