"""The shapes of what is answered about recorded drives."""

from datetime import datetime

from pydantic import Field

from backend.models import Answer


class RecordedColumn(Answer):
    """A column of a recording's file, and what it is read as."""

    name: str = Field(description="In the file")
    signal: str | None = Field(description="Of the catalogue; null where the column is left out")
    unit: str = Field(description="In the file; empty where its name has none")


class RecordingAnswer(Answer):
    """A recorded drive; `strategy` is what it is called among a run's strategies."""

    id: str = Field(description="Equal signals have equal ids")
    strategy: str = Field(description="`recording:ID`")
    samples: int = Field(description="Of each signal")
    signals: list[str] = Field(description="By the catalogue's names")
    duration: float | None = Field(description="By its own clock; null where it has no time [s]")
    distance: float | None = Field(description="As it was recorded; null where it has none [m]")


class CreatedRecording(RecordingAnswer):
    """A recording that was uploaded."""

    columns: list[RecordedColumn] = Field(description="All of the file's")
    warnings: list[str] = Field(description="What was done to the file, and what may be wrong with it")


class RecordingRow(Answer):
    """A recording in a list."""

    id: str
    strategy: str = Field(description="recording:ID, as runs take it among their strategies")
    samples: int
    signals: list[str] = Field(description="By the catalogue's names")
    created_at: datetime = Field(description="When it was last sent")


class RecordingPage(Answer):
    """The newest recordings."""

    recordings: list[RecordingRow]
    next: str | None = Field(description="Cursor of the next page; null: this is the last one")
