"""Presentation of the measures of a workspace, over starts or over targets."""

from __future__ import annotations

import json
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.control.convergence.analysis import FAILURE_END_TEXTS, FAILURE_ENDS
from holdfast.control.convergence.measures import FINISH_NAMES, REACH_NAMES
from holdfast.control.convergence.start_workspace import Workspace
from holdfast.control.convergence.targets import TargetMeasures
from holdfast.core.files.output import replace_file
from holdfast.core.formatting import format_count, format_number, format_percent
from holdfast.interface.presentation import renderers
from holdfast.interface.presentation.convergence.places import prepare_place_maps, write_place_table
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Presentation, TableSpec

_METHOD_TEXTS = {
    "brute": "all failures simulated, from configurations equally spaced along the self-motion",
    "procedure": "simulated only where a sink exists; elsewhere the arm is assumed to reach the target",
    "sampled": "random configurations, all failures simulated",
}
_MEASURE_DEFINITIONS = (
    "R: fraction of the path on which the joint may lock with the target still within reach. F: fraction of that part from "
    "which the failed arm reaches the target. 100: fraction of the configurations with R or F of 100 %. avg: mean over the "
    "configurations. sens: greatest minus least value"
)


def to_dict(analysis: Workspace | TargetMeasures) -> dict[str, Any]:
    """Return the contents of the analysis as JSON data, measures in percent; NaN is None."""
    if isinstance(analysis, TargetMeasures):
        return {
            "targets": analysis.targets.points,
            "ends": analysis.ends,
            "percent": analysis.measures,
            "percent_95": analysis.target_intervals(),
        }
    columns = analysis.columns
    reached = analysis.configurations > 0
    return {
        **analysis.law.arm.entry(),
        "law": analysis.law.describe(),
        "task": analysis.law.task.name,
        "target": analysis.target.tolist(),
        "starts": len(analysis.places),
        "starts_in_reach": int(reached.sum()),
        "configurations": int(analysis.configurations.sum()),
        "lost_at_singular_configurations": int(analysis.lost.sum()),
        "method": analysis.method,
        "relative_to": analysis.relative_to,
        "bounds_rad": {name: [list(arc) for arc in arcs] for name, arcs in zip(columns[:-1], analysis.bounds, strict=True)},
        "ends": dict(zip(FAILURE_ENDS, analysis.ends.sum(axis=0).tolist(), strict=True)),
        "undecided_fraction": analysis.undecided_fraction,
        "not_simulated_fraction": analysis.skipped_fraction,
        "mean_percent": {name: dict(zip(columns, values, strict=True)) for name, values in analysis.means().items()},
        "mean_percent_95": {name: dict(zip(columns, values, strict=True)) for name, values in analysis.intervals().items()},
        "starts_with_R100_full": _count_by_column(analysis, analysis.reach.full >= 100 - 1e-9),
        "starts_with_R100_none": _count_by_column(analysis, analysis.reach.full == 0),
    }


def save(analysis: Workspace | TargetMeasures, folder: Path, command: str = "") -> list[Path]:
    """Save the figures, the values at each start or target, and the report."""
    prefix = "targets-" if isinstance(analysis, TargetMeasures) else ""
    return renderers.save(analysis, folder, command, prefix, 130)


