"""A typed client of a Ridelab service: `with Ridelab(url) as ridelab: ridelab.run({}, ["lv"])`.

It needs httpx alone; NumPy is imported when time histories are asked for. docs/api.md shows it at work.
"""

from backend.client.answers import Interval, Link, LinkedResult, Outcome, RunResult, Stage, Statistics
from backend.client.batch import Batch
from backend.client.errors import ErrorPlace, RidelabAPIError, RidelabClientError, RidelabConnectionError
from backend.client.ridelab import Ridelab
from backend.client.tuning import Tuning

__all__ = [
    "Batch",
    "ErrorPlace",
    "Interval",
    "Link",
    "LinkedResult",
    "Outcome",
    "Ridelab",
    "RidelabAPIError",
    "RidelabClientError",
    "RidelabConnectionError",
    "RunResult",
    "Stage",
    "Statistics",
    "Tuning",
]
