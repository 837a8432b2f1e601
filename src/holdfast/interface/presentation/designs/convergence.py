"""Report of a search for designs that still reach their targets after an undetected lock."""

from __future__ import annotations

import shlex
from pathlib import Path

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure

from holdfast.core.files.output import write_files
from holdfast.core.formatting import capitalise_first, format_decimals, format_percent
from holdfast.core.probability.intervals import Difference, Interval
from holdfast.core.progress import reports_progress
from holdfast.interface.presentation.designs.figures import draw_parameters
from holdfast.interface.presentation.designs.page import ARM_FILE, build_bounds_callout, tabulate_parameters
from holdfast.interface.presentation.page_content import build_method_blocks
from holdfast.interface.report import figures as drawing
from holdfast.interface.report import page
from holdfast.interface.report.page import Block, Cell, Code, Page, Picture, Section, Table, Text
from holdfast.model import arms
from holdfast.studies.designs.convergence import DEFAULT_TARGETS, FAILURES_PER_JOINT, ConvergenceDesigns

_MEASURE_MEANINGS = {
    "guaranteed": "fraction of the targets, by area, that the arm reaches whatever lock leaves them within reach",
    "free": "fraction of the locks that leave the target within reach after which nothing holds the arm away from it",
    "converged": "fraction of all locks after which the arm reaches its target; a target out of reach counts as 0",
    "reached": "fraction of the targets within reach of the healthy arm",
}


@reports_progress("drawing the report")
def write(designs: ConvergenceDesigns, path: Path) -> Path:
    """Write the report: the best design, its gain, and how it was found."""
    return page.write(build(designs), path)


@reports_progress("writing the results")
def save(designs: ConvergenceDesigns, folder: Path) -> list[Path]:
    """Save designs.csv, a row for each design with its values (m, rad) and measures (fractions), best-arm.yaml and
    report.html.
    """
    lines = [",".join((*designs.space.names, *designs.measures))]
    columns = [*designs.values.T.tolist(), *(measure.tolist() for measure in designs.measures.values())]
    lines += [",".join(f"{value:.9g}" for value in row) for row in zip(*columns, strict=True)]
    files = write_files(folder, {"designs.csv": "\n".join(lines) + "\n", ARM_FILE: designs.arm_file()})
    return [*files, designs.report(folder / "report.html")]


def figures(designs: ConvergenceDesigns) -> dict[str, Figure]:
    """Draw the value of each design against each parameter."""
    factors = np.array([parameter.display_unit[0] for parameter in designs.space.parameters])
    names = [f"{parameter.name}, {parameter.display_unit[1]}" for parameter in designs.space.parameters]
    objective_values = designs.measures[designs.objective if designs.exact else "converged"]
    baseline = designs.values[0] * factors, float(objective_values[0])
    return {
        "parameters": draw_parameters(
            names, designs.values * factors, objective_values, baseline, f"fraction, {designs.objective}"
        )
    }


def build(designs: ConvergenceDesigns) -> Page:
    """Build the report as blocks, before it becomes HTML."""
    best_values = designs.values[designs.best]
    return Page(
        f"Designs of {designs.law.arm.name} that reach their targets after an unknown lock",
        headline(designs),
        [
            Section(
                "What to build",
                [
                    *(build_bounds_callout(designs.space, best_values) if designs.best else []),
                    tabulate_parameters(designs.space, best_values),
                ],
            ),
            Section("What that gains", _build_gain_blocks(designs)),
            Section("Which parameter matters", [_build_parameter_picture(designs)]),
            Section("The best arm as a file", _build_file_blocks(designs)),
        ],
        subtitle=f"{designs.law.describe()}; {', '.join(designs.space.names)}",
        facts=[fact for fact in _list_answer_facts(designs) if fact[0] != "0 %"],
        method=_build_method_blocks(designs),
        again=_build_rerun_blocks(designs),
    )


def _list_answer_facts(designs: ConvergenceDesigns) -> list[tuple[Cell, Cell]]:
    """List the values of the best design and of the baseline arm, and the number of designs."""
    if designs.checked is not None:
        baseline, best_share, _ = designs.checked
        label = "of fresh failures, after which it reaches its target:"
        pairs = [(best_share.value, f"{label} the best design")] * (designs.best > 0) + [
            (baseline.value, f"{label} the given arm")
        ]
    else:
        measure = designs.measures[designs.objective if designs.exact else "converged"]
        pairs = [(float(measure[designs.best]), f"{designs.objective}, the best design"), (float(measure[0]), "the given arm")][
            : 1 + (designs.best > 0)
        ]
    return [
        *((format_percent(value), description) for value, description in pairs),
        (f"{len(designs.values):,}", "designs were tried"),
    ]


