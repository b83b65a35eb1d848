"""Text on one line as people see it: without control characters, which begin a new cell or formula in a table."""

import re
from typing import Annotated

from pydantic import AfterValidator, Field
from pydantic_core import PydanticCustomError

# Control characters, separators of lines, and what turns the direction of writing around.
PATTERN = r"^[^\u0000-\u001f\u007f-\u009f\u2028-\u202e\u2066-\u2069]*$"
MESSAGE = "Control characters, such as tabs and line breaks, cannot be part of this"
_PLAIN = re.compile(PATTERN.removeprefix("^").removesuffix("$"))


def is_plain(text: str) -> bool:
    """Check whether it has none of these characters."""
    return _PLAIN.fullmatch(text) is not None


def _check(text: str) -> str:
    if not is_plain(text):
        raise PydanticCustomError("control_characters", MESSAGE)
    return text


PlainText = Annotated[str, AfterValidator(_check), Field(json_schema_extra={"pattern": PATTERN})]
