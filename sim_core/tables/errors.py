"""What can be wrong with a table."""

from collections.abc import Mapping
from typing import Any

from sim_core.errors import RidelabError


class TableError(RidelabError):
    r"""The file holds no table of this kind.

    Args:
        message: Why.
        line: Where, the first being 1; None where it is not of one line.

    Example:
        >>> from sim_core import TableError, read_table
        >>> try:
        ...     read_table(b"distance [m],height [mm]\n0,0\n9,high\n12,0\n", "road")
        ... except TableError as error:
        ...     print(error.line, error.message)
        3 A value of “height [mm]” is not a number
    """

    def __init__(self, message: str, line: int | None = None) -> None:
        super().__init__(message)
        self.line = line


class UnsureTableError(TableError):
    r"""The table cannot be read before its questions are answered.

    Args:
        description: What was understood, with the questions, as `Table.description` has it.

    Example:
        >>> from sim_core import UnsureTableError, read_table
        >>> table = read_table(b"distance,height\n0,0\n9,1\n", "road")
        >>> try:
        ...     table.signals
        ... except UnsureTableError as error:
        ...     print(error.message)
        In which unit is “distance”? In which unit is “height”?
    """

    def __init__(self, description: Mapping[str, Any]) -> None:
        super().__init__(" ".join(question["text"] for question in description["questions"]))
        self.args = (description,)
        self.description = description
