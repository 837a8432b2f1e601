"""Sections of the page of a design search: the best arm as a file, the distribution of the index, and the command."""

from __future__ import annotations

import shlex

import numpy as np

from holdfast.core.formatting import format_as_given
from holdfast.core.typing import FloatArray
from holdfast.interface import report
from holdfast.interface.presentation.commands import (
    build_command_block,
    build_region_file_blocks,
    format_failures_option,
    format_task_option,
    wrap_command,
)
from holdfast.interface.presentation.designs.parameters import ARM_FILE, build_arm_section
from holdfast.interface.report.page import Block, Code, Picture, Section, Text
from holdfast.model import arms
from holdfast.model.arms.dh_file import format_dh_file
from holdfast.model.failure_modes import failure_sets
from holdfast.studies.designs.designs import Designs, HeldOutResult, format_level


def build_sections(designs: Designs) -> list[Section]:
    """Build the sections with the best arm, and with the distribution of the index for both arms."""
    assess_command = f"holdfast assess {ARM_FILE} --region region.yaml --task {_quote_task(designs)} --optimise --out check"
    arm_section = build_arm_section(
        designs.space,
        designs.values[designs.best],
        format_arm_file(designs),
        "The file has no link masses, because those of links with other lengths are not known.",
        [Code(assess_command, "Command that assesses this arm over the same region:")],
    )
    return [arm_section, Section("Distribution of the index", _build_distribution_blocks(designs))]


def _build_distribution_blocks(designs: Designs) -> list[Block]:
    baseline, best = designs.checked.given, designs.checked.best
    extremes = [checked.distribution.highest for checked in (baseline, best) if checked.distribution.reached]
    extremes = [value for value in extremes if np.isfinite(value)]
    if not extremes:
        return [Text("Neither arm reaches any pose of the region.")]
    bound = designs.index.bound
    marks = [report.Mark(bound, f"no configuration can exceed {bound:.3f}", "bound")] if bound else []
    axis_values = np.linspace(0.0, 1.04 * max(*extremes, *[mark.x for mark in marks]), 801)
    curves = [_make_curve(checked, name, axis_values) for checked, name in ((best, "best design"), (baseline, "baseline arm"))]
    unit_text = "" if designs.index.unit == "1" else f", {designs.index.unit}"
    label = report.format_label(f"worst-case {designs.index.name}{unit_text}")
    figure = report.cdf_figure(curves, marks, label, ylabel="fraction of poses with a smaller value, F")
    explanation = (
        f"{best.distribution.samples:,} held-out poses of the region, each at its best configuration; a pose that is not "
        f"reached counts as 0. A curve crosses {format_level(1 - designs.level)} at the quantile in the table."
    )
    return [Picture(report.svg(figure, "cdf", "Cumulative distributions of baseline arm and best design"), explanation)]


def _make_curve(checked: HeldOutResult, name: str, axis_values: FloatArray) -> report.Curve:
    band = checked.distribution.band()
    label = f"{report.format_label(name, 40)}, 95 % band ±{band:.3f}"
    return report.Curve(axis_values, checked.distribution.cdf(axis_values), label, second=name == "baseline arm", band=band)


def format_arm_file(designs: Designs) -> str:
    """Format the best arm as a file that every command accepts."""
    arm = designs.arm(designs.best)
    return format_dh_file(designs.space.table_of(designs.values[designs.best]), arm.name, arm.gravity, arm.source)


def _quote_task(designs: Designs) -> str:
    return shlex.quote(format_task_option(designs.space.arm, designs.index.task) or "TASK")


def format_command(designs: Designs) -> tuple[str, str]:
    """Return the command that repeats the search, and a remark."""
    space = designs.space
    arm_spec, words, remark = arms.command_words(space.arm)
    words += [f"--vary {shlex.quote(parameter.option_text)}" for parameter in space.parameters]
    words += [
        f"--maximise {designs.index.label}",
        "--region region.yaml",
        f"--task {_quote_task(designs)}",
    ]
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


def build_rerun_blocks(designs: Designs) -> list[Block]:
    """Build the command that repeats the search, and its region file."""
    region_blocks = build_region_file_blocks(designs.region) if designs.region.storable else []
    return [build_command_block(*format_command(designs)), *region_blocks]
