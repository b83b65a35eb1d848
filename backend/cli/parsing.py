"""How a command reads its words."""

import re
from typing import Any

from typer.core import TyperCommand

_ID = re.compile(r"-[A-Za-z0-9_-]{21}")
_LONG_OPTION = re.compile(r"--[a-z-]+")


class Command(TyperCommand):
    """A command that takes an id for an id, though one in 64 of those given out earlier begins with `-`."""

    def make_parser(self, ctx: Any) -> Any:
        """The parser of the command's options, which leaves ids among the arguments, in their place."""
        parser: Any = super().make_parser(ctx)
        read_option = parser._process_opts  # where it would say that there is no such option

        def read(word: str, state: Any) -> None:
            if _ID.fullmatch(word) and not _LONG_OPTION.fullmatch(word):
                state.largs.append(word)
            else:
                read_option(word, state)

        parser._process_opts = read
        return parser
