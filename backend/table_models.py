"""The shape of what is understood of a table of measurements; sent back, it decides how the file is read."""

from typing import Literal

from pydantic import Field

from backend.models import Answer


class TableColumn(Answer):
    """One column of a table."""

    index: int = Field(description="Its place, the first being 0")
    title: str = Field(description="In the file")
    means: str | None = Field(
        description="In a road `distance`, `height`, `left` or `right`, in a drive a signal; null: left out"
    )
    unit: str = Field(description="Of its values; `clock` of times such as 10:00:00.5, empty where none is known")
    sure: bool = Field(description="Whether both can be read off the file")
    direction: Literal["up", "down"] = Field(description="Of a vertical acceleration: which way is positive")
    likely: str | None = Field(description="What a column that is left out may mean")


class TableClock(Answer):
    """What says where or when a row is: a column, or a constant step."""

    column: int | None = Field(description="The place of the column of time or distance")
    rate: float | None = Field(description="Rows in a second, where a drive has no such column [Hz]")
    spacing: float | None = Field(description="Between two heights, where a road has no such column [m]")


class TableQuestion(Answer):
    """What has to be answered before a table can be read."""

    field: str = Field(description="The place of the answer in the table, as a JSON pointer")
    text: str = Field(description="The question")
    choices: list[str] = Field(description="Possible answers; empty where any number may be one")
    guess: str | float | None = Field(description="The likeliest answer")


class TableAnswer(Answer):
    """A table as it was understood; the same as the parameter `table`, corrected or not, decides how it is read."""

    kind: Literal["road", "drive"] = Field(description="What it is of")
    separator: str = Field(description="Between cells; a blank is any number of blanks and tabs")
    decimal: Literal[".", ","] = Field(description="Before a fraction")
    encoding: str = Field(description="Of the text; `xlsx` of a spreadsheet")
    sheet: str | None = Field(description="Of a spreadsheet")
    titles_line: int | None = Field(description="The line of the titles, the first being 1")
    units_line: int | None = Field(description="That of a row of units")
    first_row: int = Field(description="That of the first values")
    columns: list[TableColumn] = Field(description="All of the file's, in order")
    clock: TableClock = Field(description="What says where or when a row is")
    questions: list[TableQuestion] = Field(description="Without any it is read as it stands here")
    notes: list[str] = Field(description="What is done to it")
    preview: list[list[str]] = Field(description="The first rows as they stand in the file")
    bridge: float | None = Field(description="The longest gap that a straight line bridges [m]; null: as said in notes")
    from_: float | None = Field(alias="from", description="Where the part begins that is taken [m, s]; null: the start")
    to: float | None = Field(description="Where it ends")


class TableCurve(Answer):
    """What comes of a table, to look at."""

    along: str = Field(description="`distance`, `time` or `position`")
    x: list[float] = Field(description="Of each point, in the SI unit of `along`")
    signals: list[str] = Field(description="The heights, or one signal")
    values: list[list[float | None]] = Field(description="Of each, in SI units")


class DescribedTable(Answer):
    """The answer of a dry run."""

    table: TableAnswer = Field(description="How the file would be read")
    curve: TableCurve | None = Field(description="What comes of it, with the guesses; null where nothing does")
