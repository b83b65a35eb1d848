"""Errors of the simulation core: one base, a few kinds.

A message names the field, the limit and the valid names; it never repeats a value somebody typed,
because it is shown to whoever asked, over HTTP too.
"""


class RidelabError(Exception):
    """Base of everything the core raises on purpose; its subclasses are in `sim_core.errors`.

    Args:
        message: What is wrong, for a person to read.
        field: Dotted name of the scenario field concerned, if there is one.

    Example:
        >>> from sim_core import RidelabError, Scenario, simulate
        >>> try:
        ...     simulate(Scenario(), "lvv")
        ... except RidelabError as error:
        ...     print(error.message.partition(";")[0])
        Unknown strategy
    """

    def __init__(self, message: str, *, field: str | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.field = field


class UnknownNameError(RidelabError):
    """A strategy, preset, field, signal or metric that does not exist; the message lists those that do."""


class RefusedError(RidelabError):
    """A run that fails alike on every machine: it follows from the scenario and the program alone.

    Whoever stores results may store such a failure as one. Every other error can have passed by the next try: a disk,
    memory, a mount, a compiler or time may have caused it.
    """


class ForceError(RefusedError):
    """A controller did not give two finite numbers.

    Args:
        message: What it gave.
        line: Of its file, where its `force` begins; None where that is no Python function.
    """

    def __init__(self, message: str, *, line: int | None = None) -> None:
        super().__init__(message)
        self.line = line


class UnstableVehicleError(RefusedError):
    """The passive car has no stationary response, so a normalised cost cannot be formed."""


class MissingRoadError(RidelabError):
    """The scenario names a measured road whose heights nobody handed over."""


class TooExpensiveError(RefusedError):
    """The run costs more than one run may, on any machine: it depends on the scenario alone.

    Args:
        message: What there is too much of.
        fields: Dotted names of the fields that make it less.
    """

    def __init__(self, message: str, *, fields: tuple[str, ...] = ()) -> None:
        cheaper = f"; change {' or '.join(fields)}" if fields else ""
        super().__init__(f"{message}{cheaper}", field=fields[0] if fields else None)
        self.fields = fields
