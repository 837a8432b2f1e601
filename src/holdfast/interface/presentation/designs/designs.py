"""Presentation of a search for arm designs with a large quantile of an index."""

from __future__ import annotations

import csv
import math
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.files.output import open_replacement, replace_file
from holdfast.core.formatting import format_count, format_number, format_percent, indefinite_article, list_alternatives
from holdfast.interface import report
from holdfast.interface.presentation.commands import format_region_file
from holdfast.interface.presentation.designs import sections
from holdfast.interface.presentation.designs.figures import draw_before_and_after, draw_pareto_front
from holdfast.interface.presentation.designs.parameters import ARM_FILE, list_bound_notices, tabulate_parameters
from holdfast.interface.presentation.presentation import Column, Fact, FigureSpec, Header, Notice, Presentation, TableSpec
from holdfast.studies.designs.designs import (
    SAME_VALUE_TOLERANCE,
    Designs,
    HeldOutResult,
    describe_farther_design,
    format_level,
    format_value_interval,
)

_MAX_FRONT_DESIGNS = 10  # designs of the Pareto front in the table
_NOTABLE_LOSS = 0.005  # fraction of the poses


def to_dict(designs: Designs) -> dict[str, Any]:
    """Return the baseline arm and the best design as JSON data, in rad, m, and fractions."""

    def describe_arm(number: int, checked: HeldOutResult) -> dict[str, Any]:
        return {
            "values": dict(zip(designs.space.names, designs.values[number].tolist(), strict=True)),
            "guaranteed_in_search": float(designs.guaranteed[number]),
            "guaranteed": asdict(checked.guaranteed),
            "median": float(checked.distribution.quantile(0.5, reachable_only=False)),
            "reached": 1 - checked.distribution.unreached_share,
            "reach": float(designs.reach[number]),
        }

    return {
        **designs.space.arm.entry(),
        "index": designs.index.label,
        "task": designs.index.task.name,
        "region": designs.region.name,
        "level": designs.level,
        "bound": designs.index.bound,
        "poses": designs.poses,
        "fresh_poses": designs.checked.best.distribution.samples,
        "designs": len(designs.values),
        "given": describe_arm(0, designs.checked.given),
        "best": describe_arm(designs.best, designs.checked.best),
        "optimism": designs.checked.optimism,
        "front": [
            {
                "reach": float(designs.reach[design]),
                "guaranteed": float(designs.guaranteed[design]),
                "values": dict(zip(designs.space.names, designs.values[design].tolist(), strict=True)),
            }
            for design in designs.front.tolist()
        ],
        "seed": designs.seed,
    }


def present(designs: Designs) -> Presentation:
    """Present the best design, its gain over the baseline arm, and its reach."""
    space, index, best_values = designs.space, designs.index, designs.values[designs.best]
    given, best = designs.checked.given, designs.checked.best
    level_text = format_level(designs.level)
    median, given_median = (float(held_out.distribution.quantile(0.5, reachable_only=False)) for held_out in (best, given))
    best_name = "the baseline arm" if designs.best_is_start else "the best design"
    quantile_label = f"smallest index of the best {level_text} of the held-out poses"
    facts = [Fact("", format_number(best.guaranteed.value), phrase=f"{quantile_label}, {best_name}")]
    if not designs.best_is_start:
        facts.append(Fact("", format_number(given.guaranteed.value), phrase=f"{quantile_label}, the baseline arm"))
    facts.append(Fact("", format_number(median), phrase=f"median over the held-out poses, {best_name}"))
    reach_text = f"reach of {best_name}; that of the baseline arm is {format_number(designs.start_reach)} m"
    facts.append(Fact("", f"{format_number(float(designs.reach[designs.best]))} m", phrase=reach_text))
    value_rows = [
        (
            f"{index.name} of {level_text} of the poses, at least",
            *map(format_value_interval, (given.guaranteed, best.guaranteed)),
        ),
        ("median", format_number(given_median), format_number(median)),
        ("poses reached", *(format_percent(1 - held_out.distribution.unreached_share) for held_out in (given, best))),
        ("reach, m", f"{designs.start_reach:.3f}", f"{designs.reach[designs.best]:.3f}"),
    ]
    value_columns = ["", "baseline arm", "best design"]
    search_value = float(designs.guaranteed[designs.best])
    front_reach = f"{designs.reach[designs.front[0]]:.4g} to {designs.reach[designs.front[-1]]:.4g} m"
    figures = {
        "front": FigureSpec(
            partial(_draw_front, designs),
            "Index quantile against reach",
            f"Index quantile: worst-case {index.name} that {level_text} of the {format_count(designs.poses, 'pose')} of the "
            "search have at least, each at its best configuration; a pose that is not reached counts as 0. Reach: largest "
            "distance of the tool point from the origin of the base frame within the joint limits.",
            saved=False,
        )
    }
    if not designs.best_is_start:
        caption = (
            "Each arm with its tool at the centre of the region (dashed), or at the centre of its joint limits if it cannot "
            "reach it. Circles are revolute joints, squares prismatic joints, the orange diamond is the tool. Equal scales."
        )
        draw = partial(draw_before_and_after, space.arm, designs.arm(designs.best), index.task, designs.region, designs.seed)
        figures["arms"] = FigureSpec(draw, "Before and after", caption, saved=False)
    exports = {ARM_FILE: partial(_write_arm, designs), "designs.csv": partial(_write_designs, designs)}
    return Presentation(
        f"Designs of {space.arm.name}",
        _compose_answer(designs),
        about=f"{designs.region.name}; {', '.join(space.names)}",
        lines=[
            f"{len(designs.values):,} designs were tried; {len(designs.front)} of them are on the Pareto front of reach and "
            f"{index.name}, with a reach of {front_reach}.",
            f"The best design keeps {format_number(search_value)} on the {format_count(designs.poses, 'pose')} of the search "
            f"and {format_number(best.guaranteed.value)} on held-out poses. The difference, "
            f"{format_number(search_value - best.guaranteed.value)}, is the selection bias.",
        ],
        notices=[] if designs.best_is_start else [*list_bound_notices(space, best_values), *_list_lost_poses(designs)],
        facts=facts,
        tables=[
            TableSpec(
                f"On {best.distribution.samples:,} held-out poses, which the search did not use", value_columns, value_rows
            ),
            tabulate_parameters(space, best_values),
            _tabulate_front(designs),
        ],
        figures=figures,
        sections=partial(sections.build_sections, designs),
        method=_list_methods(designs),
        arm=space.arm,
        again=partial(sections.build_rerun_blocks, designs),
        exports=exports | _list_region_files(designs),
    )


