"""A batch of runs on a service: follow it, stop it, take its results."""

import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, ClassVar

from backend.client.files import format_of, save
from backend.client.follow import rows
from backend.client.followed import Followed


class Batch(Followed):
    """A batch as it was last heard of."""

    PLACE: ClassVar[str] = "/api/v1/batches"

    @property
    def total(self) -> int:
        """Runs: points times strategies."""
        return int(self._answer["total"])

    @property
    def done(self) -> int:
        """Runs that succeeded."""
        return int(self._answer["done"])

    @property
    def failed(self) -> int:
        """Runs that failed; their rows say why."""
        return int(self._answer["failed"])

    def __repr__(self) -> str:
        return f"Batch({self.id}: {self.state}, {self.done} done, {self.failed} failed of {self.total})"

    def summary(self, figures: Sequence[str] = (), baseline: str | None = None) -> dict[str, Any]:
        """What its finished rows say as a whole: quantiles, extremes, paired margins, stability (docs/robustness.md).

        Args:
            figures: Keys such as `bump.body_acceleration.peak`; none are the paper's eight, travel and airborne.
            baseline: The strategy the others are compared with; None is LV, else the first.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer.
        """
        params = {"figures": ",".join(figures), **({} if baseline is None else {"baseline": baseline})}
        found: dict[str, Any] = self._http.json("GET", self._path("/summary"), params=params)
        return found

    def rows(self) -> Iterator[dict[str, Any]]:
        """Its rows as they come: swept fields, strategy, status, metrics; one for each run, failed ones too.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or it broke off.
        """
        with self._http.stream(self._path("/results"), params={"format": "json"}) as response:
            yield from rows(response.iter_text())

    def content(self, file_format: str) -> Iterator[bytes]:
        """Its results as the bytes of a `csv`, `parquet` or `json` file, piece by piece.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or it broke off.
        """
        with self._http.stream(self._path("/results"), params={"format": file_format}) as response:
            yield from response.iter_bytes()

    def download(self, path: str | os.PathLike[str], file_format: str | None = None) -> Path:
        """Its results as a file, in the format its name ends with or the one named.

        Raises:
            ValueError: There is no such format.
            OSError: The file cannot be written.
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer, or it broke off.
        """
        return save(self.content(format_of(path, file_format)), path)
