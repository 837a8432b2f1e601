"""Falls of an arm that loses the torque of its joints, for one state or many."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.control.falls.brakes import Brakes
from holdfast.control.falls.contact import REQUIRED_GAP_M, ContactSearch, FallContacts, collect_contact_fields
from holdfast.control.falls.drop_points import DropOf, DropPoints
from holdfast.control.falls.fall import MAX_STEP_S, FallOutcome, PowerLoss
from holdfast.control.falls.passive_arm import energy_kernel
from holdfast.control.falls.simulator import FallSimulator, FallStates
from holdfast.control.simulation.system import LARGE_NUMBER
from holdfast.core.errors import ArmError, InputError
from holdfast.core.progress import reports_progress
from holdfast.core.status import Status
from holdfast.core.typing import BoolArray, FloatArray, IndexArray, Rows
from holdfast.core.validation import check_arguments, require_real_numbers
from holdfast.kinematics.holding.static_check import STOP_TOLERANCE
from holdfast.model.arm.configurations import as_configurations
from holdfast.model.arm.friction import Friction
from holdfast.model.arm.model import Arm
from holdfast.model.arm.soundness import require_possible_inertia
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import CellLike, chosen_clearance
from holdfast.model.failure_modes.sets import JointSet, read_joint_set

STIFF_RATIO = 1.0  # of viscous friction times the step to the inertia, above which explicit steps may diverge
MOST_HALVINGS = 6  # of the time step, for the requested accuracy
NEGLIGIBLE_INERTIA_FRACTION = 1e-12  # of the inertia about a joint that the other joints leave to it


@check_arguments
@reports_progress("simulating power losses")
def power_loss(
    arm: Arm,
    q: ArrayLike,
    rates: ArrayLike | None = None,
    *,
    free: JointSet = None,
    friction: Friction | None = None,
    brakes: Brakes | None = None,
    restitution: float = 0.0,
    stops: bool = True,
    duration: float = 2.0,
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
    step: float = 2e-3,
    accuracy: float | None = None,
    of: DropOf = "tool",
) -> PowerLoss:
    """Simulate how an arm falls after its joints lose their torque.

    From time 0 on the joints in ``free`` transmit only friction. All other joints are held exactly. With dry friction or stops
    the steps have order 2 and contain stiction, impacts on the stops, and brakes; otherwise they have order 4. With a cell or a
    clearance, a fall ends at the first contact of the arm with an object or with itself. Spheres and capsules enclose the
    links, so contacts come early rather than late. A frictionless arm without stops is chaotic: after about a second its
    ``error`` may be as large as the arm.

    Args:
        arm: The arm, with inertial data for every link.
        q: (n,) configuration or (N, n) configurations at the power loss, rad and m. A joint within 1e-4 rad or m outside its
            limit starts at the limit.
        rates: (n,) or (N, n) joint rates at the power loss, rad/s and m/s. Default: all joints are at rest.
        free: Joints that lose their torque: names and indices from 0, or one text with names and numbers from 1 between
            commas, and ``board:NAME`` for a board of the friction. Default: all joints.
        friction: Friction of the joints. Default: as the arm states.
        brakes: Brakes of the joints in ``free``. Default: none.
        restitution: Ratio of the speeds of a joint after and before it hits its stop, 0 to 1.
        stops: True if the limits of the arm stop its joints.
        duration: Simulated time, s. A fall ends earlier if all joints are at rest, and at its first contact.
        clearance: Collision model of the arm, with or without a cell; True: the default model; False: the arm is not checked
            against itself. None without a cell: contacts are not simulated.
        cell: Objects around the arm, or their file.
        step: Longest time step, s, at most 0.02 s.
        accuracy: Largest ``error`` of a fall, m. The step of a fall is halved up to 6 times to reach it; falls that do not
            reach it have the status ``INACCURATE``. Default: the step is not changed.
        of: Point whose drop is computed: ``tool``; or ``any point`` for the one that drops most, of the tool point and the
            centers of the spheres that cover the links in the collision model.

    Returns:
        A :class:`holdfast.PowerLoss`. A row with NaN has the status ``BAD_INPUT``.

    Raises:
        InputError: An argument is wrong, a configuration is outside the limits that stop the arm or inside an object of the
            cell, or a held joint moves.
        ArmError: Inertial data are missing or impossible, or a free joint carries no inertia.

    Source: Moreau 1988 for the steps with dry friction and impacts.
    """
    starts, start_rates, is_single = _check_states(arm, q, rates)
    joints = read_joint_set(arm, free, (friction or Friction()).boards)
    _check_options(restitution, duration, step, accuracy)
    require_possible_inertia(arm)
    is_free = np.zeros(arm.n)
    is_free[list(joints)] = 1.0
    is_finite = np.isfinite(starts).all(axis=1) & np.isfinite(start_rates).all(axis=1)
    _check_held_rates(arm, start_rates[is_finite], is_free)
    if stops:
        _check_limits(arm, starts[is_finite], np.flatnonzero(is_finite), is_free)
        starts = np.where(is_free == 1, np.clip(starts, arm.lower, arm.upper), starts)
    joint_friction = (friction or Friction()).of_joints(arm)
    no_brakes = {"brake_torque": np.zeros(arm.n), "brake_damping": np.zeros(arm.n)}
    conditions: dict[str, FloatArray | float] = {
        **vars(joint_friction),
        **(no_brakes if brakes is None else brakes.of_joints(arm)),
        "brake_time": LARGE_NUMBER if brakes is None else brakes.after,
        "restitution": restitution,
        "free": is_free,
    }
    inertia = _require_inertia(arm, starts[is_finite], joints)
    damping = np.asarray(conditions["viscous"]) + conditions["brake_damping"]
    is_stiff = bool((damping[list(joints)] * step > STIFF_RATIO * inertia).any())
    steps = np.full(len(starts), float(step))
    rows = np.flatnonzero(is_finite)
    model = chosen_clearance(arm, clearance, cell, looks=False)
    points = DropPoints.choose(arm, of, None if model is None else model.capsules)
    simulator = FallSimulator(arm, stops, conditions, is_stiff, points)
    search = None if model is None else ContactSearch(simulator, model, starts[rows], duration)
    initial = None if search is None else search.find_touching(starts[rows])
    if model is not None and initial is not None:
        _check_start_contacts(model, starts[rows], rows, initial)
    runner = search or simulator
    states, errors, steps[rows] = _simulate(simulator, runner, starts[rows], start_rates[rows], duration, steps[rows], accuracy)
    fields = _collect_fields(simulator, starts[rows], start_rates[rows], states)
    fields["status"] = np.where(states.is_finished, Status.OK, Status.INACCURATE).astype(np.uint8)
    if accuracy is not None:
        fields["status"][~(errors <= accuracy)] = Status.INACCURATE
    fields["status"][~np.isfinite(states.q).all(axis=1)] = Status.NO_INERTIA
    fields["code"][~states.is_finished | (fields["status"] == Status.NO_INERTIA)] = FallOutcome.UNKNOWN
    values = {name: _spread_rows(value, rows, len(starts)) for name, value in fields.items()}
    values["status"][~is_finite] = Status.BAD_INPUT
    values["code"][~is_finite] = FallOutcome.UNKNOWN
    values |= {"q": starts, "rates": start_rates, "step": steps}
    contacts: Rows = {}
    if search is not None and initial is not None:
        contacts = collect_contact_fields(search, initial, states)
        contacts = {name: _spread_rows(value, rows, len(starts)) for name, value in contacts.items()}
        contacts["pair"][~is_finite] = -1
    if is_single:
        values, contacts = ({name: value[0] for name, value in part.items()} for part in (values, contacts))
    return PowerLoss(
        arm=arm,
        free=joints,
        friction=joint_friction,
        brakes=brakes,
        restitution=float(restitution),
        stops=stops,
        duration=float(duration),
        of=of,
        contacts=None if model is None else FallContacts(pair_names=tuple(model.pair_names), **contacts),
        clearance=model,
        _simulator=simulator,
        **values,
    )


def _simulate(
    simulator: FallSimulator,
    runner: FallSimulator | ContactSearch,
    q: FloatArray,
    rates: FloatArray,
    duration: float,
    step: FloatArray,
    accuracy: float | None,
) -> tuple[FallStates, FloatArray, FloatArray]:
    """Return the states at the end, the errors (N,) that decide over the steps, m, and the steps (N,), s."""
    until = np.full(len(q), float(duration))
    states = runner.run(q, rates, until, step)
    if accuracy is None:
        return states, np.zeros(len(q)), step
    coarse_tool = simulator.run(q, rates, np.where(states.pair < 0, until, states.time), 2 * step).tool
    errors = 2 * np.linalg.norm(states.tool - coarse_tool, axis=1)
    for _ in range(MOST_HALVINGS):
        rows = np.flatnonzero(~(errors <= accuracy))
        if not rows.size:
            break
        step[rows] /= 2
        finer, coarse_tool = runner.run(q[rows], rates[rows], until[rows], step[rows]), states.tool[rows]
        if runner is not simulator:  # the times of the contacts differ
            ends = np.where(finer.pair < 0, until[rows], finer.time)
            coarse_tool = simulator.run(q[rows], rates[rows], ends, 2 * step[rows]).tool
        errors[rows] = 2 * np.linalg.norm(finer.tool - coarse_tool, axis=1)
        for name, value in vars(states).items():
            value[rows] = getattr(finer, name)
    return states, errors, step


def _collect_fields(simulator: FallSimulator, q: FloatArray, rates: FloatArray, states: FallStates) -> Rows:
    """Return the fields of the result for falls from q (N, n)."""
    potential, kinetic = simulator.energies(q, rates)
    is_still = states.is_at_rest & (states.time == 0)
    cases = {FallOutcome.CONTACT: states.pair >= 0, FallOutcome.HOLDS: is_still, FallOutcome.REST: states.is_at_rest}
    outcome = np.select([*cases.values()], [*cases], FallOutcome.MOVING)
    return {
        "q_final": states.q,
        "rates_final": states.rates,
        "drop": states.drop,
        "released": potential + kinetic - simulator.energies(states.q, states.rates)[0],
        "rest_time": np.where(states.is_at_rest, states.time, np.nan),
        "code": outcome.astype(np.uint8),
        "residual": states.residual,
    }


def _spread_rows(values: NDArray[Any], rows: IndexArray, count: int) -> NDArray[Any]:
    """Return an array of ``count`` rows with these values in the given rows and NaN, or 0 for integers, in all others."""
    spread = np.full((count, *values.shape[1:]), np.nan if values.dtype.kind == "f" else 0, dtype=values.dtype)
    spread[rows] = values
    return spread


# ---- input -------------------------------------------------------------------------------------------------------


def _check_states(arm: Arm, q: ArrayLike, rates: ArrayLike | None) -> tuple[FloatArray, FloatArray, bool]:
    """Return configurations and rates (N, n), and whether both were single."""
    starts, is_single = as_configurations(arm, q)
    if rates is None:
        return starts, np.zeros_like(starts), is_single
    start_rates = require_real_numbers(rates, "rates")
    if start_rates.shape not in ((arm.n,), starts.shape, (len(starts), arm.n)) and not (
        is_single and start_rates.ndim == 2 and start_rates.shape[1] == arm.n
    ):
        raise InputError(f"rates has shape {start_rates.shape}; it must be ({arm.n},) or that of q, {np.shape(q)}")
    if start_rates.ndim == 1 and not np.isfinite(start_rates).all():
        raise InputError(f"rates for '{arm.name}' holds NaN or infinity; give {arm.n} finite numbers")
    is_single = is_single and start_rates.ndim == 1
    rows = max(len(starts), len(np.atleast_2d(start_rates)))
    return np.broadcast_to(starts, (rows, arm.n)), np.broadcast_to(start_rates, (rows, arm.n)), is_single


def _check_options(restitution: float, duration: float, step: float, accuracy: float | None) -> None:
    if not 0 <= restitution <= 1:
        raise InputError(f"restitution is {restitution:g}; it must be from 0 (no rebound) to 1 (no loss)")
    if not (np.isfinite(duration) and duration > 0):
        raise InputError(f"duration is {duration:g} s; it must be a finite number above 0")
    if not 0 < step <= MAX_STEP_S:
        raise InputError(f"step is {step:g} s; it must be above 0 and at most {MAX_STEP_S:g} s")
    if accuracy is not None and not accuracy > 0:
        raise InputError(f"accuracy is {accuracy:g} m; it must be above 0")


def _check_held_rates(arm: Arm, rates: FloatArray, is_free: FloatArray) -> None:
    moving = np.argwhere((rates != 0) & (is_free == 0))
    if moving.size:
        row, joint = moving[0]
        raise InputError(
            f"rates moves joint '{arm.joint_names[joint]}' at {rates[row, joint]:g} {arm.joints[joint].unit}/s, which is held; "
            "give it the rate 0, or add it to free"
        )


def _check_limits(arm: Arm, q: FloatArray, rows: IndexArray, is_free: FloatArray) -> None:
    outside = np.argwhere((np.maximum(arm.lower - q, q - arm.upper) > STOP_TOLERANCE) & (is_free == 1))
    if outside.size:
        row, joint = outside[0]
        excess = max(arm.lower[joint] - q[row, joint], q[row, joint] - arm.upper[joint])
        unit = arm.joints[joint].unit
        raise InputError(
            f"q puts joint '{arm.joint_names[joint]}' {excess:.4g} {unit} outside its limits {arm.lower[joint]:g} to "
            f"{arm.upper[joint]:g} {unit}" + (f" in row {rows[row]}" if len(q) > 1 else "") + "; start inside them, or give "
            "stops=False"
        )


def _check_start_contacts(clearance: Clearance, q: FloatArray, rows: IndexArray, touching: BoolArray) -> None:
    if clearance.obstacles is None:
        return
    inside = np.flatnonzero(touching[:, len(clearance.pairs) :].any(axis=1))
    inside = inside[clearance.obstacles.smallest_distance(q[inside]) < -REQUIRED_GAP_M]
    if inside.size:
        distances = clearance.obstacles.pair_distances(q[inside[:1]])[0]
        link, _, name = clearance.obstacles.names[distances.argmin()].partition(" & ")
        raise InputError(
            f"q puts link '{link}' {-distances.min():.3g} m into object '{name}' of the cell"
            + (f" in row {rows[inside[0]]}" if len(q) > 1 else "")
            + "; start outside it, or add the pair to may_touch of the cell"
        )


def _require_inertia(arm: Arm, q: FloatArray, joints: tuple[int, ...]) -> FloatArray:
    """Return the inertia (F,) that each free joint has whatever the free joints behind it do, and require that it has some."""
    moved = np.full(len(joints), np.inf)
    if not len(q):
        return moved
    inertia = energy_kernel(arm).rows(q[:1])[0, 1:].reshape(arm.n, arm.n)
    for index in reversed(range(len(joints))):
        joint, later = joints[index], list(joints[index + 1 :])
        own = float(inertia[joint, joint])
        remaining = own
        if later:
            coupling = inertia[joint, later]
            remaining = own - float(coupling @ np.linalg.solve(inertia[np.ix_(later, later)], coupling))
        if not remaining > NEGLIGIBLE_INERTIA_FRACTION * max(own, inertia.trace()):
            raise ArmError(
                f"arm '{arm.name}', joint '{arm.joint_names[joint]}': its links have no inertia that resists its motion, so "
                "its acceleration is not defined; give the links their inertia or the joint its armature"
            )
        moved[index] = remaining
    return moved
