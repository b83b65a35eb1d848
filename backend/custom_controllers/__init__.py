"""Custom controllers in the service: found, described and driven, each file in a process of its own.

No process of the service or of its workers runs anybody's file. A `ControllerProcess` does: it loads one file,
describes its controllers and drives them. Everywhere else a proxy class with the same fields takes a controller's place
(`description`), so that what is asked of a strategy is asked of it alike. What drives a strategy calls
`run_in_sandbox_process`.
"""

from backend.custom_controllers.registry import (
    controller_sources,
    descriptions,
    faults,
    is_custom,
    origin,
    run_in_sandbox_process,
    set_sources,
    source,
)

__all__ = [
    "controller_sources",
    "descriptions",
    "faults",
    "is_custom",
    "origin",
    "run_in_sandbox_process",
    "set_sources",
    "source",
]
