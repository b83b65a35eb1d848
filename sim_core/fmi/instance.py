"""One instance of an FMU for one run, by ctypes: types and functions as FMI 2.0 and 3.0 have them."""

import ctypes
import os
from collections.abc import Sequence
from ctypes import CFUNCTYPE, POINTER, c_bool, c_char_p, c_double, c_int, c_size_t, c_uint, c_void_p
from pathlib import Path
from typing import Any

from sim_core.errors import RidelabError
from sim_core.fmi.description import Description

_LOG_2 = CFUNCTYPE(None, c_void_p, c_char_p, c_int, c_char_p, c_char_p)  # what is after the message is not read
_LOG_3 = CFUNCTYPE(None, c_void_p, c_int, c_char_p, c_char_p)
_KINDS: dict[str, Any] = {
    "Real": c_double, "Integer": c_int, "Float64": c_double, "Float32": ctypes.c_float, "Int8": ctypes.c_int8,
    "UInt8": ctypes.c_uint8, "Int16": ctypes.c_int16, "UInt16": ctypes.c_uint16, "Int32": ctypes.c_int32,
    "UInt32": ctypes.c_uint32, "Int64": ctypes.c_int64, "UInt64": ctypes.c_uint64,
}  # fmt: skip
_WARNING, _DISCARD, _FATAL = 1, 2, 4  # of what every function returns, 0 being fine


class _Callbacks(ctypes.Structure):
    """`fmi2CallbackFunctions`."""

    _fields_ = [
        ("logger", _LOG_2),
        ("allocate", c_void_p),
        ("free", c_void_p),
        ("step_finished", c_void_p),
        ("environment", c_void_p),
    ]


class Numbers:
    """Variables of one type that are set or read together."""

    def __init__(self, description: Description, kind: str, references: Sequence[int]) -> None:
        """Return the values of the variables with these value references."""
        number = (c_bool if description.version == 3 else c_int) if kind == "Boolean" else _KINDS[kind]
        self.kind = kind
        self.number = bool if kind == "Boolean" else float if number in (c_double, ctypes.c_float) else round
        self.references = (c_uint * len(references))(*references)
        self.values = (number * len(references))()
        self._count = [c_size_t(len(references))] * (2 if description.version == 3 else 1)

    @property
    def arguments(self) -> tuple[Any, ...]:
        """What FMI's functions take beside the instance."""
        return self.references, self._count[0], self.values, *self._count[1:]


class Instance:
    """From instantiation to the end of a run."""

    def __init__(self, description: Description, folder: Path, library: Path, label: str) -> None:
        """Make the instance.

        Raises:
            RidelabError: The library cannot be loaded, lacks a function, or makes none.
        """
        self._prefix = f"fmi{description.version}"
        self._label = label
        self._logged = ""
        self._alive = self._steps = False
        try:
            self._library = ctypes.CDLL(str(library))
        except OSError as error:
            raise RidelabError(f"{label}: its library cannot be loaded: {error}") from None
        make = self._instantiate_2 if description.version == 2 else self._instantiate_3
        self._instance = c_void_p(make(description, folder))
        if self._instance.value is None:
            raise RidelabError(self._with_said(f"{label}: the FMU made no instance"))
        self._alive = True

    def begin(self, parameters: Sequence[Numbers]) -> None:
        """Initialize it at time 0 with these parameters.

        Raises:
            RidelabError: It refuses.
        """
        for numbers in parameters:
            self.set(numbers)
        undefined = c_int(0) if self._prefix == "fmi2" else c_bool(False)
        experiment = (undefined, c_double(0), c_double(0), undefined, c_double(0))
        if self._prefix == "fmi2":
            self._call("SetupExperiment", *experiment)
            self._call("EnterInitializationMode")
        else:
            self._call("EnterInitializationMode", *experiment)
        self._call("ExitInitializationMode")
        self._steps = True

    def set(self, numbers: Numbers) -> None:
        """Set variables; raises RidelabError where it refuses."""
        self._call(f"Set{numbers.kind}", *numbers.arguments)

    def get(self, numbers: Numbers) -> None:
        """Read variables; raises RidelabError where it refuses."""
        self._call(f"Get{numbers.kind}", *numbers.arguments)

    def step(self, time: float, step: float) -> None:
        """Make a step [s]; raises RidelabError where it refuses."""
        if self._prefix == "fmi2":
            self._call("DoStep", c_double(time), c_double(step), c_int(1))
            return
        flags, last = [c_bool() for _ in range(3)], c_double()
        self._call(
            "DoStep", c_double(time), c_double(step), c_bool(True), *map(ctypes.byref, flags), ctypes.byref(last)
        )
        if flags[1].value:
            raise RidelabError(f"{self._label}: the FMU asked to end the run at {time:g} s")

    def end(self) -> None:
        """Terminate and free it; again is harmless."""
        if self._steps and self._alive:
            self._steps = False
            self._function("Terminate")(self._instance)
        if self._alive:
            self._alive = False
            self._function("FreeInstance", result=None)(self._instance)

    def _call(self, name: str, *arguments: Any) -> None:
        status = self._function(name)(self._instance, *arguments)
        if status <= _WARNING:
            return
        self._steps = False  # after an error it may be freed, after a fatal one not even that
        self._alive = status != _FATAL
        why = "it discards the step, and is asked for no shorter one" if status == _DISCARD else "it reports an error"
        raise RidelabError(self._with_said(f"{self._label}: {self._prefix}{name}: {why}"))

    def _function(self, name: str, result: Any = c_int) -> Any:
        try:
            function = getattr(self._library, f"{self._prefix}{name}")
        except AttributeError:
            raise RidelabError(f"{self._label}: its library has no {self._prefix}{name}") from None
        function.restype = result
        return function

    def _with_said(self, message: str) -> str:
        return f"{message} ({self._logged})" if self._logged else message

    def _instantiate_2(self, description: Description, folder: Path) -> int | None:
        def log(_: int, __: bytes, status: int, ___: bytes, message: bytes) -> None:
            self._log_message(status, message)

        memory = ctypes.CDLL("msvcrt") if os.name == "nt" else ctypes.CDLL(None)
        self._callbacks = _Callbacks(
            _LOG_2(log), *(ctypes.cast(each, c_void_p) for each in (memory.calloc, memory.free))
        )
        instance: int | None = self._function("Instantiate", c_void_p)(
            b"ridelab", c_int(1), description.token.encode(), (folder / "resources").as_uri().encode(),
            ctypes.byref(self._callbacks), c_int(0), c_int(1),
        )  # fmt: skip
        return instance

    def _instantiate_3(self, description: Description, folder: Path) -> int | None:
        def log(_: int, status: int, __: bytes, message: bytes) -> None:
            self._log_message(status, message)

        self._log = _LOG_3(log)
        yes, no = c_bool(True), c_bool(False)
        instance: int | None = self._function("InstantiateCoSimulation", c_void_p)(
            b"ridelab", description.token.encode(), f"{folder / 'resources'}{os.sep}".encode(), no, yes, no, no,
            POINTER(c_uint)(), c_size_t(0), c_void_p(), self._log, c_void_p(),
        )  # fmt: skip
        return instance

    def _log_message(self, status: int, message: bytes | None) -> None:
        if status > _WARNING and message:
            self._logged = message.decode(errors="replace")[:300]
