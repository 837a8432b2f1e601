"""``holdfast stationary-points`` and ``basins``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.interface.cli.groups import OutputOptions
from holdfast.interface.cli.laws import LockDegreesOption, SeededLawOptions, TargetOption
from holdfast.interface.cli.options import ArmArgument, FailureOption
from holdfast.interface.cli.values import read_locks, read_target

if TYPE_CHECKING:
    from holdfast.core.result import Result


def stationary_points(
    arm: ArmArgument,
    target: TargetOption,
    lock: Annotated[list[str] | None, "Locked joint JOINT=VALUE in rad or m, repeatable; JOINT alone: all its values."] = None,
    failure: FailureOption = None,
    degrees: LockDegreesOption = False,
    controlled: SeededLawOptions = SeededLawOptions(),
    output: OutputOptions = OutputOptions(),
) -> None:
    """Find the configurations at which an arm with an undetected lock can stop.

    Example: holdfast stationary-points planar-3r --target 1.5,1.5 --lock 2=140 --degrees
    """
    control_law = controlled.read_law(arm)
    target_value = read_target(control_law.arm, control_law.task, target)
    locked = read_locks(control_law.arm, lock, degrees, optional_value=True, failure=failure)
    if output.plot is not None and all("=" in text for text in lock or []):
        raise InputError("--plot shows curves over the locked value; give --lock JOINT alone, or see 'holdfast basins --plot'")
    result: Result = hf.stationary_points(control_law, target_value, locked, seed=controlled.seed)
    output.print_result(result)


def basins(
    arm: ArmArgument,
    target: TargetOption,
    lock: Annotated[list[str] | None, "Locked joint JOINT=VALUE in rad or m. Repeatable."] = None,
    failure: FailureOption = None,
    starts: Annotated[int, "Number of random starts."] = 2000,
    grid: Annotated[int | None, "Number of starts per axis of a map over two joints; replaces --starts."] = None,
    degrees: LockDegreesOption = False,
    controlled: SeededLawOptions = SeededLawOptions(),
    output: OutputOptions = OutputOptions(),
) -> None:
    """Find which start configurations converge to the target after a lock.

    Example: holdfast basins planar-3r --target 1.5,1.5 --lock 2=45 --degrees --grid 80 --plot basins.png
    """
    control_law = controlled.read_law(arm)
    locked = read_locks(control_law.arm, lock, degrees, failure=failure)
    result = hf.basins(
        control_law,
        read_target(control_law.arm, control_law.task, target),
        locked,
        starts=starts,
        grid=grid,
        seed=controlled.seed,
    )
    output.print_result(result)
