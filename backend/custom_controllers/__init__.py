"""Controllers of one's own in the service: found, described and driven, each file in a process of its own.

No process of the service or of its workers runs anybody's file. A `host` does: it loads one file, describes its
controllers and drives them. Everywhere else a stand-in with the same fields takes a controller's place
(`description`), so that what is asked of a strategy is asked of it alike. What drives a strategy calls `isolated`.
"""

from backend.custom_controllers.registry import (
    adopt,
    controller_sources,
    descriptions,
    faults,
    is_own,
    isolated,
    origin,
    source,
)

__all__ = [
    "adopt",
    "controller_sources",
    "descriptions",
    "faults",
    "is_own",
    "isolated",
    "origin",
    "source",
]
