"""Types of JSON that is passed on unchanged: stored, sent, or from a library."""

from collections.abc import Mapping
from typing import Any

JsonObject = dict[str, Any]
# Three weights, or a curve's points.
NUMBERS_SCHEMA = {
    "type": "array",
    "items": {"anyOf": [{"type": "number"}, {"type": "array", "items": {"type": "number"}}]},
}
Summary = Mapping[str, Any]  # of one strategy's result, as it is stored, perhaps by an older core