def present(analysis: Workspace | TargetMeasures) -> Presentation:
    """Present the part of the path on which the target stays within reach, and how often the failed arm reaches it."""
    arm, law_text = analysis.law.arm, analysis.law.describe()
    if isinstance(analysis, TargetMeasures):
        target_count, start_count = format_count(len(analysis.targets), "target"), format_count(len(analysis.starts), "start")
        within = int(np.isfinite(analysis.measures["Ravg"][:, -1]).sum())
        fallback = f"None of the {target_count} is within reach of motions from {start_count}; choose other targets."
        end_counts = zip(FAILURE_END_TEXTS, analysis.ends.sum(axis=0).tolist(), strict=True)
        answer, facts = _compose_answer(analysis, fallback)
        return Presentation(
            f"Targets of {arm.name} that an undetected lock puts at risk",
            answer + _name_extreme_targets(analysis),
            about=f"{law_text} on {arm.title}: {within} of {target_count} within reach of motions from {start_count}",
            lines=[f"Failures: {', '.join(f'{count} {phrase}' for phrase, count in end_counts)}."],
            facts=facts,
            tables=[_tabulate_means(analysis, "the targets")],
            figures=_list_maps(analysis, "targets"),
            method=[
                ("Law", law_text),
                ("Motions", f"to {target_count} from the same {start_count}; {int(analysis.configurations.sum()):,} motions"),
                ("Measures", _MEASURE_DEFINITIONS),
                (
                    "Source",
                    "measures: Goel, Maciejewski, Balakrishnan 2005; their means over targets are an extension of holdfast",
                ),
            ],
            arm=arm,
            exports={
                "targets.csv": partial(_write_targets, analysis),
                "targets.json": partial(_write_target_summary, analysis),
            },
        )
    start_count, reached = format_count(len(analysis.places), "start"), int((analysis.configurations > 0).sum())
    fallback = f"None of the {start_count} has a configuration from which the target is reached; choose starts within reach."
    answer, facts = _compose_answer(analysis, fallback)
    return Presentation(
        f"Starts from which {arm.name} still reaches a target when a joint locks on the way",
        answer,
        about=(
            f"{law_text} on {arm.title}: {reached} of {start_count} in reach, {int(analysis.configurations.sum())} "
            f"configurations, {int(analysis.lost.sum())} lost at singular configurations"
        ),
        lines=_describe_failures(analysis),
        facts=facts,
        tables=_build_workspace_tables(analysis),
        figures=_list_maps(analysis, "starts"),
        method=[
            ("Law", law_text),
            ("Target", ", ".join(f"{coordinate:.4g}" for coordinate in analysis.target[:3, 3]) + " m"),
            ("Failures", f"{_METHOD_TEXTS[analysis.method]}; {analysis.simulated_count:,} simulated"),
            ("Measures", _MEASURE_DEFINITIONS),
            ("Source", "Goel, Maciejewski, Balakrishnan 2005"),
        ],
        arm=arm,
        exports={"workspace.csv": partial(_write_starts, analysis), "workspace.json": partial(renderers.write_json, analysis)},
    )


def _name_extreme_targets(measures: TargetMeasures) -> str:
    """Name the targets that a lock puts at risk most and least; the text is empty if all are alike."""
    target_means = measures.measures["Ravg"][:, -1]
    if not np.isfinite(target_means).any() or np.nanmin(target_means) == np.nanmax(target_means):
        return ""
    (worst_text, lowest), (best_text, highest) = (
        (f"({', '.join(f'{coordinate:.3g}' for coordinate in measures.targets.points[index])}) m", target_means[index])
        for index in (int(np.nanargmin(target_means)), int(np.nanargmax(target_means)))
    )
    return (
        f" The target at {worst_text} is most at risk (within reach on {format_percent(lowest / 100)} of the way), the target "
        f"at {best_text} least ({format_percent(highest / 100)})."
    )


def _describe_failures(workspace: Workspace) -> list[str]:
    """Count the outcomes of the simulated failures, and those that were not simulated."""
    lines, end_counts = [], dict(zip(FAILURE_ENDS, workspace.ends.sum(axis=0).tolist(), strict=True))
    if workspace.ends.sum():
        end_text = ", ".join(f"{end_counts[name]} {name}" for name in FAILURE_ENDS[:3])
        fraction_text = f" ({100 * workspace.undecided_fraction:.2f} %)" if workspace.simulated_count else ""
        lines.append(
            f"{workspace.simulated_count} failures simulated: {end_text}, {end_counts['undecided'] + end_counts['arriving']} "
            f"undecided at the time limit{fraction_text}. Of the undecided runs, {end_counts['arriving']} are next to a stable "
            "solution and count as converged."
        )
    if workspace.method == "procedure":
        lines.append(
            f"{end_counts['no_sink']} more failures were not simulated ({100 * workspace.skipped_fraction:.2f} %) because no "
            "sink was found at the locked value, which makes convergence very likely but does not prove it."
        )
    return lines


