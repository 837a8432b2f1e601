"""Console text, tables, and JSON of arms."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.core.formatting import format_number
from holdfast.interface.presentation.presentation import Notice, Presentation, TableSpec
from holdfast.interface.presentation.printing import TextTable, print_table
from holdfast.model import arms
from holdfast.model.arm.machine import DRY_FRICTION
from holdfast.model.arm.model import Arm
from holdfast.model.arm.soundness import check_arm
from holdfast.studies.assessment.single_points import explain, structures

if TYPE_CHECKING:
    from rich.console import Console

    from holdfast.core.files.html import Html


def to_dict(arm: Arm) -> dict[str, Any]:
    """Return the joints of the arm, its single points of failure for each task, and the problems found in its data."""
    return {
        "name": arm.name,
        **{key: value for key, value in arm.entry().items() if key != "arm"},
        "source": arm.source,
        "fingerprint": arm.fingerprint,
        "gravity_m_s2": arm.gravity,
        "joints": [
            {
                **{
                    key: getattr(joint, key)
                    for key in ("name", "type", "unit", "lower", "upper", "velocity", "effort", "friction", *DRY_FRICTION)
                },
                "mass_kg": None if link is None else link.mass,
            }
            for joint, link in zip(arm.joints, arm.links, strict=True)
        ],
        "structure": [
            {
                "task": structure.task,
                "redundancy": structure.redundancy,
                "single_points_of_failure": [arm.joint_names[index] for index in structure.fatal],
                "at_most_left": {arm.joint_names[index]: remaining for index, remaining in structure.nearly},
                "weak_joints": {arm.joint_names[weak_joint.joint]: asdict(weak_joint) for weak_joint in structure.weak},
                "end_it_together": [[arm.joint_names[index] for index in joint_set] for joint_set in structure.together],
                "always_singular": structure.never,
            }
            for structure in structures(arm)
        ],
        "findings": [
            {"severity": finding.severity, "subject": finding.subject, "message": finding.message} for finding in check_arm(arm)
        ],
    }


def present(arm: Arm) -> Presentation:
    """Present the joints with their types, limits, and link masses."""
    source = [f"Source: {arm.source}"] if arm.source else []
    return Presentation(arm.name, f"{arm.title}: {arm.n} joints", lines=source, tables=[_tabulate_joints(arm, "Joints")])


def _tabulate_joints(arm: Arm, title: str = "") -> TableSpec:
    """Tabulate the joints with their types, limits, and link masses."""
    rows = []
    for number, (joint, link) in enumerate(zip(arm.joints, arm.links, strict=True), 1):
        factor, unit = joint.display_unit
        limits = [f"{factor * limit:.4g} {unit}" if np.isfinite(limit) else "none" for limit in (joint.lower, joint.upper)]
        speed = f"{format_number(joint.velocity, 4)} {joint.unit}/s" if np.isfinite(joint.velocity) else "not given"
        effort_unit = "N" if joint.prismatic else "N m"
        effort = f"{format_number(joint.effort, 4)} {effort_unit}" if np.isfinite(joint.effort) else "not given"
        mass = "not given" if link is None else f"{format_number(link.mass, 4)} kg"
        rows.append((number, joint.name, joint.type, *limits, speed, effort, mass))
    return TableSpec(title, ["", "joint", "type", "lower", "upper", "speed", "effort", "link mass"], rows)


def picture(arm: Arm, about: str) -> str:
    """Return a still drawing of the arm as SVG that is legible on light and dark ground."""
    from holdfast.interface.presentation.arm import view
    from holdfast.interface.report import viewer

    return f'<div style="max-width:22em">{viewer.draw_scene_svg(view.scene(arm, meshes=False), about)}</div>'


def save(arm: Arm, file: Path) -> Path:
    """Write the arm as a URDF file or a DH table."""
    from holdfast.model.arms.arm_file import write_arm

    return write_arm(arm, file)


def page(arm: Arm, q: ArrayLike | None = None, **options: Any) -> Html:
    """Build an HTML page with a 3-D view of the arm; options as in :func:`holdfast.interface.presentation.arm.view.page`."""
    from holdfast.interface.presentation.arm import view

    return view.page(arm, q, **options)


def show(arm: Arm, out: Console) -> None:
    """Print the joints, the single points of failure for each task, and the problems found in the data of the arm."""
    from rich.markup import escape

    source = f". Source: {escape(arm.source)}" if arm.source else ""
    out.print(f"[bold]{escape(arm.title)}[/]: {arm.n} joints{source}")
    print_table(out, _tabulate_joints(arm).texts())
    out.print()
    structure_list = structures(arm)
    for structure in structure_list:
        style = "green" if structure.survives and not structure.weak else "yellow"
        label = f"{structure.task}: " + (f"degree of redundancy {structure.redundancy}. " if structure.redundancy > 0 else "")
        out.print(f"[{style}]{label}[/]{escape(explain(arm, structure, structure_list))}", soft_wrap=True)
    # A finding that applies to several joints is printed once.
    subjects: dict[tuple[str, str], list[str]] = {}
    for finding in check_arm(arm):
        subjects.setdefault((finding.severity, finding.message), []).append(finding.subject)
    if subjects:
        out.print()
    for (severity, message), names in subjects.items():
        subject_text = names[0] if len(names) == 1 else f"{names[0]} and {len(names) - 1} more"
        colour = "red" if severity == "error" else "yellow"
        out.print(f"[{colour}]{severity}[/] {escape(subject_text)}: {escape(message)}", soft_wrap=True)


def describe(arm: Arm) -> list[str]:
    """Return the lines that ``holdfast describe`` prints if the width of the terminal is unknown."""
    from holdfast.interface.presentation.terminal import WrappingConsole

    screen = WrappingConsole()
    with screen.capture() as captured:
        show(arm, screen)
    return [line.rstrip() for line in captured.get().splitlines()]


def list_library_arms() -> list[dict[str, Any]]:
    """List the built-in arms with their joint counts, summaries, sources, and licences."""
    entries = [arms.about(name) for name in arms.names()]
    return [
        {"name": entry.name, "joints": entry.n, "summary": entry.summary, "source": entry.source, "licence": entry.licence}
        for entry in entries
    ]


def show_library(out: Console) -> None:
    """Print the built-in arms as a table."""
    rows = [[entry["name"], str(entry["joints"]), entry["summary"], entry["licence"]] for entry in list_library_arms()]
    print_table(out, TextTable(["name", "joints", "description", "licence"], rows))


def list_limit_violations(arm: Arm, q: NDArray[np.float64], when: str = "") -> list[Notice]:
    """Return a notice with the joints that are outside their limits in a configuration (n,), if any."""
    names = [joint.name for joint, position in zip(arm.joints, q, strict=True) if not joint.lower <= position <= joint.upper]
    return [Notice(f"Joints outside their limits{when}: {', '.join(names)}.")] if names else []


def build_page(arm: Arm, q: ArrayLike | None = None, *, file: str | Path | None = None, **options: Any) -> Html:
    """Build the interactive page of an arm, and write it to a file if one is given; options as in
    :func:`holdfast.interface.presentation.arm_page.build.build_page`.
    """
    from holdfast.interface.presentation.arm_page import build

    page = build.build_page(arm, q, **options)
    if file is not None:
        page.save(file)
    return page
