"""``holdfast index``."""

from __future__ import annotations

from holdfast.interface.cli.groups import ArmSourceOptions
from holdfast.interface.cli.measure_options import IndexOption
from holdfast.interface.cli.options import (
    ArmArgument,
    DegreesOption,
    FailuresOption,
    JsonOption,
    LengthOption,
    QOption,
    TaskOption,
)
from holdfast.interface.cli.values import read_configuration, read_failures, read_task
from holdfast.interface.presentation.printing import print_evaluations


def command(
    arm: ArmArgument,
    q: QOption,
    index: IndexOption = "relative-manipulability",
    task: TaskOption = None,
    failures: FailuresOption = "single",
    length: LengthOption = 1.0,
    degrees: DegreesOption = False,
    chain: ArmSourceOptions = ArmSourceOptions(),
    json_: JsonOption = False,
) -> None:
    """Compute a fault-tolerance index and its gradient at one configuration.

    Example: holdfast index pa10-9dof --index relative-manipulability --q "0 30 0 90 0 18 0 36 0" --degrees
    """
    from holdfast.interface.presentation.indices.console import index_values, show_index
    from holdfast.kinematics.indices.index import by_name

    model = chain.resolve_arm(arm)
    configurations = [read_configuration(model, text, degrees) for text in q]
    measure = by_name(index, model, read_task(task, arm, model), failures=read_failures(model, failures), length=length)
    print_evaluations(measure, configurations, json_, index_values, show_index)
