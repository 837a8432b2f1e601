"""``holdfast power-loss``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, cast

import typer

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.interface.cli.groups import ArmSourceOptions, ContactOptions, FrictionOptions, MountingOptions
from holdfast.interface.cli.options import (
    ArmArgument,
    DegreesOption,
    FreeOption,
    JsonOption,
    MotionCsvOption,
    OutOption,
    PlotOption,
    SeedOption,
)
from holdfast.interface.cli.values import read_configuration, read_numbers
from holdfast.interface.presentation.results import print_result, write_outputs

if TYPE_CHECKING:
    from numpy.typing import NDArray


def command(
    arm: ArmArgument,
    q: Annotated[str | None, "Joint values at the power loss in rad and m, separated by commas or spaces."] = None,
    along: Annotated[
        Path | None, "Motion (CSV with time_s and one column per joint) or recording: a power loss at each of its instants."
    ] = None,
    episode: Annotated[int, "Number of the episode of a recording, from 0."] = 0,
    anywhere: Annotated[bool, "Lose the power in random configurations, within the joint limits or --region."] = False,
    below: Annotated[float | None, "Limit whose probability --anywhere estimates, in the unit of --measure."] = None,
    measure: Annotated[str, "Measure: drop (m), released (J), impact_speed (m/s) or impact_energy (J)."] = "drop",
    region: Annotated[
        Path | None, "Region file (YAML) of joint values or tool poses, for --anywhere. Default: the joint limits."
    ] = None,
    samples: Annotated[int, "Number of random configurations."] = 20_000,
    seed: SeedOption = 1,
    of: Annotated[
        str, "Point whose drop is computed: 'tool', or 'any point' for the point of the arm that drops most."
    ] = "tool",
    rates: Annotated[str | None, "Joint rates at the power loss in rad/s and m/s. Default: the arm is at rest."] = None,
    free: FreeOption = None,
    friction: FrictionOptions = FrictionOptions(),
    brake_after: Annotated[list[float] | None, "Delay of the brakes in ms. Repeatable, to compare delays."] = None,
    brake_torque: Annotated[
        list[str] | None,
        "Torque of the brakes in N m (N): one number or one per joint. Repeatable, to compare torques. Default: --friction.",
    ] = None,
    restitution: Annotated[float, "Ratio of the joint speeds after and before the impact on a stop, 0 to 1."] = 0.0,
    stops: Annotated[bool, typer.Option("--stops/--no-stops", help="Let the joint limits stop the joints.")] = True,
    duration: Annotated[float, "Simulated time in s."] = 2.0,
    accuracy: Annotated[float | None, "Largest estimated error of the tool in m. Default: no limit, steps of 2 ms."] = None,
    band: Annotated[bool, "Also simulate without friction and with twice the friction."] = False,
    physics: Annotated[bool, "Also simulate in MuJoCo, beyond the first contact (needs the extra 'physics')."] = False,
    sweep: Annotated[bool, "Also compute the space that the links sweep during the fall from --q."] = False,
    touched: ContactOptions = ContactOptions(),
    placement: MountingOptions = MountingOptions(),
    degrees: DegreesOption = False,
    chain: ArmSourceOptions = ArmSourceOptions(),
    csv: MotionCsvOption = None,
    plot: PlotOption = None,
    out: OutOption = None,
    json_: JsonOption = False,
) -> None:
    """Simulate how the arm falls when its joints lose their torque.

    The joints fall under gravity, with friction, stops, and brakes, until the first contact with the environment. Give one
    configuration, --along a motion, or --anywhere.

    Example: holdfast power-loss panda --q "0 -45 0 -135 0 90 45" --degrees --coulomb 0.5 --brake-after 50 --brake-torque 40
    """
    if (q is not None) + (along is not None) + anywhere != 1:
        raise InputError("give one of --q, --along, and --anywhere")
    model = placement.mount_arm(chain.resolve_arm(arm))
    options: dict[str, Any] = {"free": free, "restitution": restitution, "stops": stops, "duration": duration}
    options |= {"accuracy": accuracy, "of": of, "friction": friction.read_friction(model)}
    options["clearance"] = touched.build_contact_clearance(model)
    delays, torques = _read_brakes(model, brake_after, brake_torque, friction.friction)
    result: Any
    others: dict[str, Any] = {}
    files: list[Path] = []
    has_several_brakes = len(delays) > 1 or len(torques) > 1
    if (csv is not None or band or physics or sweep) and (q is None or has_several_brakes):
        raise InputError("--csv, --band, --physics, and --sweep describe one fall; give --q, and at most one brake")
    if delays and not has_several_brakes:
        options["brakes"] = hf.Brakes(after=delays[0], torque=torques[0])
    if q is not None:
        start = read_configuration(model, q, degrees)
        options["rates"] = None if rates is None else read_configuration(model, rates, degrees, "--rates")
    if q is not None and has_several_brakes:
        result = hf.compare_brakes(model, start, torque=torques, after=delays, **options)
    elif has_several_brakes:
        raise InputError("several brakes are compared in one configuration; give --q")
    elif along is not None:
        time, motion = _read_motion(model, along, episode)
        result = hf.power_loss_along(model, motion, time, **options)
    elif anywhere:
        if below is None:
            raise InputError("--anywhere estimates the probability of a limit; give --below")
        where, choice = None if region is None else hf.Region.load(region), cast(Any, measure)
        result = hf.power_loss_probability(model, below, measure=choice, where=where, samples=samples, seed=seed, **options)
    else:
        result = hf.power_loss(model, start, **options)
        files += [] if csv is None else [result.to_csv(csv)]
        values = vars(result.friction)
        frictions = [hf.Friction(**{name: factor * values[name] for name in values}) for factor in (0, 2) if band]
        options["free"] = result.free
        others = {
            "compared": {"in MuJoCo": result.physical(clearance=options["clearance"])} if physics else {},
            "band": [hf.power_loss(model, start, **options | {"friction": other}) for other in frictions],
            "sweep": result.sweep() if sweep else None,
        }
    print_result(result, json_, [*files, *write_outputs(result, plot, out, **others)], **others)


def _read_brakes(
    arm: hf.Arm, after: list[float] | None, torque: list[str] | None, file: Path | None
) -> tuple[list[float], list[Any]]:
    """Return the delays, s, and the torques of the brakes to compare, from a friction file by default; empty without brakes."""
    if after is not None and torque is None and file is not None:
        return [delay / 1000 for delay in after], [hf.Brakes.from_file(file, arm, 0.0).torque]
    if (after is None) != (torque is None):
        raise InputError("--brake-after and --brake-torque describe brakes together; give both")
    numbers = [read_numbers("--brake-torque", text, "one number or one per joint") for text in torque or []]
    return [delay / 1000 for delay in after or []], [values[0] if values.size == 1 else values for values in numbers]


def _read_motion(arm: hf.Arm, path: Path, episode: int) -> tuple[NDArray[Any], NDArray[Any]]:
    """Return times (T,), s, and configurations (T, n), rad and m, of a CSV table of joint values or of a recording."""
    import numpy as np

    from holdfast.kinematics.paths.joint_table import is_motion_table, read_motion_table
    from holdfast.response.diagnosis import read_recording

    if is_motion_table(path):
        return read_motion_table(arm, path)
    recording = read_recording(path, episodes=[episode])
    recorded = recording.episodes[0].q
    if recording.unit is None or recorded.shape[1] != arm.n:
        raise InputError(
            f"'{path}' has {recorded.shape[1]} joints in {recording.unit or 'an unknown unit'}; '{arm.name}' has {arm.n}, in "
            "rad or deg; write the motion as a CSV table with time_s and one column per joint"
        )
    factors = np.where(arm.prismatic | (recording.unit == "rad"), 1.0, np.pi / 180)
    return recording.episodes[0].t, recorded * factors
