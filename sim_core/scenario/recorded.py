"""A recorded drive: its signals as they came, packed, under an id that is their digest."""

import zlib
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.catalogue import SIGNALS
from sim_core.scenario.measured import ID_PATTERN, Packed, packed_id

PREFIX = "recording:"
LONGEST = 5000.0  # [m]
NAME_PATTERN = f"^{PREFIX}{ID_PATTERN.removeprefix('^')}"


def recording_id(strategy: str) -> str | None:
    """Return the recording that the name of a strategy stands for; None where it is a strategy that is simulated."""
    return strategy.removeprefix(PREFIX) if strategy.startswith(PREFIX) else None


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class RecordedDrive(Packed):
    """Signals of one drive, sampled together.

    Attributes:
        keys: Which signals there are, in the catalogue's order, with commas.
    """

    keys: str

    @classmethod
    def of(cls, signals: Mapping[str, FloatArray]) -> "RecordedDrive":
        """Return the recording of these signals by the catalogue's names (samples,) [SI units]; NaN is no value.

        Example:
            >>> import numpy as np
            >>> drive = RecordedDrive.of({"time": np.arange(3.0), "body_acceleration": np.array([0.0, np.nan, 1.0])})
            >>> drive.keys, drive.signals()["body_acceleration"].tolist()
            ('time,body_acceleration', [0.0, nan, 1.0])
        """
        keys = [key for key in SIGNALS if key in signals]
        table = np.array([signals[key] for key in keys], dtype="<f8") + 0.0  # no negative zero
        table[np.isnan(table)] = np.nan  # one of many
        head = f"ridelab recording 1\n{','.join(keys)}\n".encode()
        apart = table.view(np.uint8).reshape(len(keys), -1, 8).transpose(0, 2, 1)  # alike bytes together
        return cls(
            id=packed_id(head + table.tobytes()),
            samples=table.shape[1],
            keys=",".join(keys),
            content=zlib.compress(np.ascontiguousarray(apart).tobytes()),
        )

    def signals(self) -> dict[str, FloatArray]:
        """Return the signals (samples,) [SI units] by the catalogue's names."""
        keys = self.keys.split(",")
        apart = np.frombuffer(zlib.decompress(self.content), np.uint8).reshape(len(keys), 8, -1)
        table = np.ascontiguousarray(apart.transpose(0, 2, 1)).view("<f8")[..., 0]
        return dict(zip(keys, table.astype(np.float64), strict=True))
