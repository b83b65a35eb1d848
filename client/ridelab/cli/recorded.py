"""A recorded drive on the command line: sent, shown in a run beside the strategy that it is compared with."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from ridelab.cli import tables
from ridelab.cli.reporting import InputError
from ridelab.cli.service import Services
from ridelab.cli.targets import Target
from ridelab.results import RunResult

ENDINGS = (".csv", ".txt", ".tsv", ".dat", ".asc", ".vbo", ".xlsx")
_EXAMPLE = "'acc_z=body_acceleration [g]'"
SIGNAL = "signal."  # before a signal's name, of the difference of its curves


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordedSide:
    """A run with a recording in it, as two that can be compared.

    Attributes:
        simulated: The run.
        recorded: The same, with the recording's outcome under the strategy's name.
        strategy: That strategy.
        metrics: Those that the recording has.
        curves: Signal -> `rms` of the difference, `baseline_rms` and more (`Ridelab.differences`).
        units: Of each signal.
        said: How the recording was read and where it lies.
    """

    simulated: RunResult
    recorded: RunResult
    strategy: str
    metrics: Sequence[str]
    curves: Mapping[str, Mapping[str, float]]
    units: Mapping[str, str]
    said: Sequence[str]


def mapping(columns: Sequence[str]) -> dict[str, str]:
    """`--column NAME=SIGNAL [UNIT]` as the service takes it."""
    pairs = [text.partition("=") for text in columns]
    if wrong := next((name for name, sign, _ in pairs if not sign), None):
        raise InputError(f"--column: {wrong} is not NAME=SIGNAL [UNIT], as in {_EXAMPLE}")
    return {name: signal.strip() for name, _, signal in pairs}


def beside(
    file: str,
    target: Target,
    named: Sequence[str],
    columns: Mapping[str, str],
    table: str | None,
    services: Services,
) -> RecordedSide:
    """Send a recording and run it beside one strategy of the target.

    Raises:
        InputError: The target has several strategies and none is named, or several are; or the file cannot be used
            as it is.
    """
    names = list(named) or target.strategies
    if len(names) != 1:
        offered = f"one of {', '.join(names)}" if names else "such as passive"
        raise InputError(f"--strategy: which one drove the car of {file}? Name it, {offered}")
    if target.batch is not None or (target.run is not None and target.run.roads > 1):
        raise InputError(f"{target.name}: a recording is compared with a run over one road")
    ridelab = services.at()
    drive = tables.sent(lambda said: ridelab.upload_recording(file, columns, table=said), table, file)
    (strategy,), name = names, drive["strategy"]
    run = ridelab.run(target.scenario, [strategy, name])
    for each in (run[strategy], run[name]):
        if each.status != "ok":
            raise InputError(f"{file if each.strategy == name else each.strategy}: {each.reason}")
    curves: Any = ridelab.differences(run, strategy)[name]
    of_recording = replace(run[name], strategy=strategy)
    return RecordedSide(
        simulated=run,
        recorded=replace(run, strategies={strategy: of_recording}),
        strategy=strategy,
        metrics=[metric for metric, value in of_recording.figures().items() if value is not None],
        curves={key: each for key, each in curves.items() if each["rms"] is not None},
        units={key: unit for key, (_, unit) in services.names.signals.items()},
        said=list(dict.fromkeys([*drive["warnings"], *(of_recording.recording or {})["notes"]])),
    )
