"""How a command parses its arguments: ids that begin with `-` are no options."""

import re
from typing import Any

from typer.core import TyperCommand

_ID = re.compile(r"-[A-Za-z0-9_-]{21}")
_LONG_OPTION = re.compile(r"--[a-z-]+")


class Command(TyperCommand):
    """A command with arguments that may be ids: of earlier versions' ids one in 64 begins with `-`."""

    def make_parser(self, ctx: Any) -> Any:
        """The parser of the command's options, which takes ids as arguments."""
        parser: Any = super().make_parser(ctx)
        read_option = parser._process_opts  # raises "No such option"

        def read(word: str, state: Any) -> None:
            if _ID.fullmatch(word) and not _LONG_OPTION.fullmatch(word):
                state.largs.append(word)
            else:
                read_option(word, state)

        parser._process_opts = read
        return parser
