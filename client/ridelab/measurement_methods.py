"""Methods that send measured roads and recorded drives from files, and read them again."""

import json
import os
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from ridelab.connection import API, Connection
from ridelab.results import quoted_id


class MeasurementMethods(Connection):
    """Methods of `Ridelab` for measured roads and recordings."""

    def describe_table(
        self, source: str | os.PathLike[str] | bytes, table: Mapping[str, Any] | None = None
    ) -> dict[str, Any]:
        """Say how a file of a road or a drive would be read: its `kind`, its columns, what is asked, the first rows.

        Corrected, the answer is the `table` of `upload_road` and `upload_recording`, which decides.
        """
        params = {"dry_run": True, **_table(table)}
        answer: dict[str, Any] = self._http.json("POST", f"{API}/roads", body=_content(source), params=params)
        return dict(answer["table"])

    def upload_road(
        self,
        source: str | os.PathLike[str] | bytes,
        *,
        left: float | None = None,
        right: float | None = None,
        table: Mapping[str, Any] | None = None,
    ) -> dict[str, Any]:
        """Send a measured profile, a table or OpenCRG file or its content; `id` is for a scenario's `road.profile`.

        The answer has `length` [m], `samples`, `bumps` (found in it), `warnings` (what was done to it), and of the
        heights as they came `iri` [m/km] and by ISO 8608 `iso_class`, `roughness` [m^3] and `waviness`, with intervals.
        `iso_class` is None where roughness is too uncertain; `cautions` then say so.

        Args:
            source: The file; which of the two it is is seen from its content.
            left: Of OpenCRG: where the left wheel runs, v [m]; None is 0.75.
            right: The same of the right wheel; None is -0.75.
            table: Of a table: what its columns are, where the file doesn't say it (`describe_table`).

        Raises:
            RidelabAPIError: It is none; of kind `table-unsure` where it has to be asked about, with `table`.
        """
        content = _content(source)
        kind = "application/x-opencrg" if re.search(rb"^\$\$\$\$", content, re.MULTILINE) else "text/csv"
        params = {"left": left, "right": right, **_table(table)}
        return self._http.json("POST", f"{API}/roads", body=content, params=params, headers={"Content-Type": kind})

    def road(self, road_id: str, points: int = 2000) -> dict[str, Any]:
        """A measured road: as `upload_road` has it, and at most so many heights, `distance` and `height` [m]."""
        road: dict[str, Any] = self.get(f"/roads/{quoted_id(road_id)}", {"points": points})
        return road

    def road_content(self, road_id: str, file_format: str = "csv", encoding: str = "binary") -> Iterator[bytes]:
        """Every height of a measured road, piece by piece; `upload_road` makes the same road of it anywhere.

        Args:
            road_id: Its id.
            file_format: `csv` or `crg`, which is OpenCRG.
            encoding: Of OpenCRG: `binary` or `text`.
        """
        return self._content(f"/roads/{quoted_id(road_id)}", {"format": file_format, "encoding": encoding})

    def upload_recording(
        self,
        source: str | os.PathLike[str] | bytes,
        columns: Mapping[str, str] | None = None,
        *,
        table: Mapping[str, Any] | None = None,
    ) -> dict[str, Any]:
        """Send a recorded drive, a table or its content; `strategy` stands for it among a run's strategies.

        The answer has `signals`, `samples`, `duration` [s], `columns` (what each was read as) and `warnings`.

        Args:
            source: The file.
            columns: By name of a column its signal with the unit, `{"acc_z": "body_acceleration [g]"}`, or an empty
                text to leave it out; others are read by their own names.
            table: The same and more: separator, clock, rate and so on (`describe_table`).

        Raises:
            RidelabAPIError: It is none; of kind `table-unsure` where it has to be asked about, with `table`.
        """
        params = {"columns": json.dumps(dict(columns))} if columns else {}
        return self._http.json("POST", f"{API}/recordings", body=_content(source), params={**params, **_table(table)})

    def recording(self, recording_id: str) -> dict[str, Any]:
        """A recorded drive: `strategy`, `signals`, `samples`, `duration` [s], `distance` [m]."""
        recording: dict[str, Any] = self.get(f"/recordings/{quoted_id(recording_id)}")
        return recording

    def recording_content(self, recording_id: str) -> Iterator[bytes]:
        """Every sample of a recording as CSV, piece by piece; `upload_recording` makes the same one of it anywhere."""
        return self._content(f"/recordings/{quoted_id(recording_id)}", {"format": "csv"})


def _content(source: str | os.PathLike[str] | bytes) -> bytes:
    return source if isinstance(source, bytes) else Path(source).read_bytes()


def _table(table: Mapping[str, Any] | None) -> dict[str, str]:
    """Return the corrections as a parameter: without what an answer says beside them, which would make it long."""
    if table is None:
        return {}
    told = ("questions", "notes", "preview", "units_line", "first_row")
    return {"table": json.dumps({key: value for key, value in table.items() if key not in told})}
