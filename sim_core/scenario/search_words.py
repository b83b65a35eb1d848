"""What people may look for a field of the scenario by, beside its title and help; forms and lists search it too.

By part (its class's name) and field; `*` is said of every field of the part. Other spellings, neighbouring terms and
what a field decides belong here. Words are found one by one, but those of a phrase behind a comma only together.
"""

_SENSED = "sensor camera lidar measured"
_LATE = "lag latency"
_WEIGHTS = "comfort ride pitch grip tire road holding importance cost tuning"
_DAMPER = "shock absorber"
_TRAVEL = "suspension travel stroke rattle space"

SEARCH_WORDS: dict[str, dict[str, str]] = {
    "Vehicle": {
        "body_mass": "car weight load payload sprung axle natural frequency",
        "pitch_inertia": "car moment rotation natural frequency",
        "front_wheel_mass": "axle weight tire natural frequency",
        "rear_wheel_mass": "axle weight tire natural frequency",
        "cg_to_front": "wheelbase axle load center weight distribution",
        "cg_to_rear": "wheelbase axle load center weight distribution",
        "cg_height": "center",
        "front_spring": "rate sag natural frequency comfort ride",
        "rear_spring": "rate sag natural frequency comfort ride",
        "front_damping": f"{_DAMPER} damping ratio comfort ride",
        "rear_damping": f"{_DAMPER} damping ratio comfort ride",
        "front_tyre_stiffness": "tire spring rate natural frequency",
        "rear_tyre_stiffness": "tire spring rate natural frequency",
        "rebound_ratio": f"{_DAMPER} asymmetry",
        "front_damper_curve": f"{_DAMPER} characteristic",
        "rear_damper_curve": f"{_DAMPER} characteristic",
        "bump_stop_clearance": f"{_TRAVEL} buffer rubber",
        "bump_stop_stiffness": f"{_TRAVEL} buffer rubber",
        "tyre_lift_off": "tire grip contact airborne",
        "anti_dive": "pitch nod",
        "anti_lift": "pitch nod",
    },
    "Bump": {"*": "hump pothole obstacle cushion, speed bump, speed table"},
    "Road": {
        "roughness": "pavement surface unevenness quality",
        "seed": "random luck",
        "length": "distance",
        "profile": "survey file crg heights iri",
    },
    "Speed": {
        "*": "velocity",
        "target_speed_kmh": "slow",
        "detection_distance": f"{_SENSED} preview look-ahead range",
        "policy": "equal",
    },
    "Fuzzy": {"*": "membership"},
    "Brake": {"*": "deceleration"},
    "Actuator": {
        "bandwidth": f"frequency delay {_LATE} response",
        "rate_limit": "slew",
        "saturation": "maximum",
    },
    "Mismatch": {
        "*": "error uncertainty robustness",
        "body_mass": "weight payload",
        "tyres": "tire",
        "damping": _DAMPER,
        "rebound_ratio": _DAMPER,
        "preview_offset": _SENSED,
        "preview_gain": _SENSED,
        "preview_noise": _SENSED,
        "preview_resolution": _SENSED,
        "preview_delay": f"{_SENSED} {_LATE}",
    },
    "Estimation": {"*": "sensor observer measured measurement"},
    "StageWeights": {"*": _WEIGHTS},
    "RoadWeights": {"*": _WEIGHTS},
    "Mpc": {
        "sample_time": "frequency rate period step",
        "prediction_horizon": "look-ahead",
        "preview": f"{_SENSED} look-ahead",
        "expected_offset": _SENSED,
        "expected_noise": _SENSED,
        "deflection_limit": _TRAVEL,
        "deflection_weight": f"{_TRAVEL} {_WEIGHTS}",
        "force_limit": "actuator maximum",
        "force_weight": f"energy effort {_WEIGHTS}",
        "force_change_weight": f"energy effort {_WEIGHTS}",
    },
    "Lqr": {"weights": _WEIGHTS, "deflection_weight": f"{_TRAVEL} {_WEIGHTS}", "preview": f"{_SENSED} look-ahead"},
    "Hook": {"*": f"{_DAMPER} semi-active"},
    "Hil": {
        "*": "ecu controller",
        "bits": "sensor adc quantization",
        "compensation": _LATE,
        "jitter": f"delay {_LATE}",
        "packet_loss": "network bus can",
    },
}


def search_terms(words: str) -> list[str]:
    """Return the single words, and behind them the phrases."""
    single, *phrases = words.split(",")
    return [*single.split(), *map(str.strip, phrases)]
