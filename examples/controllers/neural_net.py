"""A small neural net of NumPy alone: eight states in, sixteen hidden units, two forces out; weights from a file.

Its weights were fitted to the forces of Ridelab's LQR on two of the paper's roads.
"""

from pathlib import Path

import numpy as np

from sim_core import Controller, FloatArray, Seen, Setup, option


class NeuralNet(Controller):
    """Two layers with tanh between them, whose weights stand in neural_net.npz."""

    id, label = "neural_net", "Neural net"
    files = ("neural_net.npz",)
    share: float = option(1.0, ge=0, le=1, help="Share of the net's force that is given.")

    def start(self, setup: Setup) -> None:
        """Read the weights: states are divided by `scale`, forces are in units of the force limit."""
        with np.load(Path(__file__).with_name("neural_net.npz")) as weights:
            self.scale, self.inner, self.outer = (weights[name] for name in ("scale", "inner", "outer"))
        self.limit = setup.force_limit

    def force(self, seen: Seen) -> FloatArray:
        """The net's forces for the present state."""
        hidden = np.tanh(self.inner @ (seen.state / self.scale))
        force: FloatArray = self.share * self.limit * np.tanh(self.outer @ hidden)
        return force
