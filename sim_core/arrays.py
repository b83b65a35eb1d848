"""The arrays everything here computes with."""

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
