"""HTML report of a search of designs, which begins with the best design and its gain."""

from __future__ import annotations

import csv
import io
import shlex
from pathlib import Path

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast.core.files.output import write_files
from holdfast.core.formatting import (
    capitalise_first,
    format_as_given,
    format_count,
    format_number,
    format_percent,
    list_alternatives,
)
from holdfast.core.progress import reports_progress
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.commands import (
    build_region_file_blocks,
    format_failures_option,
    format_region_file,
    format_task_option,
    wrap_command,
)
from holdfast.interface.presentation.designs.console import name_reached_bound
from holdfast.interface.presentation.designs.figures import draw_before_and_after, draw_pareto_front
from holdfast.interface.presentation.page_content import build_method_blocks
from holdfast.interface.report import figures as drawing
from holdfast.interface.report import page
from holdfast.interface.report.figures import Curve, Mark
from holdfast.interface.report.page import Block, Callout, Cell, Code, Page, Picture, Section, Table, Text
from holdfast.model import arms
from holdfast.model.arms.dh_file import format_dh_file as table_text
from holdfast.model.failure_modes import failure_sets
from holdfast.studies.designs.designs import Designs, HeldOutResult, format_level, format_value_interval
from holdfast.studies.designs.space import DesignSpace

ARM_FILE = "best-arm.yaml"
_MAX_FRONT_DESIGNS = 10  # designs of the front in the table
_PARAMETER_DESCRIPTIONS = {
    "a": "length of link {row} (a)",
    "alpha": "twist of link {row} (alpha)",
    "d": "offset of joint {row} (d)",
    "theta": "angle of joint {row} at 0 (theta)",
    "lower": "lower limit of joint {row}",
    "upper": "upper limit of joint {row}",
    "x": "tool point, x",
    "y": "tool point, y",
    "z": "tool point, z",
    "roll": "tool, roll",
    "pitch": "tool, pitch",
    "yaw": "tool, yaw",
}


@reports_progress("drawing the report")
def write(designs: Designs, path: Path) -> Path:
    """Write the report: the best design, its gain, and its loss of reach."""
    return page.write(build(designs), path)


@reports_progress("writing the results")
def save(designs: Designs, folder: Path) -> list[Path]:
    """Save report.html, best-arm.yaml, designs.csv and, for subsequent commands, region.yaml if the region can be stored."""
    texts_by_file = {ARM_FILE: format_arm_file(designs), "designs.csv": _format_designs_csv(designs)}
    if designs.region.storable:
        texts_by_file["region.yaml"] = format_region_file(designs.region) + "\n"
        if designs.region.listed is not None:
            texts_by_file["poses.csv"] = designs.region.listed.to_csv()
    files = write_files(folder, texts_by_file)
    return [designs.report(folder / "report.html"), *files]


def _format_designs_csv(designs: Designs) -> str:
    """Format all designs as CSV, rad and m."""
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    names = [f"{parameter.name} ({parameter.unit})" for parameter in designs.space.parameters]
    writer.writerow(["design", *names, "guaranteed", "reach (m)", "reached", "on the front"])
    front = set(designs.front.tolist())
    columns = (designs.guaranteed, designs.reach, designs.reached)
    for design, values in enumerate(designs.values.tolist()):
        writer.writerow([design, *values, *(float(column[design]) for column in columns), int(design in front)])
    return buffer.getvalue()


def figures(designs: Designs) -> dict[str, Figure]:
    """Draw all designs by reach and quantile of the index; the baseline arm and the best design, unless they are the same."""
    baseline = (designs.start_reach, designs.start_guaranteed)
    drawn_figures = {
        "front": draw_pareto_front(
            designs.reach,
            designs.guaranteed,
            designs.front.tolist(),
            designs.best,
            baseline,
            _format_index_label(designs),
            designs.index.bound,
        )
    }
    if not designs.best_is_start:
        drawn_figures["arms"] = draw_before_and_after(
            designs.space.arm, designs.arm(designs.best), designs.index.task, designs.region, designs.seed
        )
    return drawn_figures


