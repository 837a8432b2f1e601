"""An arm in a small 3-D view: what is shown of it, and around it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked, real_numbers
from holdfast.arm.model import Arm
from holdfast.arm.postures import generic_configuration
from holdfast.arm.task import Task, as_task, plane_normal
from holdfast.arms.arm_file import write_arm as save
from holdfast.arms.spec import default_task
from holdfast.cell.cell import Cell
from holdfast.errors import InputError
from holdfast.failures import Degraded
from holdfast.files.html import Html
from holdfast.indices.lost_directions import losses
from holdfast.present.arm.body import LINK, Part, stick_parts, stretched
from holdfast.present.arm.visuals import body_of
from holdfast.present.cell import bodies
from holdfast.regions.region import Region
from holdfast.report import viewer
from holdfast.report.viewer import Scene, numbers

__all__ = ["page", "picture", "save", "scene"]

Array = NDArray[np.float64]

TRIANGLES = 16_000  # of a view, about 250 kB of its page
FRAMES = 240  # of a motion: the view draws what lies between
_FROM = 65.0  # degrees from the direction in which the arm reaches to that from which it is seen
_KEPT = 0.99  # a direction in which at least this is left is not marked


@checked
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
    cell: Cell | None = None,
) -> Scene:
    """What a view shows of an arm.

    Args:
        arm: The arm; its links are the shapes of its URDF file where that has some, else round bars.
        q: (n,) rad and m; (A, n) several, the first solid and the others see-through; with ``time`` a motion (F, n), or
            (A, F, n) several. :func:`holdfast.arm.generic_configuration` if not given.
        labels: (A,) what each of several is.
        locked: Joints, by name or index from 0, that are marked as locked, or a :class:`holdfast.Degraded`; in a motion also
            ``{joint: s from which}``.
        free: Joints that are marked as swinging freely.
        task: Rows of the pose in which directions are lost; the arm's own if not given.
        lost: Mark the directions in which the locked joints take speed from the first arm, where nothing moves.
        targets: Poses (4, 4) or points (3,) that are marked, m.
        region: A region, of which a box is drawn, or the lowest and highest corner (2, 3) of a box, m.
        path: (P, 3) where the tool was to be, m.
        points: (N, 3) places that are marked and can be chosen, m.
        colors: (N, 3) their colours, 0 to 255.
        time: (F,) s, of a motion, evenly spaced.
        readings: (F,) a short text for each frame.
        joints: Sliders that move the joints of the first arm.
        meshes: Take the shapes of a URDF file.
        cell: The objects around the arm.

    Raises:
        InputError: Shapes that do not fit.
    """
    moving = time is not None
    rows = _motions(arm, generic_configuration(arm) if q is None else q, moving)
    seconds = np.zeros(0) if time is None else real_numbers(time, "time").reshape(-1)
    if moving and (rows.shape[1] != len(seconds) or len(seconds) < 2):
        raise InputError(f"time has {len(seconds)} moments and the motion {rows.shape[1]}; give as many, 2 or more")
    if (labels and len(labels) != len(rows)) or (readings and len(readings) != len(seconds)):
        raise InputError(f"labels must be {len(rows)}, one for each arm, and readings {len(seconds)}, one for each moment")
    few = (
        np.unique(np.linspace(0, len(seconds) - 1, min(FRAMES, len(seconds))).astype(int)) if moving else np.zeros(1, dtype=int)
    )
    rows = rows[:, few]
    frames = arm.frames(rows.reshape(-1, arm.n)).reshape(*rows.shape[:2], arm.n + 2, 4, 4)
    since = _since(arm, locked)
    poses = [_pose(target) for target in targets]
    boxes = _boxes(region)
    path_ = np.zeros((0, 3)) if path is None else real_numbers(path, "path").reshape(-1, 3)
    places = np.zeros((0, 3)) if points is None else real_numbers(points, "points").reshape(-1, 3)
    paints = np.tile([10.0, 92, 158], (len(places), 1)) if colors is None else real_numbers(colors, "colors").reshape(-1, 3)
    if len(paints) != len(places):
        raise InputError(f"colors are {len(paints)} and points {len(places)}; give as many")
    size = stretched(arm)
    body, note = body_of(arm, size) if meshes else (stick_parts(arm, size), "")
    up = _up(arm)
    taken = [] if moving or not lost else _lost(arm, rows[0, 0], [k for k, t in enumerate(since) if t is not None], task)
    seen = [frames[..., :3, 3].reshape(-1, 3), path_, places, *(pose[None, :3, 3] for pose in poses), *boxes]
    seen += [frames[0, 0, -1, :3, 3] + 0.26 * size * s * np.array(loss["twist"][:3]) for loss in taken for s in (-1, 1)]
    seen += [_swept(p, frames[:, :: max(len(few) // 8, 1), p.frame]) for p in body if p.frame]
    objects = [] if cell is None else bodies.parts(cell, arm.base, size)
    around = tuple(part.vertices @ arm.base[:3, :3].T + arm.base[:3, 3] for part in objects)
    # A floor or a wall goes on where nothing is to be seen.
    seen += [x[np.linalg.norm(x - arm.base[:3, 3], axis=1) < size] for x in around]
    parts, notes = _parts(arm, size, [*body, *objects])
    notes += [note[:1].upper() + note[1:] + "."] if note else []
    data = {
        "up": numbers(up),
        "size": numbers([size])[0],
        "base": _rows(arm.base),
        "joints": [
            {
                "name": joint.name,
                "origin": _rows(joint.origin),
                "axis": numbers(joint.axis),
                "slides": joint.prismatic,
                "low": joint.lower if np.isfinite(joint.lower) else None,
                "high": joint.upper if np.isfinite(joint.upper) else None,
            }
            for joint in arm.joints
        ],
        "tool": _rows(arm.tool),
        "parts": parts,
        "arms": [{"label": labels[k] if labels else "", "q": numbers(motion)} for k, motion in enumerate(rows)],
        "locked": since,
        "free": list(arm.joint_indices(free)),
        "time": numbers(seconds[few]) if moving else [],
        "seconds": float(np.clip(seconds[-1] - seconds[0], 3.0, 20.0)) if moving else 0.0,
        "readings": [readings[k] for k in few] if readings else [],
        "path": numbers(path_),
        "targets": [_rows(pose) for pose in poses],
        "boxes": [{"low": numbers(low), "high": numbers(high)} for low, high in boxes],
        "points": numbers(places),
        "colors": [[round(x) for x in row] for row in paints.tolist()],
        "objects": [] if cell is None else [{"name": x.name, "at": numbers(x.pose[:3, 3])} for x in cell],
        "lost": taken,
        "sliders": joints and not moving,
        "camera": _camera(arm, up, np.vstack(seen), frames, 0.45 * size),
    }
    return Scene(data, frames, tuple(notes), around)


def picture(arm: Arm, about: str, region: Region | None = None) -> str:
    """A still drawing of the arm, with a region, as SVG; seen on light and dark ground."""
    drawn = viewer.drawing(scene(arm, region=region, meshes=False), about)
    return f'<div style="max-width:30em">{drawn}</div>'


def page(arm: Arm, q: ArrayLike | None = None, **options: Any) -> Html:
    """A page of the arm alone, its joints on sliders where nothing moves."""
    from markupsafe import Markup

    drawn = scene(arm, q, **({"joints": True} | options))
    about = f"{arm.name} in three dimensions"
    view: Markup = drawn.html("arm", about)
    return Html(viewer.page(view, arm.title))


def _motions(arm: Arm, q: ArrayLike, moving: bool) -> Array:
    """(A, F, n) configurations."""
    a = real_numbers(q, f"q for '{arm.name}'")
    wanted = "(F, n) or (A, F, n)" if moving else "(n,) or (A, n)"
    if a.ndim not in ((2, 3) if moving else (1, 2)) or a.shape[-1] != arm.n or not a.size or not np.isfinite(a).all():
        raise InputError(f"q for '{arm.name}' has shape {a.shape}; it must be {wanted} of finite numbers with n = {arm.n}")
    if moving:
        return a if a.ndim == 3 else a[None]
    return np.atleast_2d(a)[:, None]


def _since(arm: Arm, locked: Sequence[str | int] | Mapping[Any, float] | Degraded) -> list[float | None]:
    """For each joint the time from which it is locked, s; None: it is not."""
    if isinstance(locked, Degraded):
        locked = list(locked.locked)
    when = dict(locked) if isinstance(locked, Mapping) else dict.fromkeys(locked, 0.0)
    out: list[float | None] = [None] * arm.n
    for joint, t in when.items():
        if np.isfinite(t):
            out[arm.joint_index(joint)] = float(t)
    return out


def _pose(target: ArrayLike) -> Array:
    a = real_numbers(target, "a target")
    if a.shape == (4, 4):
        return a
    if a.shape != (3,):
        raise InputError(f"a target has shape {a.shape}; give a pose (4, 4) or a point (3,)")
    pose = np.eye(4)
    pose[:3, 3] = a
    return pose


def _boxes(region: Region | ArrayLike | None) -> list[Array]:
    """Lowest and highest corners (2, 3)."""
    if region is None:
        return []
    if not isinstance(region, Region):
        return [real_numbers(region, "region").reshape(2, 3)]
    if region.kind != "box":
        return []
    center, half = np.array(region.center[:3]), np.array(region.size[:3]) / 2
    return [np.array([center - half, center + half])]


def _rows(pose: Array) -> list[float]:
    return numbers(pose[:3].reshape(-1))


def _up(arm: Arm) -> Array:
    size = float(np.linalg.norm(arm.gravity))
    return np.array([0.0, 0.0, 1.0]) if size == 0 else -arm.gravity / size + 0.0


def _swept(part: Part, poses: Array) -> Array:
    """Corners (N, 3) of the boxes about a part where poses (..., 4, 4) of its frame put it."""
    ends = np.array([part.vertices.min(axis=0), part.vertices.max(axis=0)])
    corners = np.array([[ends[i, 0], ends[j, 1], ends[k, 2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    return np.asarray(corners @ poses[..., :3, :3].swapaxes(-1, -2) + poses[..., None, :3, 3]).reshape(-1, 3)


def _parts(arm: Arm, size: float, body: Sequence[Part]) -> tuple[list[dict[str, Any]], list[str]]:
    """What is drawn of the arm, and what is to be said of it."""
    notes, sticks, parts = [], stick_parts(arm, size), body
    whole = sum(len(p.faces) for p in parts if p.tube is None)
    if whole > TRIANGLES:
        notes.append(f"The meshes have {whole:,} triangles; about {TRIANGLES:,} are drawn, so that the page stays small.")
    out = []
    for part in parts:
        most = max(TRIANGLES * len(part.faces) // max(whole, TRIANGLES), 40)
        out.append(_part(part, most))
    # Meshes hide the joints: those that are locked are shown through them.
    hidden = {p.joint for p in sticks if p.joint is not None} - {p.joint for p in parts}
    return out + [_part(p, TRIANGLES) | {"mark": True} for p in sticks if p.joint in hidden], notes


def _part(part: Part, most: int) -> dict[str, Any]:
    shown: dict[str, Any] = {"frame": part.frame, "color": part.color}
    if part.joint is not None:
        shown["joint"] = part.joint
    if part.tube is not None:
        start, end, radius = part.tube
        return shown | {"tube": numbers([*start, *end, radius]), "round": part.color == LINK}
    return shown | {"mesh": viewer.packed(*viewer.thinned(part.vertices, part.faces, most))}


def _lost(arm: Arm, q: Array, failed: Sequence[int], task: str | Task | None) -> list[dict[str, Any]]:
    """The directions in which locking joints takes speed away, as twists in the world, with what is left in words."""
    if not failed:
        return []
    t = as_task(arm, task or default_task(arm.name, arm))
    turn = np.kron(np.eye(2), arm.frames(q)[-1][:3, :3].T if t.frame == "tool" else np.eye(3))
    rows = t.rows @ turn
    scale = np.array([1 / t.length] * 3 + [1.0] * 3)
    out = []
    for loss in losses(t.rows @ (scale[:, None] * (turn @ arm.jacobian(q))), failed):
        if loss.kept <= _KEPT:
            words = "lost" if loss.lost else f"{100 * loss.kept:.2g} % of the speed left"
            out.append({"twist": numbers(rows.T @ loss.direction), "words": words})
    return out


def _camera(arm: Arm, up: Array, seen: Array, frames: Array, least: float) -> dict[str, Any]:
    """From where everything is seen: an arm that moves in a plane from before it, another aslant."""
    low, high = seen.min(axis=0), seen.max(axis=0)
    center = (low + high) / 2
    right, top, back, _ = viewer.eye({"azimuth": 0.0, "elevation": 0.0, "radius": 1.0}, up)
    del top
    azimuth, elevation = np.radians(-40.0), np.radians(18.0)
    normal = plane_normal(arm)
    if normal is not None:
        if abs(normal @ up) > 0.9:
            azimuth, elevation = -np.pi / 2, np.radians(65.0)
        else:
            normal = normal * (-1.0 if normal @ right > 1e-9 else 1.0)
            azimuth, elevation = np.arctan2(normal @ right, normal @ back), np.radians(12.0)
    else:
        ahead = frames[0, 0, -1, :3, 3] - frames[0, 0, 0, :3, 3]
        if np.hypot(ahead @ right, ahead @ back) > 0.1 * least:
            azimuth = np.arctan2(ahead @ right, ahead @ back) - np.radians(_FROM)
    radius = max(float(np.linalg.norm(seen - center, axis=1).max()) * 1.08, least)
    return {
        "azimuth": numbers([azimuth])[0],
        "elevation": numbers([elevation])[0],
        "center": numbers(center),
        "radius": numbers([radius])[0],
    }
