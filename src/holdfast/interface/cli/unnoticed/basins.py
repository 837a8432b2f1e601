"""``holdfast basins``."""

from __future__ import annotations

from typing import Annotated

import holdfast as hf
from holdfast.interface.cli.groups import ArmSourceOptions, OutputOptions
from holdfast.interface.cli.laws import LawOption, LockDegreesOption, TargetOption, read_law_for_arm
from holdfast.interface.cli.options import ArmArgument, FailureOption, SeedOption, TaskOption
from holdfast.interface.cli.values import read_locks, read_target


def command(
    arm: ArmArgument,
    target: TargetOption,
    lock: Annotated[list[str] | None, "JOINT=VALUE, rad or m; may be given again."] = None,
    failure: FailureOption = None,
    starts: Annotated[int, "How many random starts."] = 2000,
    grid: Annotated[int | None, "With two healthy joints, instead: a map of so many by so many starts."] = None,
    degrees: LockDegreesOption = False,
    law: LawOption = "pseudoinverse",
    task: TaskOption = None,
    seed: SeedOption = 0,
    chain: ArmSourceOptions = ArmSourceOptions(),
    output: OutputOptions = OutputOptions(),
) -> None:
    """Find which start configurations converge to the target after a lock.

    Example: holdfast basins planar-3r --target 1.5,1.5 --lock 2=45 --degrees --grid 80 --plot basins.png
    """
    control_law = read_law_for_arm(law, arm, task, chain)
    locked = read_locks(control_law.arm, lock, degrees, failure=failure)
    result = hf.basins(
        control_law, read_target(control_law.arm, control_law.task, target), locked, starts=starts, grid=grid, seed=seed
    )
    output.print_result(result)
