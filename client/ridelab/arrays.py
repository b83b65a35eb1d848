"""Time histories as NumPy arrays."""

import base64
from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


def unpacked(typed: Mapping[str, Mapping[str, str]]) -> "dict[str, NDArray[np.float32]]":
    """Arrays by signal from the service's typed arrays: little-endian float32 in base64.

    Raises:
        ImportError: NumPy is not installed.
    """
    try:
        import numpy as np
    except ImportError:
        raise ImportError("Arrays need NumPy: pip install numpy") from None
    return {key: np.frombuffer(base64.b64decode(item["bdata"]), dtype="<f4") for key, item in typed.items()}
