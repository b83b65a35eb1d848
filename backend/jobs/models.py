"""The requests that every kind of job has."""

from typing import Annotated

from pydantic import Field

from backend.models import RequestModel
from backend.plain_text import PlainText

Label = Annotated[PlainText | None, Field(min_length=1, max_length=200, description="A name for it, to find it again")]


class LabelRequest(RequestModel):
    """A job's new label."""

    label: Label = Field(description="null takes its name away")
