"""The arm and the region, from the side and from above."""

from __future__ import annotations

from typing import Any

from holdfast.core.formatting import format_count
from holdfast.interface import report
from holdfast.interface.presentation.arm.view import scene
from holdfast.interface.presentation.arm_page.build import build_live_picture
from holdfast.interface.presentation.assessment import interactive_poses
from holdfast.interface.presentation.assessment.facts import AssessmentFacts
from holdfast.interface.report.page import Block, Picture


def blocks(facts: AssessmentFacts) -> list[Block]:
    """Draw the arm and the region from the side, from above, and in three dimensions."""
    scene, drawn_count = facts.scene
    distribution = facts.distribution
    dot_label = f"sampled {facts.noun}" if facts.assessment.region.kind != "joints" else "tool position of a configuration"
    legend = [("base", "base"), ("joint", "joints, numbered from the base"), ("tool", "tool")]
    if facts.assessment.arm.prismatic.any():
        legend.insert(2, ("slide", "prismatic joint"))
    if len(scene.points):
        legend.append(("dot", dot_label))
    if len(scene.missing):
        legend.append(("cross", "no configuration found"))
    if scene.box is not None:
        legend.append(("box", "positions of the region"))
    figure = report.view_figure(scene, facts.views, facts.color_scale, label=facts.axis_label, legend=legend)
    image = report.svg(figure, "views", f"The arm and the {facts.noun}s of the region, by index")
    text = f"The arm is drawn {facts.drawn_configuration[1]}."
    if not drawn_count and distribution.samples:
        text += f" The {facts.noun}s of this run were not stored, so none are shown."
    elif drawn_count < distribution.samples:
        text += f" A random {drawn_count:,} of {distribution.samples:,} {facts.noun}s are shown"
    elif drawn_count:
        text += f" All {format_count(drawn_count, facts.noun)} are shown"
    if drawn_count:
        text += "; the colour is the index." if len(scene.points) else "."
    if drawn_count and distribution.infinite:
        text += " Infinite values have the darkest colour."
    assessment = facts.assessment
    live = build_live_picture(assessment.arm, facts.drawn_configuration[0], facts.index.task, assessment.plan.cell)
    return [Picture(image, text), *interactive_poses.blocks(facts, figure), _build_rotatable_view(facts), live]


def _build_rotatable_view(facts: AssessmentFacts) -> Picture:
    """Build the view of the arm and the region in three dimensions."""
    poses, chosen = facts.poses, interactive_poses.choose_selectable_poses(facts)
    dot_options: dict[str, Any] = {}
    if poses is not None and len(chosen):
        dot_options = {
            "points": poses.position[chosen].round(4),
            "colors": 255 * facts.color_scale.colors(poses.value[chosen])[:, :3],
        }
    view = scene(
        facts.assessment.arm,
        facts.drawn_configuration[0],
        region=facts.assessment.region,
        cell=facts.assessment.plan.cell,
        **dot_options,
    )
    text = f"The arm {facts.drawn_configuration[1]}. Drag to rotate the view."
    if dot_options:
        text += f" Click a dot to select its {facts.noun}; a selection in the figure above also moves this arm."
    return Picture(
        view.to_html(interactive_poses.VIEW_ID, f"{facts.assessment.arm.name} and its region in three dimensions"),
        text,
        screen=True,
    )
