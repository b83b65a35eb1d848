"""A batch of runs on a service: its rows, as they come, as a file or a frame, and what they say as a whole."""

import io
import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from ridelab.files import format_of, save
from ridelab.jobs import Job
from ridelab.streams import json_rows

if TYPE_CHECKING:
    import pandas as pd


class Batch(Job):
    """A batch of runs."""

    NAME: ClassVar[str] = "batch"
    PLACE: ClassVar[str] = "/api/v1/batches"

    def summary(self, figures: Sequence[str] = (), baseline: str | None = None) -> dict[str, Any]:
        """What its finished rows say as a whole: quantiles, extremes, paired margins, stability (docs/robustness.md).

        Args:
            figures: Metrics such as `bump.body_acceleration.peak`; none are the paper's eight, travel and airborne.
            baseline: The strategy the others are compared with; None is LV, else the first.
        """
        params = {"figures": ",".join(figures), "baseline": baseline}
        return self._http.document("GET", self._path("/summary"), params=params)

    def rows(self) -> Iterator[dict[str, Any]]:
        """Its rows as they come: swept fields, strategy, status, metrics; one for each run, failed ones too."""
        with self._http.stream(self._path("/results"), params={"format": "json"}) as response:
            yield from json_rows(response.iter_text())

    def frame(self) -> "pd.DataFrame":
        """Its rows as a pandas frame: a column a swept field and a metric, `frame.attrs["units"]` the units.

        Raises:
            ImportError: pandas is not installed.
        """
        try:
            import pandas as pd
        except ImportError:
            raise ImportError("A frame needs pandas: pip install 'ridelab[pandas]'") from None
        frame = pd.read_csv(io.BytesIO(b"".join(self.content("csv"))))
        heads = [head.removesuffix("]").partition(" [") for head in map(str, frame.columns)]
        frame.columns = pd.Index([name for name, _, _ in heads])
        frame.attrs["units"] = {name: unit or "1" for name, _, unit in heads}
        return frame

    def content(self, file_format: str) -> Iterator[bytes]:
        """Its results as the bytes of a `csv`, `parquet` or `json` file, piece by piece."""
        with self._http.stream(self._path("/results"), params={"format": file_format}) as response:
            yield from response.iter_bytes()

    def download(self, path: str | os.PathLike[str], file_format: str | None = None) -> Path:
        """Its results as a file, in the format its name ends with or the one named.

        Raises:
            ValueError: There is no such format.
            OSError: The file cannot be written.
        """
        return save(self.content(format_of(path, file_format)), path)
