"""Presentation of falls of an arm that lost its power."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from holdfast.control.falls.fall import PowerLoss
from holdfast.control.falls.physical import PhysicalFall
from holdfast.control.falls.sweep import Sweep
from holdfast.core.formatting import capitalise_first, format_count, format_number
from holdfast.core.status import Status
from holdfast.interface import report
from holdfast.interface.presentation.collision.contacts import tabulate_contacts
from holdfast.interface.presentation.falls import motion
from holdfast.interface.presentation.holding import hold_check
from holdfast.interface.presentation.presentation import (
    Column,
    Fact,
    FigureSpec,
    Header,
    Notice,
    Presentation,
    TableSpec,
    make_headers,
)
from holdfast.interface.report.page import Section
from holdfast.kinematics.holding.static_check import holds
from holdfast.model.arm.friction import Friction

Others = Mapping[str, PowerLoss | PhysicalFall]
BAND_LABELS = ("without friction", "with twice the friction")
CHECKED_TIMES_S = (0.05, 0.1, 0.2, 0.5)
START_S = 1e-3  # duration over which the initial accelerations are measured
DROP_QUANTILES = (0.5, 0.9, 0.99)
WORST_ROWS = 10
MOST_SHOWN_POINTS = 1000  # of the surface of the sweep
MOST_MARKED_STOPS = 4
INACCURATE_FRACTION = 0.2  # of the drop: with a larger error, only the beginning of the fall is accurate
_FIGURE_CAPTION = "Drop, energy, and joint rates. Dots mark joints that reach a stop. Thick lines are from MuJoCo."


def to_dict(
    fall: PowerLoss, compared: Others | None = None, band: Sequence[PowerLoss] = (), sweep: Sweep | None = None
) -> dict[str, Any]:
    """Return the numbers of every fall, the drops of a single fall over time, other conditions, and the swept space."""
    names, others = fall.arm.joint_names, _name_others(compared, band)
    times = _list_checked_times(fall)
    return {
        **fall.arm.entry(),
        "free": [names[joint] for joint in fall.free],
        **{key: dict(zip(names, values, strict=True)) for key, values in vars(fall.friction).items()},
        "outcome": fall.outcome,
        "of": fall.of,
        "drop_m": fall.drop,
        "error_m": fall.error,
        "released_J": fall.released,
        "rest_time_s": fall.rest_time,
        "q": fall.q,
        "q_final": fall.q_final,
        "drops": [{"time_s": time, "drop_m": drop} for time, drop in zip(times, fall.drop_at(times), strict=True)]
        if fall.q.ndim == 1
        else None,
        "compared": {label: other.to_dict() for label, other in others.items()},
        "sweep": None
        if sweep is None
        else {
            "voxel_m": sweep.voxel,
            "volume_m3": [sweep.lower_volume, sweep.upper_volume],
            "boxes_m": dict(zip(sweep.links, sweep.boxes, strict=True)),
        },
    }


def present(
    fall: PowerLoss, compared: Others | None = None, band: Sequence[PowerLoss] = (), sweep: Sweep | None = None
) -> Presentation:
    """Present the fall, or the distribution of several falls.

    ``compared`` are falls from the same state under other conditions, by the name of the condition, and ``band`` without
    friction and with twice the friction. ``sweep`` is the space that this fall sweeps.
    """
    single, others = fall.q.ndim == 1, _name_others(compared, band)
    is_falling = single and fall.outcome not in ("holds", "unknown")
    touching = [other.contacts for other in others.values() if isinstance(other, PhysicalFall) and other.contacts]
    return Presentation(
        f"Power loss of {fall.arm.name}",
        f"{_compose_answer(fall, band)}." if single else _count_outcomes(fall),
        about=f"Arm {fall.arm.title}. {motion.describe_free_joints(fall)}.",
        notices=[
            *_list_notices(fall),
            *[Notice(f"{capitalise_first(contacts[0].sentence())}.", title="MuJoCo") for contacts in touching],
        ],
        facts=_list_facts(fall, sweep),
        tables=partial(_list_tables, fall, others) if single else [_tabulate_worst(fall)],
        figures={"fall": FigureSpec(partial(_draw_figure, fall, others), "Over time", _FIGURE_CAPTION)} if is_falling else {},
        sections=partial(_animate_fall, fall, others, sweep) if is_falling else tuple,
        method=[
            ("Simulation", f"{format_number(fall.duration, 3)} s, in steps of {1000 * np.max(fall.step):g} ms or less"),
            *motion.list_friction(fall),
            ("Stops", f"joint limits, with a restitution of {fall.restitution:g}" if fall.stops else "none"),
        ],
        arm=fall.arm,
    )


def _name_others(compared: Others | None, band: Sequence[PowerLoss]) -> Others:
    return {**(compared or {}), **dict(zip(BAND_LABELS, band, strict=False))}


def _list_checked_times(fall: PowerLoss) -> list[float]:
    return [time for time in CHECKED_TIMES_S if time <= fall.duration]


def _compose_answer(fall: PowerLoss, band: Sequence[PowerLoss]) -> str:
    contact = _describe_contact(fall)
    if fall.outcome == "unknown":
        return f"The fall was not simulated to its end: {Status(int(fall.status)).sentence}"
    if fall.outcome == "holds":
        return "The arm stays where it is, because friction and stops hold every joint without torque"
    answer = motion.describe_drop(fall)
    if contact:
        answer += f" until {contact}"
    elif np.isfinite(fall.rest_time):
        answer += f", and the arm is at rest after {format_number(float(fall.rest_time), 3)} s"
    else:
        answer += f" within {format_number(fall.duration, 3)} s, and the arm still moves then"
    if band:
        low, high = (motion.format_distance(pick(float(other.drop) for other in (fall, *band))) for pick in (min, max))
        answer += f"; from no friction to twice the friction: {low} to {high}"
    return answer


def _describe_contact(fall: PowerLoss) -> str:
    """Describe the first contact that ended a fall; empty if there is none."""
    contacts = fall.contacts
    contact = None if contacts is None else contacts.select_contact()
    if contacts is None or contact is None:
        return ""
    numbers = (contact.time, contacts.normal_speed, contacts.energy_lost)
    time, speed, energy = (format_number(float(number), 3) for number in numbers)
    return f"{contact.link} touches {contact.object} after {time} s, at {speed} m/s along the normal and with {energy} J"


def _count_outcomes(fall: PowerLoss) -> str:
    counts = zip(*np.unique(fall.outcome, return_counts=True), strict=True)
    answer = f"Outcomes of {format_count(len(fall), 'fall')}: {', '.join(f'{count:,} {name}' for name, count in counts)}."
    if np.isnan(fall.drop).all():
        return answer
    median, worst = (motion.format_distance(float(pick(fall.drop))) for pick in (np.nanmedian, np.nanmax))
    return f"{answer} The median drop is {median}, and the largest is {worst} (row {np.nanargmax(fall.drop)})."


def _list_notices(fall: PowerLoss) -> list[Notice]:
    friction, notices = fall.friction, []
    if not (friction.coulomb.any() or friction.stiction.any() or friction.load.any()):
        is_swinging = not friction.viscous.any() and np.any(fall.outcome == "moving")
        viscous = ", nor viscous friction, so the joints swing on" if is_swinging else ""
        notices.append(Notice(f"Neither the arm nor the options state dry friction{viscous}.", "note"))
    if np.any(fall.error > INACCURATE_FRACTION * fall.drop + 1e-3):
        notices.append(Notice("Small differences grow fast in a fall. Compare the estimated error with the drop."))
    return notices


def _list_facts(fall: PowerLoss, sweep: Sweep | None) -> list[Fact]:
    drops = 1000 * np.atleast_1d(fall.drop)[np.isfinite(np.atleast_1d(fall.drop))]
    if fall.q.ndim > 1:
        quantiles = zip(DROP_QUANTILES, np.quantile(drops, DROP_QUANTILES) if drops.size else (), strict=False)
        return [Fact(f"largest drop in {100 * fraction:g} % of the falls", float(drop), "mm") for fraction, drop in quantiles]
    name = f"largest {motion.name_drop(fall.of)}"
    facts = [
        Fact(name, 1000 * float(fall.drop), "mm", phrase=name),
        Fact("energy released", float(fall.released), "J", phrase="released until the end"),
        Fact("time to rest", float(fall.rest_time), "s", phrase="until the arm is at rest"),
        Fact("estimated error of the tool at the end", 1000 * float(fall.error), "mm", digits=2),
    ]
    facts = [fact for fact in facts if np.isfinite(fact.value)]
    if sweep is not None:
        volumes = " to ".join(format_number(1000 * volume, 3) for volume in (sweep.lower_volume, sweep.upper_volume))
        size = " x ".join(format_number(float(edge), 3) for edge in np.diff(sweep.box, axis=0)[0])
        facts += [Fact("volume that the links sweep", f"{volumes} L"), Fact("box around the sweep", f"{size} m")]
    return facts


def _list_tables(fall: PowerLoss, others: Others) -> Sequence[TableSpec]:
    if fall.outcome in ("holds", "unknown"):
        return [_tabulate_joints(fall)] if fall.outcome == "holds" else []
    times = np.array(_list_checked_times(fall))
    speeds = np.linalg.norm(np.einsum("tij,tj->ti", fall.arm.jacobian(fall.q_at(times))[:, :3], fall.rates_at(times)), axis=1)
    drops = zip([f"{1000 * time:g} ms" for time in times], 1000 * fall.drop_at(times), speeds, strict=True)
    drop = _make_drop_header(fall)
    columns: list[Column] = ["after", drop, Header("speed of the tool", "m/s")]
    title = "Drop over time" if fall.brakes is None else "Drop over time, with the brakes"
    tables = [TableSpec(title, columns, list(drops)), _tabulate_joints(fall)]
    if others:
        rows = [(label, 1000 * float(other.drop), str(other.outcome)) for label, other in others.items()]
        columns = ["condition", drop, "outcome"]
        tables.append(TableSpec("The same state under other conditions", columns, rows))
    physical = [other for other in others.values() if isinstance(other, PhysicalFall)]
    return tables + [tabulate_contacts(other.contacts) for other in physical if other.contacts]


def _make_drop_header(fall: PowerLoss) -> Header:
    return Header(motion.name_drop(fall.of), "mm", aligned=False)


def _tabulate_joints(fall: PowerLoss) -> TableSpec:
    arm, start_time = fall.arm, min(START_S, fall.duration)
    check = holds(arm, fall.q, free=fall.free, friction=Friction(**vars(fall.friction)), stops=fall.stops)
    accelerations = (fall.rates_at(start_time) - fall.rates) / start_time
    torques = [hold_check.format_torque_unit(joint) for joint in arm.joints]
    torque_columns = make_headers("gravity torque", "friction at rest", "margin", unit=torques)
    acceleration = Header("starts with", [f"{joint.unit}/s^2" for joint in arm.joints])
    notes = [hold_check.STOP_PHRASES[int(stop)] if k in fall.free else "held" for k, stop in enumerate(check.stop)]
    numbers = zip(check.torque, check.available, check.available - check.need, accelerations, strict=True)
    rows = [(name, *values, note) for name, values, note in zip(arm.joint_names, numbers, notes, strict=True)]
    return TableSpec("Joints at the power loss", ["joint", *torque_columns, acceleration, ""], rows)


def _tabulate_worst(fall: PowerLoss) -> TableSpec:
    columns: list[Column] = [
        "row",
        _make_drop_header(fall),
        Header("energy released", "J", aligned=False),
        Header("estimated error", "mm", digits=3, aligned=False),
        "outcome",
    ]
    worst = np.argsort(-np.nan_to_num(fall.drop, nan=-np.inf))[:WORST_ROWS]
    rows = [(int(k), 1000 * fall.drop[k], fall.released[k], 1000 * fall.error[k], str(fall.outcome[k])) for k in worst]
    return TableSpec("Falls with the largest drops", columns, rows)


def _find_end(fall: PowerLoss) -> float:
    """Return the time until which the motion is shown, s."""
    return fall.duration if not fall.rest_time > 0 else min(1.2 * float(fall.rest_time), fall.duration)


def _animate_fall(fall: PowerLoss, others: Others, sweep: Sweep | None) -> list[Section]:
    time = np.linspace(0.0, _find_end(fall), motion.FILM_FRAMES)
    motions = {"fall": fall.q_at(time)}
    for label, other in others.items():
        if isinstance(other, PhysicalFall):
            motions[label] = np.stack([np.interp(time, other.time, values) for values in other.q.T], axis=1)
    points = None if sweep is None else sweep.surface[:: 1 + len(sweep.surface) // MOST_SHOWN_POINTS]
    return [motion.build_film(fall, motions, time, points)]


def _draw_figure(fall: PowerLoss, others: Others) -> report.Figure:
    """Draw the drop, the energies, and the joint rates over time."""
    arm, time = fall.arm, np.linspace(0.0, _find_end(fall), 401)
    q, rates = fall.q_at(time), fall.rates_at(time)
    released, kinetic = fall.energies_at(time)
    energies = {"released": released, "kinetic": kinetic, "dissipated": released - kinetic}
    factors, units = zip(*[joint.display_unit for joint in arm.joints], strict=True)
    shown_rates = rates * factors
    is_at_stop = fall.stops & ((q <= arm.lower) | (q >= arm.upper))
    arrivals = sorted((int(is_at_stop[:, k].argmax()), k) for k in fall.free if is_at_stop[1:, k].any())
    stops = tuple(
        (float(time[row]), shown_rates[row - 1, k], f"joint {k + 1}") for row, k in arrivals[:MOST_MARKED_STOPS] if row
    )
    compared = [(other.time, 1000 * other.drops) for other in others.values() if isinstance(other, PhysicalFall)]
    speeds = {arm.joint_names[k]: shown_rates[:, k] for k in fall.free}
    label = f"joint rate, {' or '.join(sorted({f'{units[k]}/s' for k in fall.free}))}"
    panels = [
        report.motions.TimePanel(
            time, 1000 * fall.drop_at(time), f"{motion.name_drop(fall.of)}, mm", "Drop", compared=next(iter(compared), None)
        ),
        report.motions.TimePanel(time, energies, "energy, J", "Energy"),
        report.motions.TimePanel(time, speeds, label, "Joints", moments=stops),
    ]
    return report.motions.motion_figure(panels, f"{arm.name} without power, simulated", motion.TIME_LABEL)