def _compose_answer(analysis: Workspace | TargetMeasures, fallback: str) -> tuple[str, list[Fact]]:
    """Compose the answer and its facts: the part of the path with the target within reach, and how often it is reached."""
    means, joints = analysis.means(), analysis.law.arm.joint_names
    reach, finish = means["Ravg"] / 100, means["Favg"][:-1] / 100
    if np.isnan(reach[-1]):
        return fallback, []
    worst, best = int(np.nanargmin(reach[:-1])), int(np.nanargmax(reach[:-1]))
    phrase = "of the way keeps the target within reach whichever joint locks there"
    facts = [Fact("", reach[-1], phrase=phrase, style="percent")]
    if reach[-1]:
        text = (
            f"On {format_percent(reach[-1])} of the way (mean over all motions), the target stays within reach whichever joint "
            "locks"
        )
    else:
        text = "On no part of the way does the target stay within reach whichever joint locks"
    if reach[worst] < reach[best]:
        remainder = f"on {format_percent(reach[worst])} of the way" if reach[worst] else "nowhere"
        text += f"; after a lock of {joints[worst]} alone, the worst joint, it is within reach {remainder}"
        facts += [
            Fact("", reach[worst], phrase=f"after a lock of {joints[worst]}, the worst joint", style="percent"),
            Fact("", reach[best], phrase=f"after a lock of {joints[best]}, the best joint", style="percent"),
        ]
    if not analysis.ends.sum():
        return f"{text}. No failure was simulated.", facts
    if np.isfinite(finish).any():
        rarest, mean_finish = int(np.nanargmin(finish)), float(np.nanmean(finish))
        phrases = {0.0: "never reaches it", 1.0: "reaches it after every failure that was tried"}
        frequency = phrases.get(mean_finish, f"reaches it after {format_percent(mean_finish)} of the failures")
        text += f". Where the target is within reach, the failed arm {frequency}"
        if mean_finish and finish[rarest] < np.nanmax(finish):
            text += f", least often after a lock of {joints[rarest]} ({format_percent(finish[rarest])})"
        phrase = "of the failures that leave the target within reach end at the target"
        facts.append(Fact("", mean_finish, phrase=phrase, style="percent"))
    return f"{text}.", facts


def _tabulate_means(analysis: Workspace | TargetMeasures, place_noun: str, with_intervals: bool = True) -> TableSpec:
    """Tabulate the mean of each measure for each joint and for any joint."""
    means, intervals = analysis.means(), analysis.intervals()
    columns = ["joint", *(measure for measure in means)]
    cells: list[Any] = [
        [_format_with_interval(value, *ends) for value, ends in zip(values, intervals[measure], strict=True)]
        if with_intervals
        else values
        for measure, values in means.items()
    ]
    title = (
        f"Means over {place_noun}, percent{' (with 95 % intervals)' * with_intervals}; R: target within reach, F: then reached"
    )
    return TableSpec(title, columns, list(zip((*analysis.law.arm.joint_names, "any"), *cells, strict=True)))


def _format_with_interval(value: float, low: float, high: float) -> str:
    """Format a percentage above its interval."""
    return format_number(value, 4) if np.isnan(value) else f"{value:.1f}\n{low:.1f} to {high:.1f}"


def _build_workspace_tables(workspace: Workspace) -> list[TableSpec]:
    """Tabulate the lock positions that each joint permits, the means, and for samples the starts that always succeed."""
    sampled, bound_rows = workspace.method == "sampled", []
    for joint, arcs in zip(workspace.law.arm.joints, workspace.bounds, strict=True):
        factor, unit = joint.display_unit
        arcs_text = ", ".join(f"{factor * lower:.2f} to {factor * upper:.2f} {unit}" for lower, upper in arcs)
        bound_rows.append([joint.name, arcs_text or "no value"])
    tables = [
        _tabulate_means(workspace, "the starts", sampled),
        TableSpec("", ["joint", "target within reach if locked at"], bound_rows),
    ]
    if sampled:
        names = ["R100", "F100"] if workspace.ends.sum() else ["R100"]
        columns = ["joint", *(f"starts with {name} 100, percent" for name in names)]
        shares = [
            [
                _format_with_interval(100 * share.value, 100 * share.low, 100 * share.high)
                for share in workspace.throughout(name)
            ]
            for name in names
        ]
        title = "Starts at which every sampled configuration has the full measure, an upper bound for all configurations"
        tables.append(TableSpec(title, columns, list(zip(workspace.columns, *shares, strict=True))))
    return tables