def _compose_answer(designs: Designs) -> str:
    """Compose the answer in one or two sentences."""
    baseline, best = designs.checked.given, designs.checked.best
    baseline_text, best_text = format_value_interval(baseline.guaranteed), format_value_interval(best.guaranteed)
    index_name, level_text = designs.index.name, format_level(designs.level)
    if not best.guaranteed.value > 0 and not baseline.guaranteed.value > 0:
        return (
            f"For every design found within these bounds, the {index_name} that {level_text} of the poses of the region keep "
            "is 0: too many poses are not reached, or some joint is a single point of failure. Widen the bounds, or use a "
            "smaller region or level."
        )
    farther_text = describe_farther_design(designs.guaranteed, designs.reach, designs.best)
    if designs.best_is_start:
        answer = (
            f"No design better than the baseline arm was found: at {level_text} of the poses of the region its "
            f"{index_name} is at least {baseline_text}, {_describe_failures(designs)}."
        )
        return f"{answer} {farther_text}".rstrip()
    if designs.guaranteed[designs.best] <= (1 + SAME_VALUE_TOLERANCE) * designs.start_guaranteed:
        return (
            f"No design with a larger {index_name} than the baseline arm was found, but the best design is as good, with at "
            f"least {best_text} at {level_text} of the poses (baseline arm {baseline_text}), and reaches "
            f"{designs.reach[designs.best]:.3f} m instead of {designs.start_reach:.3f} m. {farther_text}"
        ).rstrip()
    if best.guaranteed.value <= baseline.guaranteed.value:
        return (
            f"No gain was found that holds on held-out poses: the best design has a {index_name} of at least "
            f"{format_number(float(designs.guaranteed[designs.best]))} on the {format_count(designs.poses, 'pose')} of the "
            f"search, but {best_text} on held-out poses, where the baseline arm has {baseline_text}. Search with more poses."
        )
    reaches = f"The reach changes from {designs.start_reach:.3f} m to {designs.reach[designs.best]:.3f} m."
    return (
        f"For {level_text} of the poses of the region the best design keeps {indefinite_article(index_name)} {index_name} of "
        f"at least {best_text}, {_describe_failures(designs)}; the baseline arm keeps {baseline_text}. {reaches} {farther_text}"
    ).rstrip()


def _describe_failures(designs: Designs) -> str:
    """Describe the considered failures in a phrase that follows a verb."""
    sizes = {len(failed) for failed in designs.index.failures}
    if len(sizes) > 1 or len(designs.index.failures) != math.comb(designs.space.arm.n, min(sizes)):
        return "after any of the failures considered"
    return "whichever joint locks" if sizes == {1} else f"whichever {min(sizes)} joints lock together"


