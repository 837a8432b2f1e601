"""Random targets of proved cells, each with a configuration or without: Newton in plain NumPy on what the file says."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from holdfast.certificates import verifier

Array = NDArray[np.float64]


class Claimed:
    """A reach certificate as arrays, made from its text alone."""

    def __init__(self, file: Path) -> None:
        document = json.loads(file.read_text(encoding="utf-8"))
        frames = [*document["arm"]["joints"], document["arm"]["tool"]]
        self.turns = np.array([_numbers(frame["rotation"]) for frame in frames]).reshape(-1, 3, 3)
        self.origins = np.array([_numbers(frame["origin"]) for frame in frames])
        self.slides = np.array([joint["type"] == "prismatic" for joint in document["arm"]["joints"]])
        self.low, self.high = np.array([_numbers(pair) for pair in document["limits"]]).T
        self.n, self.locked, self.axes = len(self.slides), document["locked"], document["target"]["axes"]
        self.free = np.arange(self.n) != self.locked
        turned = document["target"]["orientation"]
        self.wanted = None if turned is None else np.reshape(_numbers(turned), (3, 3))
        self.task = document["task"]
        root = np.array([_numbers(p) for p in [*document["target"]["box"], *([document["angle"]] if self.locked >= 0 else [])]])
        tokens = verifier.decompress_payload(document["tree"], 10**8, "tree")
        cells = [cell for token, cell in verifier.iterate_cells(tokens, len(root)) if token == 0]
        self.part = np.array(cells, dtype=float)  # (leaves, axes, 2): k of 2^d
        width = root[:, 1] - root[:, 0]
        self.size = width / 2 ** self.part[..., 1]
        self.corner = root[:, 0] + self.part[..., 0] * self.size
        packed = verifier.decompress_payload(document["centres"], 10**9, "centres")
        self.q = np.frombuffer(packed, "<i4").reshape(-1, self.n) / 2**24

    def tool(self, q: Array) -> tuple[Array, Array]:
        """Places (N, 3) and rotations (N, 3, 3)."""
        place, turn = np.zeros((len(q), 3)), np.tile(np.eye(3), (len(q), 1, 1))
        for k in range(self.n + 1):
            place, turn = place + turn @ self.origins[k], turn @ self.turns[k]
            if k < self.n and self.slides[k]:
                place = place + turn[:, :, 2] * q[:, [k]]
            elif k < self.n:
                turn = turn @ Rotation.from_rotvec(q[:, [k]] * [0, 0, 1]).as_matrix()
        return place, turn

    def error(self, q: Array, u: Array) -> Array:
        """(N, rows) of the tool at q from targets (N, axes)."""
        place, turn = self.tool(q)
        linear = sum(axis in "xyz" for axis in self.axes)
        off = place[:, :linear] - u[:, :linear]
        if self.task == "planar-pose":
            yaw = np.arctan2(turn[:, 1, 0], turn[:, 0, 0]) - u[:, 2]
            return np.column_stack([off, np.arctan2(np.sin(yaw), np.cos(yaw))])
        if self.task == "pointing":
            return np.concatenate([off, turn[:, :, 2] @ self.wanted[:, :2]], axis=1)
        if self.task != "pose":
            return off
        wanted = self.wanted if self.wanted is not None else Rotation.from_euler("xyz", u[:, 3:]).as_matrix()
        return np.concatenate([off, Rotation.from_matrix(turn @ np.swapaxes(wanted, -1, -2)).as_rotvec()], axis=1)

    def unreached(self, rng: np.random.Generator, count: int, tries: int = 30) -> tuple[int, float]:
        """Of so many targets in cells, mostly corners and faces, those without a configuration, and the largest error left."""
        which = rng.integers(len(self.q), size=count)
        at = self.corner[which] + rng.uniform(-1, 2, self.corner[which].shape).clip(0, 1) * self.size[which]
        q, u = self.q[which].copy(), at[:, : len(self.axes)]
        if self.locked >= 0:
            q[:, self.locked] = at[:, -1]
        for _ in range(12):
            error = self.error(q, u)
            steps = [(self.error(q + 1e-7 * move, u) - error) / 1e-7 for move in np.eye(self.n)[self.free]]
            q[:, self.free] -= (np.linalg.pinv(np.stack(steps, axis=2)) @ error[:, :, None])[..., 0]
        left = np.abs(self.error(q, u)).max(axis=1)
        beyond = np.maximum(self.low - q, q - self.high)[:, self.free].max(axis=1)
        bad = np.flatnonzero((left > 1e-9) | (beyond > 1e-9))
        return sum(not self._found(q[k], u[k], rng, tries) for k in bad), float(np.delete(left, bad).max(initial=0.0))

    def _found(self, q: Array, u: Array, rng: np.random.Generator, tries: int) -> bool:
        """Whether bounded least squares finds one, from there and from elsewhere."""
        low, high = self.low[self.free], self.high[self.free]

        def error(x: Array) -> Array:
            full = q.copy()
            full[self.free] = x
            return self.error(full[None], u[None])[0]

        for k in range(tries):
            start = q[self.free] if k == 0 else rng.uniform(low, high)
            found: Any = least_squares(
                error, start.clip(low + 1e-9, high - 1e-9), bounds=(low, high), xtol=1e-15, ftol=1e-15, gtol=1e-15
            )
            # It stays strictly inside of the limits: where one is in the way, it comes near to 0 only.
            if np.abs(found.fun).max() < 1e-7:
                return True
        return False


def _numbers(texts: list[str]) -> list[float]:
    return [float.fromhex(text) for text in texts]
