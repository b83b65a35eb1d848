"""What a method of the core returns while something is driven."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any
from unittest.mock import patch


@contextmanager
def returned(kind: type, method: str) -> Iterator[list[tuple[Any, Any]]]:
    """Each object that it was called of, and what it returned."""
    own, calls = getattr(kind, method), list[tuple[Any, Any]]()

    def called(this: Any, *arguments: Any) -> Any:
        calls.append((this, own(this, *arguments)))
        return calls[-1][1]

    with patch.object(kind, method, called):
        yield calls