def build(designs: Designs) -> Page:
    """Build the report as blocks, before it becomes HTML."""
    result, drawn_figures = designs, figures(designs)
    sections = [
        Section("", _build_remark_blocks(result)),
        Section("What to build", [tabulate_parameters(result.space, result.values[result.best])]),
        Section("Before and after", [] if result.best_is_start else _build_arm_blocks(drawn_figures["arms"])),
        Section("Index quantile against reach", _build_front_blocks(result, drawn_figures["front"])),
        Section("How the index is distributed, before and after", _build_distribution_blocks(result)),
        Section("The best arm as a file", _build_file_blocks(result)),
    ]
    return Page(
        f"Designs of {result.space.arm.name}",
        result.headline,
        sections,
        subtitle=f"{result.region.name}; {', '.join(result.space.names)}",
        facts=_list_answer_facts(result),
        method=_build_method_blocks(result),
        again=_build_rerun_blocks(result),
    )


def _list_answer_facts(designs: Designs) -> list[tuple[Cell, Cell]]:
    """List the index quantile before and after, on poses not used in the search, and the change of reach."""
    baseline, best = designs.checked.given, designs.checked.best
    quantile_label = f"least index at {format_level(designs.level)} of fresh poses"
    entries: list[tuple[Cell, Cell]] = []
    if best.guaranteed.value:
        entries.append(
            (
                format_number(best.guaranteed.value),
                f"{quantile_label}, {'the given arm' if designs.best_is_start else 'the best design'}",
            )
        )
    if baseline.guaranteed.value and not designs.best_is_start:
        entries.append((format_number(baseline.guaranteed.value), f"{quantile_label}, the given arm"))
    entries.append(
        (format_number(float(best.distribution.quantile(0.5, reachable_only=False))), "median of the fresh poses, best design")
    )
    entries.append(
        (
            f"{format_number(float(designs.reach[designs.best]))} m",
            f"reach of the best design; the given arm: {format_number(designs.start_reach)} m",
        )
    )
    return [entry for entry in entries if entry[0] != "0"]


# ---- what to build -------------------------------------------------------------------------------------------------------


def build_bounds_callout(space: DesignSpace, best: FloatArray) -> list[Block]:
    """Name the parameters of the best design (k,) that are at their bounds, if any are."""
    bounded = [
        f"{parameter.name} ({parameter.text(value)})"
        for parameter, value in zip(space.parameters, best.tolist(), strict=True)
        if name_reached_bound(parameter, value)
    ]
    if not bounded:
        return []
    verb_phrase = "is at its bound" if len(bounded) == 1 else "are at their bounds"
    text = f"{', '.join(bounded)} of the best design {verb_phrase}: wider ones may give more, if that can be built."
    return [Callout(text, title="Bounds")]


def _build_remark_blocks(designs: Designs) -> list[Block]:
    blocks: list[Block] = []
    if designs.best_is_start:
        return blocks
    blocks += build_bounds_callout(designs.space, designs.values[designs.best])
    unreached, unreached_before = (
        checked.distribution.unreached_share for checked in (designs.checked.best, designs.checked.given)
    )
    if unreached > unreached_before + 0.005:
        blocks.append(
            Callout(
                f"The best design does not reach {format_percent(unreached)} of the poses of the region, the given arm "
                f"{format_percent(unreached_before)}. They count as index 0.",
                "bad",
                "Poses that are lost",
            )
        )
    return blocks


def tabulate_parameters(space: DesignSpace, best: FloatArray) -> Table:
    """Build the table of the parameters of the baseline arm and of the best design (k,)."""
    table_rows: list[list[Cell]] = []
    for parameter, before, after in zip(space.parameters, space.start.tolist(), best.tolist(), strict=True):
        factor, unit = parameter.display_unit
        row_number = None if parameter.row is None else parameter.row + 1
        bound_name = name_reached_bound(parameter, after)
        table_rows.append(
            [
                parameter.name,
                _PARAMETER_DESCRIPTIONS[parameter.kind].format(row=row_number),
                _format_value(before * factor),
                Markup("<strong>{}</strong>").format(_format_value(after * factor)),
                unit,
                f"{_format_value(parameter.lower * factor)} to {_format_value(parameter.upper * factor)}",
                f"at the {bound_name} bound" if bound_name else "",
            ]
        )
    header = ["Parameter", "what it is", "given arm", "best design", "unit", "bounds", ""]
    caption = (
        "Rows and joints are numbered from the base, in the standard Denavit-Hartenberg table of the arm; the tool is in the "
        "frame of the last row, roll, pitch and yaw as in URDF."
    )
    return Table(table_rows, header, frozenset({2, 3, 5}), caption=caption, wide=True)


def _format_value(value: float) -> str:
    return f"{round(value, 4) + 0.0:.6g}".replace("-", "−")


