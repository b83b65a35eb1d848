"""The shapes of the paper page's answers."""

from typing import Annotated, Literal

from pydantic import Field

from backend.json_types import JsonObject
from backend.models import Answer
from backend.paper.claims import AGREEMENT, HIL_TOLERANCE
from sim_core.scenario import Scenario

Verdict = Literal["reached", "smaller", "contradicts", "unavailable", "pending"]
ConfidenceInterval = Annotated[list[float], Field(min_length=2, max_length=2, description="95 % interval [%]")]


class Counts(Answer):
    """The number of cells with each verdict."""

    reached: int
    smaller: int
    contradicts: int


class Part(Answer):
    """A part of the cells."""

    reached: int
    total: int = Field(description="Cells with a verdict")


class Agreement(Answer):
    """The simulated changes that are close to the paper's; for a misprint, to what follows from its absolutes."""

    cells: int
    within: int = Field(description=f"Within ±{AGREEMENT:g} percentage points of the paper's change")
    in_interval: int = Field(description="The paper's change lies in our 95 % interval")


class Counted(Answer):
    """The counts of verdicts under some readings."""

    reached: int
    total: int = Field(description="Cells with a verdict")
    counts: Counts
    simulated: Part = Field(description="The changes we simulate")
    ecu: Part = Field(description=f"Hardware in the loop, by our rule of ±{HIL_TOLERANCE:g} %")
    agreement: Agreement


class Misprint(Answer):
    """A printed change that does not follow from the absolutes printed beside it [%]."""

    printed: float
    follows: float


class Unavailable(Answer):
    """Hardware in the loop cannot be driven here: its cells have no verdict and no part in any count."""

    cells: int
    reason: str = Field(description="What is missing, and what brings it")


class Judgement(Answer):
    """Our change [%] and what the paper's comes to; all but the verdict is null where the cell is unavailable."""

    our_change: float | None
    ci: ConfidenceInterval | None = Field(description="95 % interval [%]")
    verdict: Verdict
    certain: bool | None = Field(description="The whole interval would get that verdict")


class Cell(Judgement):
    """One printed change, and ours; absolutes in SI."""

    table: int
    window: str
    signal: str
    statistic: str
    strategy: str
    against: str
    paper_value: float
    paper_base: float
    paper_change: float = Field(description="As printed [%]")
    misprint: Misprint | None = Field(description="The verdict is then taken against `follows`")
    our_value: float | None = Field(description="Null where the cell is unavailable")
    our_base: float | None = Field(description="Null while pending")
    our_factor: float = Field(description="By which ours were multiplied: 2 for doubled tyre loads, else 1")
    without_preview: Judgement | None = Field(description="Where a controller that looks ahead takes part")


class WithoutPreview(Answer):
    """The counts of verdicts without preview."""

    reached: int
    counts: Counts


class OurAbsolute(Answer):
    """Our value over the roads; SI."""

    value: float = Field(description="Mean over the roads, times `factor`")
    spread: float = Field(description="Standard deviation of one road, times `factor`")
    factor: float = Field(description="2 where the interpretation doubles tyre loads, which has no explanation; else 1")


class AbsoluteRow(Answer):
    """A printed absolute and ours; SI. Ours is null while pending, or where the cell is unavailable."""

    window: str
    statistic: str
    signal: str
    strategy: str
    printed: float
    default: OurAbsolute | None
    nearest: OurAbsolute | None


class Distance(Answer):
    """The factor, either way, between our absolutes and the printed ones."""

    values: int = Field(description="How many")
    median: float
    mean: float = Field(description="The geometric one")


class Distances(Answer):
    """The distances of an interpretation; null while values are pending."""

    interpretation: str = Field(description="Its id")
    uncontrolled: Distance | None = Field(description="Of the passive car and of speed control alone")
    simulated: Distance | None = Field(description="Of all but hardware in the loop")


class Absolutes(Answer):
    """The absolutes that the paper prints beside the changes."""

    rows: list[AbsoluteRow]
    distances: list[Distances]


class ReadingChoice(Answer):
    """One choice of a reading."""

    id: str
    label: str
    default: bool
    source: str = Field(description="The sentence or equation of the paper that has it, or `ours`")


