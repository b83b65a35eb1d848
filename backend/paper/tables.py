"""The numbers the paper prints in Tables 4-5 and 7-10 (Meng et al. 2025), and what is misprinted in them.

They are data, tables.toml, in the order of PAPER_SIGNALS; tests hold them against an independent copy.
"""

import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from sim_core.catalogue import PAPER_SIGNALS

Values = tuple[float, ...]  # by PAPER_SIGNALS


@dataclass(frozen=True, slots=True, kw_only=True)
class PaperTable:
    """One comparing table: two pairs (strategy, against) and the changes printed for each [%]."""

    number: int
    title: str
    window: str
    statistic: str
    columns: tuple[tuple[str, str, Values], ...]


_DATA = tomllib.loads(Path(__file__).with_name("tables.toml").read_text(encoding="utf-8"))
TABLES = tuple(PaperTable(**entry) for entry in _DATA["table"])
# (window, statistic) -> strategy -> body acceleration [m/s^2], pitch acceleration [rad/s^2], tyre loads [N]
ABSOLUTES: dict[tuple[str, str], dict[str, Values]] = {
    (window, statistic): rows
    for window, by_statistic in _DATA["absolutes"].items()
    for statistic, rows in by_statistic.items()
}
# (table, strategy, against, signal) -> the change that follows from the absolutes printed beside it [%]
MISPRINTS: dict[tuple[int, str, str, str], float] = {
    (each["table"], each["strategy"], each["against"], each["signal"]): each["follows"] for each in _DATA["misprint"]
}


@dataclass(frozen=True, slots=True, kw_only=True)
class PaperCell:
    """One printed change.

    Attributes:
        table: Its number.
        window: catalogue.WINDOWS key.
        statistic: rms or peak.
        signal: catalogue.SIGNALS key.
        strategy: What is compared.
        against: With what.
        value: The strategy's printed absolute, SI.
        base: The other's, SI.
        printed: The change as printed [%].
        follows: What follows from the absolutes, where the printed one is a misprint [%].
    """

    table: int
    window: str
    statistic: str
    signal: str
    strategy: str
    against: str
    value: float
    base: float
    printed: float
    follows: float | None

    @property
    def claim(self) -> float:
        """The change the paper's own absolutes claim [%]."""
        return self.printed if self.follows is None else self.follows


def cells() -> Iterator[PaperCell]:
    """Every printed change, table by table, column by column."""
    for table in TABLES:
        absolutes = ABSOLUTES[table.window, table.statistic]
        for strategy, against, changes in table.columns:
            for index, signal in enumerate(PAPER_SIGNALS):
                yield PaperCell(
                    table=table.number,
                    window=table.window,
                    statistic=table.statistic,
                    signal=signal,
                    strategy=strategy,
                    against=against,
                    value=absolutes[strategy][index],
                    base=absolutes[against][index],
                    printed=changes[index],
                    follows=MISPRINTS.get((table.number, strategy, against, signal)),
                )