def _build_arm_blocks(figure: Figure) -> list[Block]:
    caption = (
        "Each arm with its tool at the middle of the region (dashed), or in the middle of its joint limits if it does not get "
        "there. Circles are joints, squares prismatic joints; the orange diamond is the tool point. Equal scales."
    )
    return [Picture(drawing.svg(figure, "arms", "The given arm and the best design"), caption)]


# ---- why -----------------------------------------------------------------------------------------------------------------


def _format_index_label(designs: Designs) -> str:
    return drawing.format_label(f"{designs.index.name}, least at {format_level(designs.level)} of the poses")


def _build_front_blocks(designs: Designs, figure: Figure) -> list[Block]:
    explanation = (
        f"Guaranteed: the worst-case {designs.index.name} that {format_level(designs.level)} of the "
        f"{format_count(designs.poses, 'pose')} of the search "
        "have at least, each at its best configuration; a pose that is not reached counts as 0. Reach: the largest distance of "
        "the tool point from the base frame's origin within the joint limits. These are the poses on which designs were "
        "chosen; see below for fresh ones."
    )
    picked = _choose_front_designs(designs.front, designs.best)
    table_rows: list[list[Cell]] = []
    for design in picked:
        cells: list[Cell] = [
            "best" if design == designs.best else "",
            f"{designs.reach[design]:.3f}",
            format_number(float(designs.guaranteed[design])),
        ]
        cells.append(format_percent(float(designs.reached[design])))
        cells += [
            _format_value(value * parameter.display_unit[0])
            for parameter, value in zip(designs.space.parameters, designs.values[design].tolist(), strict=True)
        ]
        table_rows.append(cells)
    header: list[Cell] = ["", "reach, m", f"least at {format_level(designs.level)} of the poses", "poses reached"]
    header += [f"{parameter.name}, {parameter.display_unit[1]}" for parameter in designs.space.parameters]
    selection = (
        "all of them" if len(picked) == len(designs.front) else f"{len(picked)} of {len(designs.front)}, spread over the reach"
    )
    caption = f"Designs of the front by reach ({selection}): none that was found has more of both."
    return [
        Picture(drawing.svg(figure, "front", "Guaranteed index against reach of all designs"), explanation),
        Table(table_rows, header, frozenset(range(1, len(header))), caption=caption, wide=True),
    ]


def _choose_front_designs(front: NDArray[np.int64], best: int) -> list[int]:
    """Choose a few designs of the front, including its ends and the best one."""
    if len(front) <= _MAX_FRONT_DESIGNS:
        return [int(index) for index in front]
    positions = set(np.round(np.linspace(0, len(front) - 1, _MAX_FRONT_DESIGNS)).astype(int).tolist())
    positions |= {int(index) for index in np.flatnonzero(front == best)}
    return [int(front[index]) for index in sorted(positions)]


def _build_distribution_blocks(designs: Designs) -> list[Block]:
    baseline, best = designs.checked.given, designs.checked.best
    extremes = [
        value
        for checked in (baseline, best)
        if checked.distribution.reached
        for value in (checked.distribution.highest,)
        if np.isfinite(value)
    ]
    if not extremes:
        return [Text("Neither arm reaches a pose of the region.")]
    marks = (
        [Mark(designs.index.bound, f"no configuration can exceed {designs.index.bound:.3f}", "bound")]
        if designs.index.bound
        else []
    )
    axis_values = np.linspace(0.0, 1.04 * max(*extremes, *[mark.x for mark in marks]), 801)
    curves = [
        Curve(
            axis_values,
            checked.distribution.cdf(axis_values),
            f"{drawing.format_label(name, 40)}, 95 % band ±{checked.distribution.band():.3f}",
            second=second,
            band=band,
        )
        for checked, name, second in ((best, "best design", False), (baseline, "given arm", True))
        for band in (checked.distribution.band(),)
    ]
    unit_text = "" if designs.index.unit == "1" else f", {designs.index.unit}"
    label = drawing.format_label(f"worst-case {designs.index.name}{unit_text}")
    figure = drawing.cdf_figure(curves, marks, label, ylabel="fraction of poses with a smaller value, F", width=8.0)
    samples = designs.checked.best.distribution.samples
    search_value, fresh = float(designs.guaranteed[designs.best]), best.guaranteed
    explanation = (
        f"{samples:,} fresh poses of the region, which had no part in the search, each at its best configuration; a pose that "
        f"is not reached counts as 0. A curve crosses {format_level(1 - designs.level)} at the quantile in the table."
    )
    table_rows: list[list[Cell]] = [
        [
            name,
            format_value_interval(checked.guaranteed),
            format_number(float(checked.distribution.quantile(0.5, reachable_only=False))),
            _format_reached_fraction(checked),
        ]
        for name, checked in (("given arm", baseline), ("best design", best))
    ]
    header = ["", f"least at {format_level(designs.level)} of the poses", "median", "poses reached"]
    optimism_text = (
        f"On the {format_count(designs.poses, 'pose')} on which it was chosen the best design keeps "
        f"{format_number(search_value)}; on fresh ones "
        f"{format_number(fresh.value)}. The difference, {format_number(search_value - fresh.value)}, is the optimism of "
        f"choosing on them."
    )
    return [
        Picture(drawing.svg(figure, "cdf", "Cumulative distributions of the given arm and the best design"), explanation),
        Table(table_rows, header, frozenset({1, 2, 3})),
        Text(optimism_text),
    ]


