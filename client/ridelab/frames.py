"""Frames and figures for notebooks: pandas and plotly, imported when they are asked for."""

import importlib
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas as pd
    import plotly.graph_objects as go


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
