"""Presentation of stow configurations and of the paths to them."""

from __future__ import annotations

from functools import partial
from typing import Any

from holdfast.core.formatting import format_number
from holdfast.interface.presentation.arm.view import build_view_section
from holdfast.interface.presentation.falls.drop_curve import build_film, draw_curves
from holdfast.interface.presentation.falls.motion import describe_drop, format_distance, list_friction
from holdfast.interface.presentation.holding import hold_check
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Notice, Presentation
from holdfast.interface.report.page import Section
from holdfast.response.stowing.path import StowPath
from holdfast.response.stowing.pose import RESTING_RUNS, StowPose


def to_dict(result: StowPose | StowPath) -> dict[str, Any]:
    """Return the stow configuration with its margins, and the path with its drops."""
    stow = result if isinstance(result, StowPose) else result.stow
    data = {
        **stow.arm.entry(),
        "q": stow.q,
        "holds": stow.holds,
        "required_factor": stow.factor,
        "factor": stow.check.factor,
        "margin": stow.check.margin,
        "drop_m": stow.fall.drop,
        "resting": None if stow.resting is None else stow.resting.to_dict(),
        "duration_s": stow.duration,
        "found": stow.found,
        "samples": stow.samples,
    }
    if isinstance(result, StowPath):
        data["path"] = {
            "found": result.is_found,
            "q": result.q,
            "time_s": result.time,
            "bound_m": result.bound,
            "monotone": result.monotone,
            "speed_fraction": result.speed_fraction,
            **{
                name: None
                if curve is None
                else {"largest_drop_m": curve.drop.max(), "exposure_m_s": curve.exposure, "drop_m": curve.drop}
                for name, curve in (("along", result.curve), ("straight", result.straight))
            },
        }
    return data


def present(result: StowPose | StowPath) -> Presentation:
    """Present the configuration with the balance of each joint, and the drops along the path."""
    stow = result if isinstance(result, StowPose) else result.stow
    arm, check = stow.arm, hold_check.present(stow.check)
    values = zip(stow.q, arm.joints, strict=True)
    configuration = ", ".join(f"{q * joint.display_unit[0]:.4g} {joint.display_unit[1]}" for q, joint in values)
    path = result if isinstance(result, StowPath) else None
    curves = {} if path is None or path.curve is None else {"this path": path.curve}
    if path is not None and path.straight is not None:
        curves["straight line"] = path.straight
    return Presentation(
        f"Stow configuration of {arm.name}",
        " ".join([_describe_stow(stow), *([] if path is None else [_describe_path(path)])]),
        about=f"Arm {arm.title}. Configuration {configuration}",
        notices=[
            *check.notices,
            *([] if stow.holds else [Notice("Friction and stops do not hold the arm in this configuration.", "bad")]),
        ],
        facts=[
            *check.facts,
            *([] if stow.duration is None else [Fact("time to get there, straight", stow.duration, "s")]),
            *([] if path is None else _list_path_facts(path)),
        ],
        tables=check.tables,
        figures={"drop": FigureSpec(partial(draw_curves, curves), "Drop over the instant of the power loss")} if curves else {},
        sections=partial(_build_view, result),
        method=[
            ("Search", f"{stow.samples:,} configurations, seed {stow.seed}; {stow.found} of the best 200 hold"),
            ("Drops along the path", "simulated at sampled instants, with the joint rates, until the first contact"),
            *list_friction(stow.fall),
        ],
        arm=arm,
    )


def _describe_stow(stow: StowPose) -> str:
    if not stow.holds:
        answer = f"No configuration was found that holds with {format_number(stow.factor)} times the needed torque"
        if stow.resting is None:
            return f"{answer}; the one with the smallest drop is shown. {describe_drop(stow.fall)}."
        touched = ", ".join(dict.fromkeys(contact.object for contact in stow.resting.contacts or ())) or "nothing"
        return (
            f"{answer}. The one shown was found by simulating {RESTING_RUNS} falls in MuJoCo, which is no proof. "
            f"{describe_drop(stow.resting)}, and the arm then lies still, in contact with {touched}."
        )
    return hold_check.present(stow.check).answer


def _describe_path(path: StowPath) -> str:
    if path.curve is None:
        kind = " on which the drop hardly rises" if path.monotone else ""
        return f"No path{kind} with drops of at most {format_distance(path.bound)} was found, which is no proof."
    speed = "" if path.speed_fraction == 1 else f", at {path.speed_fraction:g} of full speed"
    sentence = (
        f"The path takes {format_number(path.time[-1], 3)} s{speed}, and the tool drops at most "
        f"{format_distance(float(path.curve.drop.max()))} on it"
    )
    if path.straight is None:
        return f"{sentence}; the straight line is in collision."
    return f"{sentence}; on the straight line it is {format_distance(float(path.straight.drop.max()))}."


def _list_path_facts(path: StowPath) -> list[Fact]:
    curves = [("path", path.curve), ("straight line", path.straight)]
    return [Fact(f"exposure, {name}", 1000 * curve.exposure, "mm s") for name, curve in curves if curve is not None]


def _build_view(result: StowPose | StowPath) -> list[Section]:
    if isinstance(result, StowPose) or result.curve is None:
        stow = result if isinstance(result, StowPose) else result.stow
        return [build_view_section("The stow configuration", stow.arm, stow.q, "The arm in its stow configuration.")]
    return build_film(result.curve, "The path to the stow configuration")