def headline(designs: ConvergenceDesigns) -> str:
    """Compose the answer in one or two sentences."""
    if designs.checked is not None:
        baseline, best, difference = designs.checked
        if designs.best == 0:
            return (
                f"Nothing better than the given arm was found: it reaches its target in {_format_share(baseline)} of "
                f"fresh failures."
            )
        text = (
            "After a lock that the controller does not know of, the best design reaches its target in "
            f"{_format_share(best)} of fresh failures, the given arm in {_format_share(baseline)}: "
            f"{_format_percentage_points(difference)} more."
        )
        return (
            text if difference.low > 0 else f"No gain that holds on fresh failures was found. {text} Search with more targets."
        )
    name = designs.objective if designs.exact else "converged"
    baseline_text, best_text = (format_percent(float(designs.measures[name][design])) for design in (0, designs.best))
    if designs.best == 0:
        return f"Nothing better than the given arm was found; {name}: {baseline_text}, the {_MEASURE_MEANINGS[name]}."
    return f"The best design has {name} {best_text}, the given arm {baseline_text}: the {_MEASURE_MEANINGS[name]}."


def _format_share(fraction: Interval) -> str:
    return f"{format_percent(fraction.value)} ({format_percent(fraction.low)} to {format_percent(fraction.high)}, 95 %)"


def _format_percentage_points(difference: Difference) -> str:
    middle, lower, upper = (format_decimals(100 * value, 1) for value in (difference.value, difference.low, difference.high))
    return f"{middle} points ({lower} to {upper})"


def _build_gain_blocks(designs: ConvergenceDesigns) -> list[Block]:
    table_rows: list[list[Cell]] = [
        [name, format_percent(float(measure[0])), format_percent(float(measure[designs.best])), _MEASURE_MEANINGS[name]]
        for name, measure in designs.measures.items()
    ]
    header = ["Measure", "given arm", "best design", "what it is"]
    blocks: list[Block] = [
        Table(
            table_rows, header, frozenset({1, 2}), caption=f"As measured in the search, over {len(designs.values):,} designs."
        )
    ]
    if designs.checked is not None:
        baseline, best, difference = designs.checked
        check_rows: list[list[Cell]] = [
            ["converged", _format_share(baseline), _format_share(best), _format_percentage_points(difference)]
        ]
        check_caption = "On targets and failures that had no part in the search, the same for both."
        blocks.append(
            Table(check_rows, ["Fresh", "given arm", "best design", "difference"], frozenset({1, 2, 3}), caption=check_caption)
        )
    else:
        blocks.append(Text("Having no sink and no singular trap does not prove convergence: limit cycles exist.", quiet=True))
    return blocks


def _build_parameter_picture(designs: ConvergenceDesigns) -> Picture:
    (figure,) = figures(designs).values()
    caption = "Each design by one parameter at a time; the others differ too. Designs from the climbs crowd around the best."
    return Picture(drawing.svg(figure, "parameters", "Measure of the designs against each parameter"), caption)


def _build_file_blocks(designs: ConvergenceDesigns) -> list[Block]:
    label = Markup("<code>{}</code>, which every command takes as ARM:").format(ARM_FILE)
    return [
        Code(designs.arm_file().rstrip(), label),
        Text("It has no masses: a table of Denavit-Hartenberg rows holds none.", quiet=True),
    ]


def _build_method_blocks(designs: ConvergenceDesigns) -> list[Block]:
    settings = designs.searched
    measured = (
        "from the stationary sets of the planar arm, all targets at once"
        if designs.exact
        else f"simulation: {settings['targets']} targets, {settings['failures']} failures of each joint at each, the same "
        f"for all designs; a "
        "joint locks where it is in some configuration at the target, and the arm starts anywhere"
    )
    entries: list[tuple[str, Cell]] = [
        ("Law", designs.law.describe()),
        ("Measured", measured),
        (
            "Search",
            f"{settings['designs']:,} Sobol designs, those with equal lengths, and pattern searches from "
            f"{settings['climbs']} of them",
        ),
        ("Seed", str(settings["seed"])),
    ]
    return build_method_blocks(designs.law.arm, *entries, arm_word="given arm")


def _build_rerun_blocks(designs: ConvergenceDesigns) -> list[Block]:
    if not designs.exact and (designs.searched["targets"], designs.searched["failures"]) != (
        DEFAULT_TARGETS,
        FAILURES_PER_JOINT,
    ):
        return []
    command_line, remark = format_command(designs)
    return [Code(command_line, remark and f"{capitalise_first(remark)}:")]


def format_command(designs: ConvergenceDesigns) -> tuple[str, str]:
    """Return the command that repeats the search, and a remark."""
    settings = designs.searched
    arm_spec, words, remark = arms.command_words(designs.law.arm)
    words += [f"--maximise convergence --law {shlex.quote(designs.law.label)} --task {shlex.quote(designs.law.task.name)}"]
    words += [f"--vary {shlex.quote(parameter.option_text)}" for parameter in designs.space.parameters] + [
        "--keep-reach"
    ] * bool(settings.get("keep_reach"))
    words.append(f"--designs {settings['designs']} --local-searches {settings['climbs']} --seed {settings['seed']}")
    return " \\\n    ".join([f"holdfast design {shlex.quote(arm_spec)}", *words]), remark