class ReadingAnswer(Answer):
    """A question that the paper leaves open, and the choice made."""

    id: str
    title: str
    description: str
    chosen: str
    choices: list[ReadingChoice]


class Column(Answer):
    """Who is compared with whom."""

    strategy: str
    against: str


class TableAnswer(Answer):
    """One table of the paper."""

    number: int
    title: str
    columns: list[Column]


class Erratum(Answer):
    """A misprint or gap of the paper, and what is used here; both in Markdown."""

    place: str
    printed: str
    here: str


class Interpretation(Counted):
    """A named set of readings, and the counts of verdicts under it, on the same roads."""

    id: str
    title: str
    description: str
    choices: dict[str, str] = Field(description="Reading: choice, all of them")
    changes: JsonObject = Field(description="The scenario's fields it changes, by dotted name")


class Progress(Answer):
    """The number of runs behind the cells that are stored."""

    done: int
    total: int


class PaperAnswer(Counted):
    """The paper's changes against ours."""

    core_version: str
    seeds: int
    first_seed: int
    interpretation: str | None = Field(description="The named set whose readings these are; null where none has them")
    interpretations: list[Interpretation] = Field(description="The named sets")
    unavailable: Unavailable | None
    complete: bool = Field(description="False in a partial answer whose other cells are being computed: ask again")
    progress: Progress
    without_preview: WithoutPreview
    scenario: Scenario
    cells: list[Cell]
    absolutes: Absolutes
    readings: list[ReadingAnswer]
    rules: dict[str, str]
    tables: list[TableAnswer]
    errata: list[Erratum]


class ReadingRow(Answer):
    """The effect of one switch, all others as they are by default."""

    reading: str
    choice: str
    reached: int
    total: int = Field(description="Cells with a verdict")
    counts: Counts
    changed: int = Field(description="Cells whose verdict is another than by default")


class ReadingsAnswer(Answer):
    """Every switch by itself; `complete` is false while rows are still being computed: ask again."""

    rows: list[ReadingRow]
    complete: bool
    unavailable: Unavailable | None


class OfFigure(Answer):
    """What is said of one of the paper's eight figures."""

    window: str
    signal: str
    statistic: str


class Comfort(Answer):
    """Mean over the seeds and its interval."""

    value: float
    low: float
    high: float


class Figure8(Comfort, OfFigure):
    """One of the eight figures of a combination, mean over the seeds and its interval; SI."""

    change_vs_passive: float = Field(description="[%]")


class CombinationRow(Answer):
    """One combination of controller, speed, preview and weights."""

    id: str
    label: str
    controller: Literal["passive", "lqr", "mpc"]
    speed: Literal["constant", "planned"]
    preview: Literal["none", "wheelbase", "lookahead"] | None
    weights: Literal["equal", "comfort", "switched"] | None
    same_as: str | None = Field(alias="is", description="The paper's strategy it is")
    travel_time: float = Field(description="[s]")
    metrics: list[Figure8]
    comfort: dict[str, Comfort]


class Share(OfFigure):
    """Shares of LV's whole change in one figure [%], which add up to 100, and that change [%]."""

    speed: float
    preview: float
    switching: float
    total_change: float


class Change(OfFigure):
    """Change of one combination against another [%]."""

    our_change: float
    ci: ConfidenceInterval


class EqualSpeed(Answer):
    """Two combinations with the same speed plan."""

    label: str
    strategy: str
    against: str
    cells: list[Change]


class AttributionAnswer(Answer):
    """The contribution of each part."""

    core_version: str
    seeds: int
    first_seed: int
    rows: list[CombinationRow]
    shares: list[Share]
    sentences: list[str]
    equal_speed: list[EqualSpeed]


class PaperFigure(Answer):
    """One of the paper's figures, drawn from our runs."""

    number: int
    title: str
    caption: str
    figure: JsonObject = Field(description="Plotly: data and layout")


class PaperFigures(Answer):
    """Figures 3-6, 8, 10-17 and 19-22."""

    figures: list[PaperFigure]
