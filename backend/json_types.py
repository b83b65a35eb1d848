"""Types of JSON that is passed on as it is: stored, sent, or made by a library."""

from collections.abc import Mapping
from typing import Any

JsonObject = dict[str, Any]
Summary = Mapping[str, Any]  # of one strategy's result, as it is stored, perhaps by an older core