def _list_lost_poses(designs: Designs) -> list[Notice]:
    """Return a notice if the best design reaches notably fewer poses than the baseline arm."""
    unreached, unreached_before = (
        checked.distribution.unreached_share for checked in (designs.checked.best, designs.checked.given)
    )
    if unreached <= unreached_before + _NOTABLE_LOSS:
        return []
    text = (
        f"The best design does not reach {format_percent(unreached)} of the poses of the region, and the baseline arm does "
        f"not reach {format_percent(unreached_before)}. For a pose that is not reached the index counts as 0."
    )
    return [Notice(text, "bad", "Unreached poses")]


def _tabulate_front(designs: Designs) -> TableSpec:
    """Tabulate designs of the Pareto front for the page."""
    picked = _choose_front_designs(designs.front, designs.best)
    columns: list[Column] = [
        "",
        "reach, m",
        f"index of {format_level(designs.level)} of the poses, at least",
        Header("poses reached", style="percent"),
        *(f"{parameter.name}, {parameter.display_unit[1]}" for parameter in designs.space.parameters),
    ]
    factors = [parameter.display_unit[0] for parameter in designs.space.parameters]
    rows = [
        (
            "best" if design == designs.best else "",
            float(designs.reach[design]),
            float(designs.guaranteed[design]),
            float(designs.reached[design]),
            *(value * factor for value, factor in zip(designs.values[design].tolist(), factors, strict=True)),
        )
        for design in picked
    ]
    selection = (
        "all of them" if len(picked) == len(designs.front) else f"{len(picked)} of {len(designs.front)}, spread over the reach"
    )
    title = f"Designs of the Pareto front by reach ({selection}): no design has a larger reach and a larger index quantile"
    return TableSpec(title, columns, rows, on_console=False)


def _choose_front_designs(front: NDArray[np.int64], best: int) -> list[int]:
    """Choose a few designs of the Pareto front, including its ends and the best design."""
    if len(front) <= _MAX_FRONT_DESIGNS:
        return [int(index) for index in front]
    positions = set(np.round(np.linspace(0, len(front) - 1, _MAX_FRONT_DESIGNS)).astype(int).tolist())
    positions |= {int(index) for index in np.flatnonzero(front == best)}
    return [int(front[index]) for index in sorted(positions)]


def _draw_front(designs: Designs) -> report.Figure:
    """Draw all designs by reach and quantile of the index."""
    label = report.format_label(f"{designs.index.name} of {format_level(designs.level)} of the poses, at least")
    baseline = (designs.start_reach, designs.start_guaranteed)
    front = designs.front.tolist()
    return draw_pareto_front(designs.reach, designs.guaranteed, front, designs.best, baseline, label, designs.index.bound)


def _list_methods(designs: Designs) -> list[tuple[str, str]]:
    joints = list_alternatives(
        [
            designs.space.arm.joint_names[joint]
            for joint in sorted({joint for failure in designs.index.failures for joint in failure})
        ]
    )
    return [
        ("Index", f"worst-case {designs.index.name} over the lock of {joints}; larger is better"),
        ("Task", designs.index.task.name),
        ("Region", f"{designs.region.name}: {designs.region.describe()}; the same for all designs"),
        (
            "Index quantile",
            f"the {format_level(1 - designs.level)} quantile, over the poses of the region, of the index at the best "
            "configuration of each pose; a pose that is not reached counts as 0",
        ),
        *designs.method,
        ("Seed", str(designs.seed)),
        *([] if designs.seconds is None else [("Time", f"{designs.seconds:.0f} s")]),
    ]


def _list_region_files(designs: Designs) -> dict[str, Any]:
    """List the files of the region for subsequent commands, if it can be stored."""
    region = designs.region
    if not region.storable:
        return {}
    files: dict[str, Any] = {"region.yaml": lambda path: replace_file(path, format_region_file(region) + "\n")}
    if (poses := region.listed) is not None:
        files["poses.csv"] = lambda path: replace_file(path, poses.to_csv())
    return files


def _write_arm(designs: Designs, path: Path) -> None:
    replace_file(path, sections.format_arm_file(designs))


def _write_designs(designs: Designs, path: Path) -> None:
    """Write all designs as CSV, rad and m."""
    with open_replacement(path, "table") as file:
        writer = csv.writer(file, lineterminator="\n")
        names = [f"{parameter.name} ({parameter.unit})" for parameter in designs.space.parameters]
        writer.writerow(["design", *names, "guaranteed", "reach (m)", "reached", "on the front"])
        front = set(designs.front.tolist())
        columns = (designs.guaranteed, designs.reach, designs.reached)
        for design, values in enumerate(designs.values.tolist()):
            writer.writerow([design, *values, *(float(column[design]) for column in columns), int(design in front)])
