"""Parameters of lists that are read page by page."""

from typing import Annotated

from fastapi import Query

from backend.store.pages import CURSOR

Limit = Annotated[int, Query(ge=1, le=500, description="At most so many")]
Cursor = Annotated[str | None, Query(pattern=CURSOR, description="`next` of the page before")]
DEFAULT_LIMIT = 50
