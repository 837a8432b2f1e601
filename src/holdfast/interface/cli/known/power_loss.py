"""``holdfast power-loss``."""

from __future__ import annotations

from typing import Annotated, Any

import typer

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.interface.cli.groups import ArmSourceOptions, ContactOptions, FrictionOptions, MountingOptions
from holdfast.interface.cli.options import ArmArgument, JsonOption, MotionCsvOption, OutOption, PlotOption
from holdfast.interface.cli.values import read_configuration, read_numbers
from holdfast.interface.presentation.results import print_result, write_outputs


def command(
    arm: ArmArgument,
    q: Annotated[str, "Joint values at the power loss in rad and m, separated by commas or spaces."],
    rates: Annotated[str | None, "Joint rates at the power loss in rad/s and m/s. Default: the arm is at rest."] = None,
    free: Annotated[str | None, "Joints that lose their torque, by name or number, comma-separated. Default: all."] = None,
    friction: FrictionOptions = FrictionOptions(),
    brake_after: Annotated[list[float] | None, "Delay of the brakes in ms. Repeatable, to compare delays."] = None,
    brake_torque: Annotated[str | None, "Torque of the brakes in N m (N): one number or one per joint."] = None,
    restitution: Annotated[float, "Ratio of the joint speeds after and before the impact on a stop, 0 to 1."] = 0.0,
    stops: Annotated[bool, typer.Option("--stops/--no-stops", help="Let the joint limits stop the joints.")] = True,
    duration: Annotated[float, "Simulated time in s."] = 2.0,
    accuracy: Annotated[float | None, "Largest estimated error of the tool in m. Default: no limit, steps of 2 ms."] = None,
    band: Annotated[bool, "Also simulate without friction and with twice the friction."] = False,
    physics: Annotated[bool, "Also simulate in MuJoCo, with contacts (needs the extra 'physics')."] = False,
    touched: ContactOptions = ContactOptions(),
    placement: MountingOptions = MountingOptions(),
    degrees: Annotated[bool, "Read --q and --rates in degrees (prismatic joints: m)."] = False,
    chain: ArmSourceOptions = ArmSourceOptions(),
    csv: MotionCsvOption = None,
    plot: PlotOption = None,
    out: OutOption = None,
    json_: JsonOption = False,
) -> None:
    """Simulate how the arm falls when its joints lose their torque.

    The joints fall under gravity, with friction, stops, and brakes. A brake does not stop a joint at once, so the tool drops
    further after the delay.

    Example: holdfast power-loss panda --q "0 -45 0 -135 0 90 45" --degrees --coulomb 0.5 --brake-after 50 --brake-torque 40
    """
    model = placement.mount_arm(chain.resolve_arm(arm))
    stated = friction.read_friction(model)
    options: dict[str, Any] = {"free": free, "restitution": restitution, "stops": stops, "duration": duration}
    options |= {"accuracy": accuracy, "rates": None if rates is None else read_configuration(model, rates, degrees, "--rates")}
    start = read_configuration(model, q, degrees)
    brakes = _read_brakes(brake_after, brake_torque)
    clearance = touched.build_contact_clearance(model)
    if clearance is not None and not physics:
        raise InputError("--cell applies to the simulation in MuJoCo; add --physics")

    def simulate(joint_friction: hf.Friction, joint_brakes: hf.Brakes | None) -> hf.PowerLoss:
        return hf.power_loss(model, start, friction=joint_friction, brakes=joint_brakes, **options)

    fall = simulate(stated, brakes[0] if brakes else None)
    compared: dict[str, Any] = {}
    if len(brakes) > 1:
        compared = {f"brakes after {1000 * each.after:g} ms": simulate(stated, each) for each in brakes}
    if physics:
        compared["in MuJoCo"] = fall.physical(clearance=clearance)
    files = [] if csv is None else [fall.to_csv(csv)]
    factors = (0, 2) if band else ()
    frictions = [hf.Friction(**{name: factor * values for name, values in vars(fall.friction).items()}) for factor in factors]
    others: dict[str, Any] = {"compared": compared, "band": [simulate(other, fall.brakes) for other in frictions]}
    print_result(fall, json_, [*files, *write_outputs(fall, plot, out, **others)], **others)


def _read_brakes(after: list[float] | None, torque: str | None) -> list[hf.Brakes]:
    if (after is None) != (torque is None):
        raise InputError("--brake-after and --brake-torque describe one set of brakes; give both")
    if after is None or torque is None:
        return []
    numbers = read_numbers("--brake-torque", torque, "one number or one per joint")
    return [hf.Brakes(after=delay / 1000, torque=numbers[0] if numbers.size == 1 else numbers) for delay in after]
