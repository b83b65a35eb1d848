"""A stored recording as CSV, which is read back as the same recording. Runs in a worker: no web here."""

import numpy as np

from sim_core.catalogue import SIGNALS
from sim_core.scenario.recorded import RecordedDrive


def as_csv(drive: RecordedDrive) -> bytes:
    """Return its signals in SI units to the last digit; a cell without a value is empty."""
    signals = drive.signals()
    head = ",".join(f"{key} [{SIGNALS[key].unit}]" for key in signals)
    rows = np.array(list(signals.values())).T.tolist()
    lines = (",".join("" if value != value else repr(value) for value in row) for row in rows)
    return "\n".join([head, *lines, ""]).encode()
