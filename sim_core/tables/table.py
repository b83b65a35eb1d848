"""`read_table`: a road or a drive out of a file, with what was understood of it and what has to be asked."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from sim_core.arrays import FloatArray
from sim_core.tables import columns, drives, formats, roads, values
from sim_core.tables.columns import Clock, Column, Question
from sim_core.tables.errors import TableError, UnsureTableError
from sim_core.tables.layout import find_layout
from sim_core.tables.text import decoded
from sim_core.tables.titles import KINDS, ROAD

PREVIEW_ROWS = 8
SPREADSHEET = "xlsx"  # in place of an encoding


class _Form(BaseModel):
    model_config = ConfigDict(extra="ignore", populate_by_name=True)


class ColumnForm(_Form):
    """What one column is said to be."""

    title: str | None = None
    means: str | None = None
    unit: str | None = Field(None, max_length=40)
    direction: str | None = Field(None, pattern="^(up|down)$")


class ClockForm(_Form):
    """How far two rows are apart where no column says it."""

    rate: float | None = Field(None, gt=0, le=1e6)
    spacing: float | None = Field(None, gt=0, le=100)


class TableForm(_Form):
    """What is said of a table in place of what is found; whatever is left out is found.

    `columns` are all of the file's, in order, or some of them by title. A description that `read_table` made may be
    sent back as it is, and then its guesses count as answers.
    """

    kind: str | None = Field(None, pattern=f"^({'|'.join(KINDS)})$")
    separator: str | None = Field(None, min_length=1, max_length=1)
    decimal: str | None = Field(None, pattern="^[.,]$")
    encoding: str | None = Field(None, max_length=40)
    sheet: str | None = Field(None, max_length=100)
    titles_line: int | None = Field(None, ge=1)
    columns: list[ColumnForm] | None = Field(None, max_length=1000)
    clock: ClockForm | None = None
    bridge: float | None = Field(None, ge=0, le=50)
    from_: float | None = Field(None, alias="from")
    to: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Table:
    r"""A table as it was understood.

    Attributes:
        kind: `road` or `drive`.
        separator: Between cells; a blank is any number of blanks and tabs.
        decimal: Before a fraction.
        encoding: Of the text; `xlsx` of a spreadsheet.
        titles_line: The line of the titles, the first being 1; None where there is none.
        units_line: That of a row of units.
        first_row: That of the first values.
        columns: All of the file's.
        clock: What says where or when a row is.
        questions: What has to be answered before it can be read; none where everything is sure.
        notes: What was done to it.
        preview: The first rows, as they stand in the file.
        sheet: Of a spreadsheet; None: its only one.
        bridge: The longest gap that is bridged [m, s]; None: as long as it is by itself.
        from_: Where the part begins that is taken [m, s]; None: at the start.
        to: Where it ends.
        guessed: What comes of the guesses, as `signals`; empty where nothing does.

    Example:
        >>> from sim_core import read_table
        >>> table = read_table(b"x [m],z [m]\n0,0\n9,1\n", "road")
        >>> [(column.title, column.means, column.unit) for column in table.columns]
        [('x [m]', 'distance', 'm'), ('z [m]', 'height', 'm')]
    """

    kind: str
    separator: str
    decimal: str
    encoding: str
    titles_line: int | None
    units_line: int | None
    first_row: int
    columns: Sequence[Column]
    clock: Clock
    questions: Sequence[Question]
    notes: Sequence[str]
    preview: Sequence[Sequence[str]]
    sheet: Any = None
    bridge: Any = None
    from_: float | None = None
    to: Any = None
    guessed: Mapping[str, FloatArray] = field(default_factory=dict, repr=False)

    @property
    def signals(self) -> Mapping[str, FloatArray]:
        """By meaning, the values (rows,) in SI units: distance and height, or left and right; or a drive's signals.

        A body acceleration is as it was recorded: what the notes say of gravity is done when it is compared.

        Raises:
            UnsureTableError: There are questions.
        """
        if self.questions:
            raise UnsureTableError(self.description())
        return self.guessed

    def description(self) -> dict[str, Any]:
        """Return what was understood, as JSON has it; sent back as `table`, it decides."""
        shown = {name: getattr(self, name) for name in self.__dataclass_fields__ if name != "_signals"}
        described = {
            name: value for name, value in shown.items() if name not in ("columns", "clock", "questions", "from_")
        }
        return {
            **described,
            "columns": [asdict(each) for each in self.columns],
            "clock": asdict(self.clock),
            "questions": [asdict(each) for each in self.questions],
            "from": self.from_,
        }


def read_table(source: bytes | str | Path, kind: str | None = None, table: Mapping[str, Any] | None = None) -> Table:
    r"""Read a table of a road or a drive: text in a usual layout, ProVAL's ERD, MoTeC's CSV, VBOX's VBO, a spreadsheet.

    What is sure is read; what is not is asked in `questions`, each with a guess; nothing is guessed in silence.

    Args:
        source: The file's content, or its path.
        kind: `road` or `drive`; None finds out.
        table: Corrections in the words of the answer (`Table.description()`); what they say is not asked.

    Raises:
        TableError: There is no such table in it, or a correction is none.

    Example:
        >>> from sim_core import read_table
        >>> table = read_table(b"distance_m;height_mm\n0,0;0\n4,5;12,5\n9,0;3\n", "road")
        >>> table.decimal, table.signals["height"].tolist()
        (',', [0.0, 0.0125, 0.003])
        >>> read_table(b"x,z\n0,0\n4,12\n9,3\n", "road").questions[0].text
        'In which unit is “x”?'
    """
    content = source if isinstance(source, bytes) else Path(source).read_bytes()
    try:
        given = TableForm.model_validate(table or {})
    except ValidationError as error:
        place = "/".join(map(str, error.errors()[0]["loc"]))
        raise TableError(f"table: {place}: {error.errors()[0]['msg']}") from None
    questions: list[Question] = []
    text, encoding = _text(content, given, questions)
    layout = formats.own_layout(text) or find_layout(text, given.separator, given.titles_line)
    decimal = given.decimal or layout.decimal
    if not (given.decimal or layout.decimal_sure):
        asked = "Is the comma in these numbers a decimal comma, or does it stand between thousands?"
        questions.append(Question("/decimal", asked, (",", "."), decimal))
    found_kind = kind or given.kind or (ROAD if layout.step else columns.kind_of(layout, decimal, questions))
    places, clock = columns.understood(layout, decimal, found_kind, given, questions)
    columns.ask_for_missing(found_kind, places, questions)
    notes: list[str] = []
    signals: Mapping[str, FloatArray] = {}
    if columns.are_complete(found_kind, places, clock):
        cells = values.read(text, layout, decimal, places)
        notes += cells.notes
        made = roads.made if found_kind == ROAD else drives.made
        try:
            signals = made(cells, clock, given, questions, notes)
        except TableError:
            if not questions:  # with other answers it may be one
                raise
    guesses = {question.field: question.guess for question in questions}
    return Table(
        kind=found_kind,
        separator=layout.separator,
        decimal=decimal,
        encoding=encoding,
        titles_line=layout.titles_line,
        units_line=layout.units_line,
        first_row=layout.first_row,
        columns=places,
        clock=clock,
        questions=questions,
        notes=[*columns.left_out(places), *notes],
        preview=[list(row) for row in layout.sample[:PREVIEW_ROWS]],
        sheet=given.sheet or guesses.get("/sheet"),
        bridge=guesses.get("/bridge", given.bridge),
        from_=given.from_,
        to=guesses.get("/to", given.to),
        guessed=signals,
    )


def _text(content: bytes, given: TableForm, questions: list[Question]) -> tuple[str, str]:
    if not formats.is_spreadsheet(content):
        return decoded(content, given.encoding)
    text, sheets = formats.spreadsheet_text(content, given.sheet)
    if len(sheets) > 1 and given.sheet is None:
        questions.append(Question("/sheet", "Which sheet is it?", sheets, sheets[0]))
    return text, SPREADSHEET
