"""A QP as the core's C takes it, of the smallest kind."""

from typing import Any

import numpy as np

from sim_core.kernel.qp import QpDesign


def qp_design(**changed: Any) -> QpDesign:
    """Three moves and four deflections on nineteen inputs, nothing in any."""
    right: dict[str, Any] = {
        "H": np.eye(5),
        "columns": np.zeros((5, 8)),
        "low": np.zeros(5),
        "high": np.zeros(5),
        "linear_term_gain": np.zeros((7, 19)),
        "unconstrained_gain": np.zeros((7, 19)),
        "bounds": np.ones(7),
        "axles": np.array([-1, -1, -1, 0, 0, 1, 1], dtype=np.int8),
        "gram": np.zeros((7, 7)),
        "slack_price": 1.0,
        "inverse_slack_weight": 1.0,
        "iterations": 5,
    }
    return QpDesign(**(right | changed))
