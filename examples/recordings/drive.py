"""A drive as a test engineer would record it: `python examples/recordings/drive.py drive.json > drive.csv`.

The car of drive.json, whose dampers are 20 % softer than believed, driven passively; accelerometer and travel sensors
with noise, 200 times a second, by a clock that runs 0.3 % too slow and was started 2.3 s after x = 0.
"""

import json
import sys
from pathlib import Path

import numpy as np

from sim_core import Mismatch, Scenario, simulate

START, DRIFT, SAMPLES = 2.3, 0.003, 200  # [s], true seconds in a second of the clock less one, a second
NOISE = {"speed": 0.05, "body_acceleration": 0.1, "front_deflection": 0.0005, "rear_deflection": 0.0005}  # [SI units]
COLUMNS = {"speed": ("v [km/h]", 3.6), "body_acceleration": ("acc_z [g]", 1 / 9.80665)}
COLUMNS |= {"front_deflection": ("travel_front [mm]", 1e3), "rear_deflection": ("travel_rear [mm]", 1e3)}

believed = Scenario.model_validate(json.loads(Path(sys.argv[1]).read_text()))
real = believed.model_copy(update={"mismatch": Mismatch(damping=0.8)})
series = simulate(real, "passive").series
noise = np.random.default_rng(2026)
true = np.arange(START, series["time"][-1], (1 + DRIFT) / SAMPLES)
rows = [np.arange(len(true)) / SAMPLES]
for key, (_, scale) in COLUMNS.items():
    exact = np.interp(true, series["time"], series[key])
    rows.append(scale * (exact + NOISE[key] * noise.standard_normal(len(true))))
lines = [";".join(f"{value:.4f}" for value in row) for row in zip(*rows, strict=True)]
sys.stdout.write("\n".join([";".join(["t [s]", *(name for name, _ in COLUMNS.values())]), *lines, ""]))
