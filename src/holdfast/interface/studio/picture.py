"""Drawing of a view: the arm from the side and from above, with its failures marked."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from html import escape

import numpy as np

from holdfast.interface.presentation.arm import view
from holdfast.interface.report.viewer import draw_scene_svg
from holdfast.interface.studio.machine import CompiledArm
from holdfast.interface.studio.state import State
from holdfast.model.arm.task import plane_normal

DRAWING_SIDE_PX = 480  # of each of the drawings side by side


def draw_view_svg(machine: CompiledArm, state: State, ghosts: Sequence[Sequence[float]] = ()) -> str:
    """Draw a view as SVG text, with ghosts in further configurations (n,): from the side and from above, or onto the plane of a
    planar arm.
    """
    locked = [joint for joint in state.failed_joints if joint not in state.free]
    cell = None if machine.cell is None else machine.cell_with_moved(state.moved)
    scene = view.scene(
        machine.arm, [state.q, *ghosts], locked=locked, free=state.free, task=machine.task, meshes=False, cell=cell, lost=False
    )
    failed = ", ".join(f"{state.names[k]} {state.conditions[k]}" for k in state.failed_joints)
    caption = f"{state.arm}: {failed or 'all joints healthy'}"
    elevations = [0.0, np.pi / 2 - 1e-6] if plane_normal(machine.arm) is None else [scene.data["camera"]["elevation"]]
    drawings = []
    for number, elevation in enumerate(elevations):
        camera = scene.data["camera"] | {"elevation": elevation}
        drawing = draw_scene_svg(replace(scene, data={**scene.data, "camera": camera}), caption)
        place = f'x="{DRAWING_SIDE_PX * number}" y="20" width="{DRAWING_SIDE_PX}" height="{DRAWING_SIDE_PX}"'
        drawings.append(drawing.replace("<svg ", f"<svg {place} ", 1))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {DRAWING_SIDE_PX * len(drawings)} {DRAWING_SIDE_PX + 20}" '
        f'font-family="sans-serif" role="img" aria-label="{escape(caption, quote=True)}">'
        f'<text x="8" y="16" font-size="14">{escape(caption)}</text>{"".join(drawings)}</svg>'
    )
