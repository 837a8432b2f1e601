"""The arm and the region, from the side and from above."""

from __future__ import annotations

from typing import Any

from holdfast.present.arm.view import scene
from holdfast.present.assessment import pointing
from holdfast.present.assessment.facts import Facts
from holdfast.report import figures, scenes
from holdfast.report.page import Block, Picture
from holdfast.words import counted

TITLE = "The arm and the region"


def blocks(f: Facts) -> list[Block]:
    """The arm and the region, from the side and from above."""
    scene, drawn = f.scene
    d = f.d
    dots = f"{f.noun} drawn" if f.a.region.kind != "joints" else "tool position of a configuration drawn"
    legend = [("base", "base"), ("joint", "joints, numbered from the base"), ("tool", "tool")]
    if f.a.arm.prismatic.any():
        legend.insert(2, ("slide", "prismatic joint"))
    if len(scene.points):
        legend.append(("dot", dots))
    if len(scene.missing):
        legend.append(("cross", "no configuration found"))
    if scene.box is not None:
        legend.append(("box", "positions of the region"))
    figure = scenes.view_figure(scene, f.views, f.scale, label=f.axis_label, legend=legend)
    image = figures.svg(figure, "views", f"The arm and the {f.noun}s of the region, by index")
    text = f"The arm is drawn {f.representative[1]}."
    if not drawn and d.samples:
        text += f" The {f.noun}s of this run were not kept, so none are drawn."
    elif drawn < d.samples:
        text += f" Of {d.samples:,} {f.noun}s a random {drawn:,} are drawn"
    elif drawn:
        text += f" All {counted(drawn, f.noun)} are drawn"
    if drawn:
        text += "; colour is the index." if len(scene.points) else "."
    if drawn and d.infinite:
        text += " Infinite values have the darkest colour."
    return [Picture(image, text), *pointing.blocks(f, figure), _turned(f)]


def _turned(f: Facts) -> Picture:
    """The same in three dimensions."""
    rows, chosen = f.rows, pointing.answering(f)
    poses: dict[str, Any] = {}
    if rows is not None and len(chosen):
        poses = {"points": rows.position[chosen].round(4), "colors": 255 * f.scale.colors(rows.value[chosen])[:, :3]}
    view = scene(f.a.arm, f.representative[0], region=f.a.region, cell=f.a.plan.cell, **poses)
    text = f"The arm {f.representative[1]}; drag to turn it."
    if poses:
        text += f" A dot is a {f.noun} that can be chosen; what is chosen above moves the arm."
    return Picture(view.html(pointing.VIEW, f"{f.a.arm.name} and its region in three dimensions"), text, screen=True)
