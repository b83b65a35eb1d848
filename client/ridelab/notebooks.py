"""Arrays, frames and figures for notebooks: NumPy, pandas and plotly, imported when they are asked for."""

import base64
import importlib
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
    import pandas as pd
    import plotly.graph_objects as go
    from numpy.typing import NDArray


def needed(package: str, what: str, module: str = "") -> Any:
    """A package that is no part of the client.

    Raises:
        ImportError: It is not installed.
    """
    try:
        return importlib.import_module(module or package)
    except ImportError:
        raise ImportError(f"{what} needs {package}: pip install {package}") from None


def frame_of(rows: Iterable[Mapping[str, Any]], index: list[str], units: Mapping[str, str]) -> "pd.DataFrame":
    """Rows as a frame, with the units of its columns, or of the metrics in its rows, as `attrs["units"]`."""
    frame: pd.DataFrame = needed("pandas", "A frame").DataFrame(list(rows)).set_index(index)
    frame.attrs["units"] = dict(units)
    return frame


def figure_of(answer: Mapping[str, Any]) -> "go.Figure":
    """A figure of the service as plotly's own."""
    figure: go.Figure = needed("plotly", "A figure", "plotly.graph_objects").Figure(dict(answer), skip_invalid=True)
    return figure


def unpacked(typed: Mapping[str, Mapping[str, str]]) -> "dict[str, NDArray[np.float32]]":
    """Arrays by signal from the service's typed arrays: little-endian float32 in base64.

    Raises:
        ImportError: NumPy is not installed.
    """
    numpy = needed("numpy", "An array")
    return {key: numpy.frombuffer(base64.b64decode(item["bdata"]), dtype="<f4") for key, item in typed.items()}
