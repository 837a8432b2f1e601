"""Interactive 3-D view of an arm and its environment."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.files.html import Html
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments, require_real_numbers
from holdfast.interface.presentation.arm.body import LINK_COLOR_RGB, MeshPart, build_stick_parts, stretched_length
from holdfast.interface.presentation.arm.visuals import build_body
from holdfast.interface.presentation.cell import bodies
from holdfast.interface.report import viewer
from holdfast.interface.report.page import Picture, Section
from holdfast.interface.report.viewer import ViewerScene, round_to_seven_digits
from holdfast.interface.report.views import SIDE_VIEW, View, choose_side_and_top_views, view_onto_plane
from holdfast.kinematics.indices.lost_directions import find_speed_losses
from holdfast.kinematics.regions.region import Region
from holdfast.model.arm.model import Arm
from holdfast.model.arm.postures import generic_configuration
from holdfast.model.arm.task import Task, as_task, plane_normal
from holdfast.model.arms.spec import default_task
from holdfast.model.cell.cell import Cell
from holdfast.model.failure_modes import Degraded

MAX_VIEW_TRIANGLES = 16_000  # triangles of a view, about 250 kB of the page
MAX_MOTION_FRAMES = 240  # frames of a motion; the view interpolates between them
_VIEW_ANGLE_DEG = 65.0  # degrees between the direction in which the arm reaches and the direction of view
_MARKED_SPEED_FRACTION = 0.99  # a direction with at least this fraction of the speed left is not marked


@check_arguments
def scene(
    arm: Arm,
    q: ArrayLike | None = None,
    *,
    labels: Sequence[str] = (),
    locked: Sequence[str | int] | Mapping[Any, float] | Degraded = (),
    free: Sequence[str | int] = (),
    task: str | Task | None = None,
    lost: bool = True,
    targets: Sequence[ArrayLike] = (),
    region: Region | ArrayLike | None = None,
    path: ArrayLike | None = None,
    points: ArrayLike | None = None,
    colors: ArrayLike | None = None,
    time: ArrayLike | None = None,
    readings: Sequence[str] = (),
    joints: bool = False,
    meshes: bool = True,
    mesh_files: bool = True,
    cell: Cell | None = None,
) -> ViewerScene:
    """Build the scene of a view: arms, motion, locked joints, lost directions, targets, region, path, points, and cell.

    Args:
        arm: Arm to show, with the visual shapes of its file, or with cylinders for links that have none.
        q: (n,) configuration, rad and m; or (A, n) several, the first opaque and the others transparent. With ``time``, a
            motion (F, n), or several (A, F, n). Default: :func:`holdfast.model.arm.generic_configuration`.
        labels: (A,) name of each configuration or motion.
        locked: Joints, by name or index from 0, that are marked as locked, or a :class:`holdfast.Degraded`. In a motion also
            ``{joint: time of the lock, s}``.
        free: Joints, by name or index from 0, that are marked as swinging freely.
        task: Task whose lost directions are marked; the default task of the arm if None.
        lost: Mark the directions in which the locked joints reduce the speed of the first arm, if there is no motion.
        targets: Poses (4, 4) or points (3,) to mark, m.
        region: Region whose box is drawn, or the lowest and highest corner (2, 3) of a box, m.
        path: (P, 3) desired path of the tool, m.
        points: (N, 3) points to mark, which can be selected in the view, m.
        colors: (N, 3) RGB colours of the points, 0 to 255.
        time: (F,) evenly spaced times of a motion, s.
        readings: (F,) text to show in each frame.
        joints: Show sliders that move the joints of the first arm.
        meshes: Use the visual shapes of the arm's file.
        mesh_files: Open the mesh files that the arm's file names; if False, all of them count as missing.
        cell: Objects around the arm.

    Returns:
        The scene; ``to_html`` converts it to a part of a page.

    Raises:
        InputError: The shapes of the arguments do not match.
    """
    moving = time is not None
    motions = _read_motions(arm, generic_configuration(arm) if q is None else q, moving)
    seconds = np.zeros(0) if time is None else require_real_numbers(time, "time").reshape(-1)
    if moving and (motions.shape[1] != len(seconds) or len(seconds) < 2):
        raise InputError(f"time has {len(seconds)} moments and the motion {motions.shape[1]}; give as many, 2 or more")
    if (labels and len(labels) != len(motions)) or (readings and len(readings) != len(seconds)):
        raise InputError(f"labels must be {len(motions)}, one for each arm, and readings {len(seconds)}, one for each moment")
    frame_indices = (
        np.unique(np.linspace(0, len(seconds) - 1, min(MAX_MOTION_FRAMES, len(seconds))).astype(int))
        if moving
        else np.zeros(1, dtype=int)
    )
    motions = motions[:, frame_indices]
    frames = arm.frames(motions.reshape(-1, arm.n)).reshape(*motions.shape[:2], arm.n + 2, 4, 4)
    lock_times = _read_lock_times(arm, locked)
    poses = [_read_pose(target) for target in targets]
    boxes = _read_boxes(region)
    path_points = np.zeros((0, 3)) if path is None else require_real_numbers(path, "path").reshape(-1, 3)
    point_array = np.zeros((0, 3)) if points is None else require_real_numbers(points, "points").reshape(-1, 3)
    point_colors = (
        np.tile([10.0, 92, 158], (len(point_array), 1))
        if colors is None
        else require_real_numbers(colors, "colors").reshape(-1, 3)
    )
    if len(point_colors) != len(point_array):
        raise InputError(f"colors are {len(point_colors)} and points {len(point_array)}; give as many")
    size = stretched_length(arm)
    body_parts, mesh_note = build_body(arm, size, mesh_files) if meshes else (build_stick_parts(arm, size), "")
    up = 0.0 - arm.down  # without negative zeros
    lost_directions = (
        []
        if moving or not lost
        else _find_lost_directions(arm, motions[0, 0], [k for k, time in enumerate(lock_times) if time is not None], task)
    )
    visible_points = [
        frames[..., :3, 3].reshape(-1, 3),
        path_points,
        point_array,
        *(pose[None, :3, 3] for pose in poses),
        *boxes,
    ]
    visible_points += [
        frames[0, 0, -1, :3, 3] + 0.26 * size * sign * np.array(loss["twist"][:3])
        for loss in lost_directions
        for sign in (-1, 1)
    ]
    visible_points += [
        _swept_corners(part, frames[:, :: max(len(frame_indices) // 8, 1), part.frame]) for part in body_parts if part.frame
    ]
    objects = [] if cell is None else bodies.build_cell_parts(cell, arm.base, size)
    object_vertices = [part.vertices @ arm.base[:3, :3].T + arm.base[:3, 3] for part in objects]
    # A floor or a wall extends far beyond the arm: only its vertices near the arm must be in the picture.
    visible_points += [item[np.linalg.norm(item - arm.base[:3, 3], axis=1) < size] for item in object_vertices]
    parts, notes = _encode_parts(arm, size, body_parts, objects)
    notes += [mesh_note[:1].upper() + mesh_note[1:] + "."] if mesh_note else []
    data = {
        "up": round_to_seven_digits(up),
        "size": round_to_seven_digits([size])[0],
        "base": _flatten_pose(arm.base),
        "joints": [
            {
                "name": joint.name,
                "origin": _flatten_pose(joint.origin),
                "axis": round_to_seven_digits(joint.axis),
                "slides": joint.prismatic,
                "low": joint.lower if np.isfinite(joint.lower) else None,
                "high": joint.upper if np.isfinite(joint.upper) else None,
            }
            for joint in arm.joints
        ],
        "tool": _flatten_pose(arm.tool),
        "parts": parts,
        "arms": [
            {"label": labels[index] if labels else "", "q": round_to_seven_digits(motion)}
            for index, motion in enumerate(motions)
        ],
        "locked": lock_times,
        "free": list(arm.joint_indices(free)),
        "time": round_to_seven_digits(seconds[frame_indices]) if moving else [],
        "seconds": float(np.clip(seconds[-1] - seconds[0], 3.0, 20.0)) if moving else 0.0,
        "readings": [readings[index] for index in frame_indices] if readings else [],
        "path": round_to_seven_digits(path_points),
        "targets": [_flatten_pose(pose) for pose in poses],
        "boxes": [{"low": round_to_seven_digits(lower), "high": round_to_seven_digits(upper)} for lower, upper in boxes],
        "points": round_to_seven_digits(point_array),
        "colors": [[round(item) for item in color] for color in point_colors.tolist()],
        "objects": []
        if cell is None
        else [{"name": item.name, "at": round_to_seven_digits(item.pose[:3, 3])} for item in cell],
        "lost": lost_directions,
        "sliders": joints and not moving,
        "camera": _place_camera(arm, up, np.vstack(visible_points), frames, 0.45 * size),
    }
    return ViewerScene(data, frames, tuple(notes))


def choose_views(arm: Arm, points: FloatArray) -> list[View]:
    """Return the side and top view of points (..., 3) of an arm, or the view onto its plane for a planar arm."""
    normal = plane_normal(arm)
    return choose_side_and_top_views(points) or [SIDE_VIEW] if normal is None else [view_onto_plane(normal, -arm.gravity)]


def build_view_section(
    title: str, arm: Arm, q: ArrayLike | None, caption: str, *, name: str = "motion", label: str = "", **options: Any
) -> Section:
    """Build the section of a page with a view of the arm; ``label`` is its text alternative. Options as in :func:`scene`."""
    return Section(title, [Picture(scene(arm, q, **options).to_html(name, label or caption), caption)])


def page(arm: Arm, q: ArrayLike | None = None, **options: Any) -> Html:
    """Build an HTML page with a view of the arm, with joint sliders if there is no motion. Options as in :func:`scene`."""
    view = scene(arm, q, **({"joints": True} | options)).to_html("arm", f"{arm.name} in three dimensions")
    return Html(viewer.build_view_page(view, arm.title))


def _read_motions(arm: Arm, q: ArrayLike, moving: bool) -> FloatArray:
    """Return the configurations as motions (A, F, n)."""
    values = require_real_numbers(q, f"q for '{arm.name}'")
    expected_shape = "(F, n) or (A, F, n)" if moving else "(n,) or (A, n)"
    if (
        values.ndim not in ((2, 3) if moving else (1, 2))
        or values.shape[-1] != arm.n
        or not values.size
        or not np.isfinite(values).all()
    ):
        raise InputError(
            f"q for '{arm.name}' has shape {values.shape}; it must be {expected_shape} of finite numbers with n = {arm.n}"
        )
    if moving:
        return values if values.ndim == 3 else values[None]
    return np.atleast_2d(values)[:, None]


def _read_lock_times(arm: Arm, locked: Sequence[str | int] | Mapping[Any, float] | Degraded) -> list[float | None]:
    """Return for each joint the time from which it is locked, s; None if it is not locked."""
    if isinstance(locked, Degraded):
        locked = list(locked.locked)
    times_by_joint = dict(locked) if isinstance(locked, Mapping) else dict.fromkeys(locked, 0.0)
    lock_times: list[float | None] = [None] * arm.n
    for joint, lock_time in times_by_joint.items():
        if np.isfinite(lock_time):
            lock_times[arm.joint_index(joint)] = float(lock_time)
    return lock_times


def _read_pose(target: ArrayLike) -> FloatArray:
    values = require_real_numbers(target, "a target")
    if values.shape == (4, 4):
        return values
    if values.shape != (3,):
        raise InputError(f"a target has shape {values.shape}; give a pose (4, 4) or a point (3,)")
    pose = np.eye(4)
    pose[:3, 3] = values
    return pose


def _read_boxes(region: Region | ArrayLike | None) -> list[FloatArray]:
    """Return the lowest and the highest corner (2, 3) of the region, if it is a box."""
    if region is None:
        return []
    if not isinstance(region, Region):
        return [require_real_numbers(region, "region").reshape(2, 3)]
    corners = find_box_corners(region)
    return [] if corners is None else [corners]


def find_box_corners(region: Region) -> FloatArray | None:
    """Return the lowest and the highest corner (2, 3) of a box region, m; None for other regions."""
    if region.kind != "box":
        return None
    center, half_size = np.array(region.center[:3]), np.array(region.size[:3]) / 2
    return np.array([center - half_size, center + half_size])


def reach_center(arm: Arm, task: Task, region: Region, seed: int, restarts: int) -> FloatArray | None:
    """Return a configuration (n,) at the centre of a box region; None if none is found or the region is no box."""
    if region.kind != "box":
        return None
    from holdfast.kinematics.solvers.inverse_kinematics import solver  # takes long to import

    poses = region.poses(np.array(region.center)[None])
    solutions = solver(arm, task).solve(poses, np.random.SeedSequence(seed), restarts, 1e-6)
    return solutions.q[0] if solutions.success[0] else None


def find_middle_of_limits(arm: Arm) -> FloatArray:
    """Return the configuration (n,) in the middle of the joint limits, which count as a quarter turn if there are none."""
    lower = np.where(np.isfinite(arm.lower), arm.lower, -np.pi / 2)
    return np.asarray((lower + np.where(np.isfinite(arm.upper), arm.upper, np.pi / 2)) / 2)


def _flatten_pose(pose: FloatArray) -> list[float]:
    return round_to_seven_digits(pose[:3].reshape(-1))


def _swept_corners(part: MeshPart, poses: FloatArray) -> FloatArray:
    """Return the corners (N, 3) of the boxes about a part at the poses (..., 4, 4) of its frame."""
    extremes = np.array([part.vertices.min(axis=0), part.vertices.max(axis=0)])
    corners = np.array(list(product(*extremes.T)))
    return np.asarray(corners @ poses[..., :3, :3].swapaxes(-1, -2) + poses[..., None, :3, 3]).reshape(-1, 3)


def _encode_parts(
    arm: Arm, size: float, body: Sequence[MeshPart], objects: Sequence[MeshPart]
) -> tuple[list[dict[str, Any]], list[str]]:
    """Encode the meshes of the arm and of the objects around it for the view, and collect the notes about them."""
    notes, sticks, parts = [], build_stick_parts(arm, size), [*body, *objects]
    triangle_count = sum(len(mesh_part.faces) for mesh_part in parts if mesh_part.tube is None)
    if triangle_count > MAX_VIEW_TRIANGLES:
        notes.append(
            f"The meshes have {triangle_count:,} triangles. They are simplified to about {MAX_VIEW_TRIANGLES:,} to limit "
            f"the size of the page."
        )
    encoded = []
    for index, part in enumerate(parts):
        max_triangles = max(MAX_VIEW_TRIANGLES * len(part.faces) // max(triangle_count, MAX_VIEW_TRIANGLES), 40)
        encoded.append(_encode_part(part, max_triangles) | ({"object": True} if index >= len(body) else {}))
    # Meshes hide the joints, so locked joints are drawn through the meshes.
    hidden = {mesh_part.joint for mesh_part in sticks if mesh_part.joint is not None} - {mesh_part.joint for mesh_part in parts}
    return encoded + [_encode_part(part, MAX_VIEW_TRIANGLES) | {"mark": True} for part in sticks if part.joint in hidden], notes


def _encode_part(part: MeshPart, max_triangles: int) -> dict[str, Any]:
    encoded: dict[str, Any] = {"frame": part.frame, "color": part.color}
    if part.joint is not None:
        encoded["joint"] = part.joint
    if part.tube is not None:
        start, end, radius = part.tube
        return encoded | {"tube": round_to_seven_digits([*start, *end, radius]), "round": part.color == LINK_COLOR_RGB}
    return encoded | {"mesh": viewer.pack_mesh(*viewer.simplify_mesh(part.vertices, part.faces, max_triangles))}


def _find_lost_directions(arm: Arm, q: FloatArray, failed: Sequence[int], task: str | Task | None) -> list[dict[str, Any]]:
    """Return the directions in which locked joints reduce the speed, as twists in the world with a label of the loss."""
    if not failed:
        return []
    task_rows = as_task(arm, task or default_task(arm.name, arm))
    world_rows = task_rows.world_rows(arm.frames(q)[-1][:3, :3])
    scale = np.array([1 / task_rows.length] * 3 + [1.0] * 3)
    directions = []
    for loss in find_speed_losses((world_rows * scale) @ arm.jacobian(q), failed):
        if loss.kept <= _MARKED_SPEED_FRACTION:
            label = "lost" if loss.lost else f"{100 * loss.kept:.2g} % of the speed remains"
            directions.append({"twist": round_to_seven_digits(world_rows.T @ loss.direction), "words": label})
    return directions


def _place_camera(
    arm: Arm, up: FloatArray, visible_points: FloatArray, frames: FloatArray, min_radius: float
) -> dict[str, Any]:
    """Return a camera that shows all points; it views a planar arm along the normal of its plane, other arms obliquely."""
    lower, upper = visible_points.min(axis=0), visible_points.max(axis=0)
    center = (lower + upper) / 2
    right, _, toward_viewer, _ = viewer.camera_axes({"azimuth": 0.0, "elevation": 0.0, "radius": 1.0}, up)
    azimuth, elevation = np.radians(-40.0), np.radians(18.0)
    normal = plane_normal(arm)
    if normal is not None:
        if abs(normal @ up) > 0.9:
            azimuth, elevation = -np.pi / 2, np.radians(65.0)
        else:
            normal = normal * (-1.0 if normal @ right > 1e-9 else 1.0)
            azimuth, elevation = np.arctan2(normal @ right, normal @ toward_viewer), np.radians(12.0)
    else:
        reach_direction = frames[0, 0, -1, :3, 3] - frames[0, 0, 0, :3, 3]
        if np.hypot(reach_direction @ right, reach_direction @ toward_viewer) > 0.1 * min_radius:
            azimuth = np.arctan2(reach_direction @ right, reach_direction @ toward_viewer) - np.radians(_VIEW_ANGLE_DEG)
    radius = max(float(np.linalg.norm(visible_points - center, axis=1).max()) * 1.08, min_radius)
    return {
        "azimuth": round_to_seven_digits([azimuth])[0],
        "elevation": round_to_seven_digits([elevation])[0],
        "center": round_to_seven_digits(center),
        "radius": round_to_seven_digits([radius])[0],
    }
