"""Unknown names in a request: which one, where, and which known names are similar. Nothing of HTTP.

What was sent is repeated only where it looks like a name, so that an error never carries anything else.
"""

import itertools
import re
from collections.abc import Sequence
from difflib import get_close_matches

_MANY = 24  # names that nobody reads through
_NAME = re.compile(r"[A-Za-z0-9_.]{1,80}")

Path = Sequence[str | int]


def is_name(text: str | int) -> bool:
    """Check whether it looks like a name: letters, digits, `_` and `.`, at most 80."""
    return _NAME.fullmatch(str(text)) is not None


def shown_path(path: Path) -> list[str | int]:
    """A path into a request for an error: up to the first step that is no plain name."""
    return list(itertools.takewhile(lambda step: isinstance(step, int) or is_name(step), path))


def pointer(path: Path) -> str:
    """JSON pointer (RFC 6901) into the request body."""
    return "".join("/" + str(step).replace("~", "~0").replace("/", "~1") for step in path)


def unknown_name(what: str, name: str | int, offered: Sequence[str]) -> str:
    """Such as `Unknown field hight, perhaps height; there are shape, height, width`.

    Of many names only those like it are said, where there are such: dotted names that end with it come first. A dotted
    name below one that is offered is said to be nested.
    """
    message = f"Unknown {what} {name}" if is_name(name) else f"Unknown {what}"
    first, *rest = str(name).split(".")
    if what == "field" and rest and first in offered and is_name(name):
        nested = ": {".join(f'"{each}"' for each in (first, *rest))
        return f"{message}: write it as {{{nested}: ...{'}' * (1 + len(rest))}"
    same_end = [each for each in offered if each.endswith(f".{name}")]
    similar = (same_end or get_close_matches(str(name), offered)) if is_name(name) else []
    perhaps = f", perhaps {' or '.join(similar)}" if similar else ""
    if similar and len(offered) > _MANY:
        return message + perhaps
    return f"{message}{perhaps}; there are {', '.join(offered) or 'none'}"
