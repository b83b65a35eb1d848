"""Methods that read a stored run: changes, single instants, time histories, a report."""

import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ridelab.connection import Connection, comma_separated
from ridelab.files import format_of, save, table_in
from ridelab.notebooks import unpacked
from ridelab.results import RunResult, intervals, quoted_id

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class RunMethods(Connection):
    """Methods of `Ridelab` that read a stored run, which is named by itself or by its id."""

    def changes(
        self, run: RunResult | str, *, against: RunResult | str | None = None, baseline: str | None = None
    ) -> dict[str, Any]:
        """Return the changes of a run over several roads, paired road by road; as `changes` of a `RunResult`.

        Changes refer to the run `against`, over the same roads, strategy by strategy, or to the strategy `baseline`.

        Raises:
            RidelabAPIError: They are not of the same roads and core version, or there is no such strategy.
        """
        named = {"against": None if against is None else quoted_id(against), "baseline": baseline}
        answer: dict[str, Any] = self.get(f"/runs/{quoted_id(run)}/changes", named)
        return {strategy: intervals(each) for strategy, each in answer["changes"].items()}

    def instant(
        self, run: RunResult | str, strategy: str, *, position: float | None = None, time: float | None = None
    ) -> dict[str, Any]:
        """Return what a strategy's controller saw and decided at one control step of a stored run.

        Args:
            run: The run, or its id; of one over several roads the first road.
            strategy: Its id.
            position: Of the front axle [m].
            time: In its place [s].

        Raises:
            RidelabAPIError: The run has no such strategy, or the place is not on its drive.
        """
        asked = {"strategy": strategy, "position": position, "time": time}
        answer: dict[str, Any] = self.get(f"/runs/{quoted_id(run)}/instant", asked)
        return answer

    def series(
        self,
        run: RunResult | str,
        strategy: str,
        signals: Sequence[str] | None = None,
        *,
        points: int | None = None,
    ) -> "dict[str, NDArray[np.float32]]":
        """Time histories of one strategy, in SI units: signal -> float32 array, all of one length.

        Args:
            run: The run or its id.
            strategy: Its id.
            signals: Which, always with time and position; None is all.
            points: At most how many samples, see api.md; None is all, with two at each instant at which a held force
                jumps: the values before and after.

        Raises:
            ImportError: NumPy is not installed.
        """
        params = {**_series([strategy], signals, points), "encoding": "base64"}
        return unpacked(self.get(f"/runs/{quoted_id(run)}/series", params)["series"])

    def band(
        self,
        run: RunResult | str,
        strategy: str,
        signals: Sequence[str] | None = None,
        *,
        points: int | None = None,
    ) -> "dict[str, dict[str, NDArray[np.float32]]]":
        """Time histories of one strategy over all roads of a run: its `mean`, `minimum` and `maximum` at each sample.

        Each is signal -> float32 array as of `series`, which also says what the arguments are; `minimum` and `maximum`
        are without signals that are the same on every road, such as time, position and speed.

        Raises:
            ImportError: NumPy is not installed.
            RidelabAPIError: The run is of one road, or of another core version.
        """
        params = {**_series([strategy], signals, points), "encoding": "base64"}
        band = self.get(f"/runs/{quoted_id(run)}/bands", params)["strategies"][strategy]
        return {name: unpacked(part) for name, part in band.items()}

    def series_content(self, run: RunResult | str, file_format: str, **selection: Any) -> Iterator[bytes]:
        """Time histories as the bytes of a `csv`, `parquet` or `json` file, piece by piece.

        `selection` has `strategies`, their ids, and perhaps `signals` and `points` as for `series`.
        """
        address, asked = f"/runs/{quoted_id(run)}/series", _series(**selection)
        return table_in(file_format, lambda kind: self._content(address, {**asked, "format": kind}))

    def download_series(
        self, run: RunResult | str, path: str | os.PathLike[str], *, file_format: str | None = None, **selection: Any
    ) -> Path:
        """Write the file of `series_content`, in the format named, else that of the path's ending.

        Raises:
            ValueError: There is no such format.
            OSError: The file cannot be written.
        """
        return save(self.series_content(run, format_of(path, file_format), **selection), path)

    def differences(
        self, run: RunResult | str, baseline: str | None = None
    ) -> dict[str, dict[str, dict[str, float | None]]]:
        """Return how far every strategy's curves lie from those of `baseline` at the same positions.

        Without a baseline they are against passive, or the first strategy where passive does not run.

        strategy -> signal -> `rms` and `peak` of the difference, `baseline_rms` and `correlation`, in SI units; None
        where they share no part of the road.
        """
        answer: dict[str, Any] = self.get(f"/runs/{quoted_id(run)}/differences", {"baseline": baseline})
        strategies: dict[str, dict[str, dict[str, float | None]]] = answer["strategies"]
        return strategies

    def run_report(
        self, run: RunResult | str, *, baseline: str | None = None, against: RunResult | str | None = None
    ) -> Iterator[bytes]:
        """A run as one HTML file that needs nothing else, piece by piece.

        Changes refer to the strategy `baseline`, or to the run `against`, strategy by strategy.
        """
        other = None if against is None else quoted_id(against)
        return self._content(f"/runs/{quoted_id(run)}/report.html", {"baseline": baseline, "against": other})


def _series(
    strategies: Sequence[str], signals: Sequence[str] | None = None, points: int | None = None
) -> dict[str, Any]:
    shown = signals and comma_separated(signals)
    return {"strategy": comma_separated(strategies), "signals": shown, "points": points}