def _format_reached_fraction(checked: HeldOutResult) -> str:
    return format_percent(1 - checked.distribution.unreached_share)


# ---- to take along -------------------------------------------------------------------------------------------------------


def format_arm_file(designs: Designs) -> str:
    """Format the best arm as a file that every command takes."""
    arm = designs.arm(designs.best)
    return table_text(designs.space.table_of(designs.values[designs.best]), arm.name, arm.gravity, arm.source)


def _build_file_blocks(designs: Designs) -> list[Block]:
    label = Markup("<code>{}</code>, which every command takes as ARM:").format(ARM_FILE)
    assess_command = (
        f"holdfast assess {ARM_FILE} --region region.yaml --task {_format_task_option(designs)} --optimise --out check"
    )
    return [
        Code(format_arm_file(designs).rstrip(), label),
        Text("It has no masses: those of links of other lengths are not known.", quiet=True),
        Code(assess_command, "Its own report over the same region:"),
    ]


def _format_task_option(designs: Designs) -> str:
    return shlex.quote(format_task_option(designs.space.arm, designs.index.task) or "TASK")


def format_command(designs: Designs) -> tuple[str, str]:
    """Return the command that repeats the search, and a remark."""
    space = designs.space
    arm_spec, words, remark = arms.command_words(space.arm)
    words += [f"--vary {shlex.quote(parameter.option_text)}" for parameter in space.parameters]
    words += [f"--maximise {designs.index.label}", "--region region.yaml", f"--task {_format_task_option(designs)}"]
    if designs.index.task.length != 1.0:
        words.append(f"--length {designs.index.task.length!r}")
    if designs.index.failures != failure_sets(space.arm, "single"):
        words.append(f"--failures {shlex.quote(format_failures_option(space.arm, designs.index.failures))}")
    words += [
        f"--level {format_as_given(designs.level)}",
        f"--poses {designs.poses}",
        f"--designs {designs.screened}",
        f"--local-searches {designs.climbs}",
    ]
    words += [f"--check-poses {designs.checked.best.distribution.samples}", f"--seed {designs.seed}"]
    return wrap_command(f"holdfast design {shlex.quote(arm_spec)}", words), remark


def _build_method_blocks(designs: Designs) -> list[Block]:
    joints = list_alternatives(
        [
            designs.space.arm.joint_names[joint]
            for joint in sorted({joint for failure in designs.index.failures for joint in failure})
        ]
    )
    entries: list[tuple[str, Cell]] = [
        ("Index", f"worst-case {designs.index.name} over the lock of {joints}; larger is better"),
        ("Task", designs.index.task.name),
        ("Region", f"{designs.region.name}: {designs.region.describe()}; the same for all designs"),
        (
            "Guaranteed",
            f"the {format_level(1 - designs.level)} quantile, over the poses of the region, of the index at the best "
            f"configuration of "
            "each pose; a pose that is not reached counts as 0",
        ),
        *designs.method,
        ("Seed", str(designs.seed)),
    ]
    if designs.seconds is not None:
        entries.append(("Time", f"{designs.seconds:.0f} s"))
    return build_method_blocks(designs.space.arm, *entries, arm_word="given arm")


def _build_rerun_blocks(designs: Designs) -> list[Block]:
    command_line, remark = format_command(designs)
    return [
        Code(command_line, remark and f"{capitalise_first(remark)}:"),
        *(build_region_file_blocks(designs.region) if designs.region.storable else []),
    ]
