"""Certificates by the simplest search there is, which shares nothing with the product's: a grid, Newton to each centre."""

from __future__ import annotations

import base64
import itertools
import json
import shutil
import zlib
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from holdfast import arms
from holdfast.certificates import verifier

Array = NDArray[np.float64]
ROWS = {"planar": [0, 1], "position": [0, 1, 2], "pose": [0, 1, 2, 3, 4, 5]}


def turn(axis: int, angle: float) -> Array:
    """The rotation about a coordinate axis."""
    i, j = (axis + 1) % 3, (axis + 2) % 3
    made = np.eye(3)
    made[i, i] = made[j, j] = np.cos(angle)
    made[i, j], made[j, i] = -np.sin(angle), np.sin(angle)
    return made


def place(rotation: Array, origin: Sequence[float]) -> Array:
    """(4, 4) of a rotation and an origin."""
    made = np.eye(4)
    made[:3, :3], made[:3, 3] = rotation, origin
    return made


class Chain:
    """Joints about or along the z axes of frames, and a tool: what a certificate knows of an arm."""

    def __init__(self, frames: Sequence[Array], tool: Array, limits: Any, slides: Sequence[bool] | None = None) -> None:
        self.frames, self.tool, self.limits = frames, tool, np.asarray(limits, dtype=float)
        self.slides = slides or [False] * len(frames)

    def tip(self, q: Array) -> Array:
        """(4, 4) of the tool."""
        pose = np.eye(4)
        for frame, value, slides in zip(self.frames, q, self.slides, strict=True):
            pose = pose @ frame @ (place(np.eye(3), [0, 0, value]) if slides else place(turn(2, value), [0, 0, 0]))
        return pose @ self.tool

    def stored(self) -> dict[str, Any]:
        """As a certificate writes it."""

        def frame(pose: Array) -> dict[str, Any]:
            return {"rotation": [float(x).hex() for x in pose[:3, :3].ravel()], "origin": [float(x).hex() for x in pose[:3, 3]]}

        kinds = [{"type": "prismatic" if slides else "revolute"} for slides in self.slides]
        limits = [{"limits": [float(x).hex() for x in pair]} for pair in self.limits]
        joints = zip(self.frames, kinds, limits, strict=True)
        return {"joints": [{"name": f"joint{k + 1}", **frame(f), **kind, **pair} for k, (f, kind, pair) in enumerate(joints)],
                "tool": frame(self.tool)}  # fmt: skip


def planar(lengths: Sequence[float], most: float = 3.0) -> Chain:
    """Revolute joints about z, links along x."""
    starts = [0.0, *lengths[:-1]]
    return Chain(
        [place(np.eye(3), [x, 0, 0]) for x in starts], place(np.eye(3), [lengths[-1], 0, 0]), [[-most, most]] * len(lengths)
    )


def panda() -> Chain:
    """The built-in arm, its frames turned so that every axis is z."""
    arm = arms.load("panda")
    frames, back = [], np.eye(4)
    for joint in arm.joints:
        z = joint.axis
        x = np.linalg.svd(z[None])[2][1]
        to_axis = place(np.column_stack([x, np.cross(z, x), z]), [0, 0, 0])
        frames.append(back @ joint.origin @ to_axis)
        back = to_axis.T
    frames[0] = arm.base @ frames[0]
    return Chain(frames, back @ arm.tool, np.column_stack([arm.lower, arm.upper]))


def target_pose(axes: str, u: Array, rotation: Array | None) -> Array:
    """(4, 4) that the parameters of a target mean."""
    where = np.append(u[: min(3, len(u))], [0.0] * (3 - min(3, len(u))))
    if axes.endswith("RPY"):
        rotation = Rotation.from_euler("xyz", u[3:]).as_matrix()  # about fixed axes: x first
    return place(np.eye(3) if rotation is None else rotation, where)


def reached(chain: Chain, q: Array, task: str, target: Array, *, free: Sequence[int], rounds: int = 30) -> Array:
    """Newton on the joints that are free, with derivatives by differences."""

    def error(q: Array) -> Array:
        tip = chain.tip(q)
        off = tip[:3, :3] @ target[:3, :3].T
        vee = [off[2, 1] - off[1, 2], off[0, 2] - off[2, 0], off[1, 0] - off[0, 1]]
        return np.append(tip[:3, 3] - target[:3, 3], np.array(vee) / 2)[ROWS[task]]

    q = q.copy()
    for _ in range(rounds):
        if np.abs(error(q)).max() < 1e-11:
            return q
        steps = 1e-6 * np.eye(len(q))[list(free)]
        slope = np.array([(error(q + step) - error(q - step)) / 2e-6 for step in steps]).T
        q[list(free)] -= np.linalg.pinv(slope) @ error(q)
    assert np.abs(error(q)).max() < 1e-9
    return q


def repaired(document: dict[str, Any]) -> dict[str, Any]:
    """With digests and claim made anew, as a forger would."""
    document["arm_digest"] = verifier.compute_digest(document["arm"])
    document["claim"] = verifier.claim_sentence(document)
    document["digest"] = verifier.compute_digest(document)
    return document