def _list_maps(analysis: Workspace | TargetMeasures, place_noun: str) -> dict[str, FigureSpec]:
    """List maps of R100, Ravg, Rsens and, if failures were simulated, of F100, Favg, Fsens: ``reach``, ``finish``.

    For spatial tasks the maps are ``reach-top`` and ``reach-side``, seen along z and along y.
    """
    law, columns = analysis.law, [*analysis.law.arm.joint_names, "any joint"]
    failures, target = "", None
    if isinstance(analysis, TargetMeasures):
        places = analysis.targets
        about = (
            f"{law.arm.name}, {law.name}: each position is a target, its value is the mean over {len(analysis.starts)} starts; "
            "grey: no value"
        )
        if count := int(analysis.ends.sum()):
            failures = f"{count} failures"
    else:
        places, target = analysis.places, analysis.target[:3, 3]
        about = (
            f"{law.arm.name}, {law.name}: {len(places)} starts, {int(analysis.configurations.sum())} configurations; grey: no "
            "value"
        )
        if analysis.ends.sum():
            failures = (
                f"{analysis.simulated_count} failures simulated, {100 * analysis.undecided_fraction:.2f} % undecided at the "
                "time limit"
            )
            if analysis.method == "procedure":
                failures += f", {int(analysis.ends[:, -1].sum())} not simulated (no sink at the locked value)"
    kinds = {
        "reach": (
            REACH_NAMES,
            "of the path, percent",
            "R: fraction of the path on which the joint may lock and the target stays in reach",
            "Where the target stays within reach",
            f"R of the {place_noun}, for each joint that locks on the way and for any joint.",
        ),
        "finish": (
            FINISH_NAMES,
            "percent",
            f"F: fraction of that part from which the failed arm reaches the target; {failures}",
            "Where the failed arm reaches the target",
            f"F of the {place_noun}, for each joint that locks on the way and for any joint.",
        ),
    }
    figures: dict[str, FigureSpec] = {}
    for kind, (names, label, explanation, title, caption) in kinds.items():
        if kind == "finish" and not failures:
            continue
        percentages = {name: analysis.measures[name] for name in names}
        views = prepare_place_maps(
            law.task, places, percentages, columns, label, f"{about}\n{explanation}", target, average_cells=False
        )
        figures |= {f"{kind}{view}": FigureSpec(draw_view, title, caption) for view, draw_view in views.items()}
    return figures


def _write_starts(workspace: Workspace, path: Path) -> None:
    """Write the counts and the measures of each start."""
    measure_columns = [f"{name}_{column}_percent" for name in workspace.measures for column in workspace.columns]
    values = [workspace.configurations, workspace.lost, workspace.ends, *workspace.measures.values()]
    write_place_table(path, workspace.places, ["configurations", "lost", *FAILURE_ENDS, *measure_columns], values)


def _write_targets(measures: TargetMeasures, path: Path) -> None:
    """Write the means over the starts, with their 95 % intervals, for each target."""
    row_names = (*measures.law.arm.joint_names, "any")
    columns: list[str] = list(FAILURE_ENDS)
    values: list[Any] = [measures.ends]
    for name, bounds in measures.target_intervals().items():
        values += [measures.measures[name], bounds[..., 0], bounds[..., 1]]
        columns += [f"{name}_{column}_percent{suffix}" for suffix in ("", "_low", "_high") for column in row_names]
    write_place_table(path, measures.targets, columns, values)


def _write_target_summary(measures: TargetMeasures, path: Path) -> None:
    summary = {"arm": measures.law.arm.title, "law": measures.law.describe(), "starts": len(measures.starts)}
    replace_file(path, json.dumps(summary, indent=2) + "\n")


def _count_by_column(workspace: Workspace, flags: NDArray[np.bool_]) -> dict[str, int]:
    return dict(zip(workspace.columns, flags.sum(axis=0).tolist(), strict=True))
