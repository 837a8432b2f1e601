"""Kind of fault: its parameters and its effects, and the registry of all kinds.

A kind is a subclass of :class:`FaultKind` and a constructor function in one file of ``holdfast.response.faults.kinds``. The
registry contains the functions that the stub of the package exports and :func:`register_kind` marks; no other file lists them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.registry import read_exports
from holdfast.core.typing import P, T

if TYPE_CHECKING:
    from holdfast.kernels.program import SX
    from holdfast.response.faults.model_joint import ActiveFault, ModelJoint, SensorReading
    from holdfast.response.faults.step_symbols import StepSymbols

Numbers = Mapping[str, float | str]
MAX_PARAMETERS = 3  # parameters of a kind, for each of which a batch has a column
_MAX_ALTERNATIVE = 2  # parameters of an alternative, for each of which a uniform number is sampled
_KINDS_PACKAGE = "holdfast.response.faults.kinds."


@dataclass(frozen=True)
class FaultParameter:
    """Parameter of a kind of fault."""

    name: str  # name in files and of the argument of the constructor
    low: float = -math.inf  # lower bound of the number
    high: float = math.inf  # upper bound of the number
    includes_ends: bool = True  # True if the bounds are allowed
    has_random_sign: bool = False  # True if the sign of the number is random in every episode
    word: str | None = None  # text that is accepted instead of a number, and the default; None if a number is required
    absent: float = 0.0  # number in the step kernel where the parameter is not given


class FaultKind:
    """Kind of fault of a joint. Subclasses override the effects that the kind has.

    Class attributes:
        code: Number of the kind in arrays such as ``FaultBatch.kind``; a new kind takes the next free number.
        parameters: Alternatives, each a tuple of one or two parameters. A fault has parameters of one alternative.
        holds_joint: True if a brake or a jam holds the joint at its position.
        is_sensor: True if the reading of the joint sensor is wrong and the joint itself is healthy.
        needs_brake: True if the controller brakes the joint, because the joint cannot be moved or its position is unknown.
        drops_commands: True if the joint keeps its last command.
        draws_noise: True if ``change_reading`` uses the noise of the step.
    """

    name = ""  # set by `register_kind`
    code = -1
    parameters: tuple[tuple[FaultParameter, ...], ...] = ()
    holds_joint = False
    is_sensor = False
    needs_brake = False
    drops_commands = False
    draws_noise = False

    @cached_property
    def parameters_by_name(self) -> dict[str, FaultParameter]:
        """Parameters of all alternatives by name, in their order."""
        return {parameter.name: parameter for alternative in self.parameters for parameter in alternative}

    @property
    def changes_model(self) -> bool:
        """True if the kind changes fields of a MuJoCo model."""
        return self._overrides("apply")

    @property
    def updates_each_step(self) -> bool:
        """True if an active fault of the kind needs work at every step."""
        return self._overrides("update")

    @property
    def needs_torques(self) -> bool:
        """True if the kind affects neither joint rates nor sensors, so that it requires bodies and motors."""
        return not (self.holds_joint or self._overrides("change_motion") or self._overrides("change_reading"))

    def _overrides(self, method: str) -> bool:
        return getattr(type(self), method) is not getattr(FaultKind, method)

    def is_delayed(self, numbers: Numbers) -> bool:
        """Return True if the fault has no effect until the joint reaches a position after the onset."""
        return False

    # ---- effects in a MuJoCo model -----------------------------------------------------------------------------------

    def check(self, joint: ModelJoint, numbers: Numbers) -> None:
        """Raise an error for a joint that cannot have the fault.

        Raises:
            InputError: The joint cannot have the fault.
        """

    def begin(self, fault: ActiveFault) -> None:
        """Store in ``fault.memory`` what the fault needs from the time of its onset."""

    def take_delayed_effect(self, fault: ActiveFault) -> bool:
        """Return True if a delayed fault takes effect at this step, and set ``fault.position``."""
        return True

    def update(self, fault: ActiveFault) -> None:
        """Update an active fault before a step."""

    def apply(self, fault: ActiveFault) -> None:
        """Write the effect of an active fault into the model, by the methods of ``fault.joint``."""

    def read_sensor(self, reading: SensorReading, fault: ActiveFault) -> float:
        """Return the reading of the joint sensor, rad or m."""
        return reading.value

    # ---- effects in the kinematic closed loop ------------------------------------------------------------------------

    def change_motion(self, step: StepSymbols, active: SX) -> None:
        """Change the command, the speed limits, or the stops of the joints where ``active``, (n,), is 1."""

    def change_reading(self, step: StepSymbols, active: SX) -> None:
        """Change the sensor readings of the joints where ``active``, (n,), is 1."""

    # ---- effects on the feasibility of a goal ------------------------------------------------------------------------

    def torque_fraction(self, numbers: Numbers) -> float | None:
        """Return the remaining fraction of the motor's torque; None if the kind does not reduce it."""
        return None

    def remaining_range(self, limits: tuple[float, float], position: float, numbers: Numbers) -> tuple[float, float] | None:
        """Return the remaining range of a joint with its position at the onset, rad or m; None if the range stays."""
        return None


_registered: dict[str, FaultKind] = {}


def register_kind(kind: FaultKind) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """Mark the constructor of a kind of fault; its name is the name of the kind."""

    def mark_constructor(constructor: Callable[P, T]) -> Callable[P, T]:
        kind.name = constructor.__name__
        _registered[kind.name] = kind
        return constructor

    return mark_constructor


@cache
def fault_kinds() -> dict[str, FaultKind]:
    """Return all kinds by name, in the order of their codes.

    Raises:
        InputError: The codes are not 0, 1, 2, ..., each once, or a kind has too many parameters.
    """
    exports = {module: names for module, names in read_exports("response.faults").items() if module.startswith(_KINDS_PACKAGE)}
    for module in exports:
        import_module(module)
    kinds = [kind for name, kind in _registered.items() if any(name in names for names in exports.values())]
    kinds.sort(key=lambda kind: kind.code)
    if [kind.code for kind in kinds] != list(range(len(kinds))):
        codes_text = ", ".join(f"{kind.name} {kind.code}" for kind in kinds)
        raise InputError(f"codes of the fault kinds are {codes_text}; each number from 0 to {len(kinds) - 1} must occur once")
    for kind in kinds:
        if len(kind.parameters_by_name) > MAX_PARAMETERS or any(len(names) > _MAX_ALTERNATIVE for names in kind.parameters):
            limits = f"it can have {MAX_PARAMETERS}, and {_MAX_ALTERNATIVE} in each alternative"
            raise InputError(f"fault kind '{kind.name}' has {len(kind.parameters_by_name)} parameters; {limits}")
    return {kind.name: kind for kind in kinds}


def find_kind(name: str) -> FaultKind:
    """Return the kind with a name.

    Raises:
        InputError: The name is unknown.
    """
    kinds = fault_kinds()
    if name not in kinds:
        raise InputError(f"kind '{name}' is not known; use {', '.join(kinds)}")
    return kinds[name]