def put(path: Sequence[str | int], change: Any) -> Callable[[dict[str, Any]], None]:
    """A forger who changes one value of a document, or puts another in its place."""

    def forge(document: Any) -> None:
        for key in path[:-1]:
            document = document[key]
        document[path[-1]] = change(document[path[-1]]) if callable(change) else change

    return forge


def shifted(text: str, by: float) -> str:
    """A number that is larger."""
    return (float.fromhex(text) + by).hex()


def packed(data: bytes) -> str:
    """As a payload."""
    return base64.b64encode(zlib.compress(data, 9)).decode()


def unpacked(text: str) -> bytes:
    """A payload's bytes."""
    return zlib.decompress(base64.b64decode(text))


def certificate(
    chain: Chain,
    task: str,
    box: Sequence[Sequence[float]],
    start: Sequence[float],
    *,
    locked: int = -1,
    angle: Sequence[float] | None = None,
    limits: Any = None,
    splits: Sequence[int] = (),
    rotation: Array | None = None,
) -> dict[str, Any]:
    """A claim of reach with every axis halved as often as ``splits`` says; each leaf says that it is proved."""
    axes = {"planar": "xy", "position": "xyz", "pose": "xyz" if rotation is not None else "xyzRPY"}[task]
    roots = np.array([*box, *([angle] if locked >= 0 else [])], dtype=float)
    free = [k for k in range(len(chain.frames)) if k != locked]
    order = [axis for axis, times in enumerate(splits) for _ in range(times)]
    tree, centres = bytearray(), []
    for halves in itertools.product((0, 1), repeat=len(order)):
        fresh = next((i for i in range(len(halves)) if any(halves[i:]) is False), len(halves))
        tree += bytes(16 + axis for axis in order[fresh:]) if not any(halves[fresh:]) else b""
        cell = roots.copy()
        for axis, upper in zip(order, halves, strict=True):
            cell[axis, 1 - upper] = cell[axis].mean()
        middle = cell.mean(axis=1)
        q = np.array(start, dtype=float)
        if locked >= 0:
            q[locked] = middle[-1]
        q = reached(chain, q, task, target_pose(axes, middle[: len(axes)], rotation), free=free)
        centres.append(q)
        tree.append(0)
    kept = {"locked": locked, "angle": angle, "limits": limits, "rotation": rotation}
    return certificate_of(chain, task, box, centres, tree=bytes(tree), **kept)


def hexes(values: Any) -> Any:
    """Numbers as a certificate writes them."""
    return [hexes(x) for x in values] if np.ndim(values) else float(values).hex()


def certificate_of(
    chain: Chain,
    task: str,
    box: Any,
    centres: Sequence[Any],
    *,
    tree: bytes = b"\0",
    locked: int = -1,
    angle: Any = None,
    limits: Any = None,
    rotation: Array | None = None,
) -> dict[str, Any]:
    """A claim of reach with given leaves, all of them said to be proved."""
    rows = np.round(np.asarray(centres) * 2**24).astype("<i4")
    if locked >= 0:
        rows[:, locked] = 0
    axes = {"planar": "xy", "position": "xyz", "pose": "xyz" if rotation is not None else "xyzRPY"}[task]
    document = {
        "format": "holdfast-certificate", "version": 1, "kind": "reach", "arm": chain.stored(), "source": {}, "task": task,
        "target": {"axes": axes, "box": hexes(box), "orientation": None if rotation is None else hexes(rotation.ravel())},
        "locked": locked, "angle": None if angle is None else hexes(angle),
        "limits": hexes(chain.limits if limits is None else limits), "unit": (2.0**-24).hex(), "refutations": [],
        "tree": packed(tree), "centres": packed(rows.tobytes()),
        "volumes": {"proved": "1/2^0", "refuted": "0/2^0", "undecided": "0/2^0"},
        "made_by": "a test", "made_at": "", "seconds": 0.0, "nodes": len(tree),
    }  # fmt: skip
    return repaired(document)


def bundle(files: dict[str, dict[str, Any]], *, locks: list[int], ranges: Any) -> dict[str, Any]:
    """A healthy part and one for each lock, in this order, as one claim; all of them whole."""
    healthy, after = [files[name] for name in list(files)[:2]]
    same = ("format", "version", "arm", "source", "task", "target", "volumes", "made_by", "made_at", "seconds", "nodes")
    parts = [
        {"file": f"{name}.certificate", "digest": part["digest"], "locked": part["locked"]} for name, part in files.items()
    ]
    document = {key: healthy[key] for key in same} | {
        "kind": "bundle",
        "limits": after["limits"],
        "locks": locks,
        "parts": parts,
    }
    return repaired(document | {"working_ranges": hexes(ranges)})


def alone(folder: Path) -> Path:
    """The verifier's files and nothing else, in a folder where an import of holdfast fails."""
    source = Path(verifier.__file__)
    shutil.copytree(source.parent / "verifier_parts", folder / "verifier_parts", ignore=shutil.ignore_patterns("__pycache__"))
    (folder / "holdfast.py").write_text("raise ImportError('holdfast is imported')\n", encoding="utf-8")
    return Path(shutil.copy(source, folder / source.name))


def stored(document: dict[str, Any], path: Path) -> Path:
    """Written."""
    path.write_text(json.dumps(document, sort_keys=True, indent=1), encoding="utf-8")
    return path
