"""The locked arm of a path certificate, integrated by scipy along the tool path of the healthy one: what its text says."""

from __future__ import annotations

import base64
import json
import zlib
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

SEGMENT = 2**20
ROWS = {task: list(range(count)) for task, count in (("planar", 2), ("position", 3), ("pointing", 5), ("pose", 6))}
ROWS["planar-pose"] = [0, 1, 5]


class Driven:
    """Made from the text alone."""

    def __init__(self, file: Path) -> None:
        self.document = document = json.loads(file.read_text(encoding="utf-8"))
        frames = [*document["arm"]["joints"], document["arm"]["tool"]]
        self.turns = [np.reshape(_numbers(frame["rotation"]), (3, 3)) for frame in frames]
        self.origins = [np.array(_numbers(frame["origin"])) for frame in frames]
        self.slides = [joint["type"] == "prismatic" for joint in document["arm"]["joints"]]
        self.knots = np.array([_numbers(knot) for knot in document["knots"]])
        self.low, self.high = np.array([_numbers(pair) for pair in document["limits"]]).T
        self.rows = ROWS[document["task"]]

    def tool(self, q):
        """Place and rotation of the tool, and the Jacobian (6, n)."""
        place, turn, axes, points = np.zeros(3), np.eye(3), [], []
        for k, value in enumerate(q):
            place, turn = place + turn @ self.origins[k], turn @ self.turns[k]
            axes.append(turn[:, 2])
            points.append(place)
            if self.slides[k]:
                place = place + value * axes[-1]
            else:
                turn = turn @ Rotation.from_rotvec([0, 0, value]).as_matrix()
        place, turn = place + turn @ self.origins[-1], turn @ self.turns[-1]
        columns = [
            np.append(z, 0 * z) if slide else np.append(np.cross(z, place - p), z)
            for z, p, slide in zip(axes, points, self.slides, strict=True)
        ]
        return place, turn, np.array(columns).T

    def healthy(self, s):
        """Joints at s, in segments, and their rates."""
        k = min(int(s), len(self.knots) - 2)
        rates = self.knots[k + 1] - self.knots[k]
        return self.knots[k] + (s - k) * rates, rates

    def slabs(self, lock):
        """Proved intervals of lock instants, in segments."""
        numbers = np.frombuffer(zlib.decompress(base64.b64decode(lock["cells"])), "<i8")
        at, found = 0, []
        while at < len(numbers):
            found.append((numbers[at] / SEGMENT, numbers[at + 1] / SEGMENT))
            at += 3 + int(numbers[at + 2])
        return found

    def finished(self, lock, instant):
        """How far the tool is from the path at the end, m and rad, and how far joints go beyond their limits, on the way."""
        still = [lock["joint"], *lock["followers"]]
        free = [k for k in range(len(self.low)) if k not in still]
        start, _ = self.healthy(instant)
        q, at, beyond = start.copy(), instant, 0.0

        def placed(x, s):
            full = self.healthy(s)[0]
            full[free], full[lock["joint"]] = x, start[lock["joint"]]
            return full

        while at < len(self.knots) - 1:
            end = min(np.floor(at) + 1, len(self.knots) - 1.0)
            middle = (at + end) / 2

            def rate(s, x, middle=middle):
                healthy, rates = self.healthy(s)[0], self.healthy(middle)[1]
                wanted = self.tool(healthy)[2] @ rates
                slope, frame = self.tool(placed(x, s))[2], self.tool(healthy)[1].T
                wanted[3:], slope[3:] = frame @ wanted[3:], frame @ slope[3:]
                wanted -= slope[:, lock["followers"]] @ rates[lock["followers"]]
                return np.linalg.solve(slope[self.rows][:, free], wanted[self.rows])

            done = solve_ivp(rate, (at, end), q[free], rtol=1e-8, atol=1e-10, method="DOP853")
            assert done.success
            every = np.array([placed(x, s) for x, s in zip(done.y.T, done.t, strict=True)])
            beyond = max(beyond, float(np.maximum(self.low - every, every - self.high).max()))
            q, at = every[-1], end
        place, turn, _ = self.tool(q)
        goal, wanted, _ = self.tool(self.knots[-1])
        off = np.append(place - goal, Rotation.from_matrix(wanted.T @ turn).as_rotvec())[self.rows]
        return float(np.abs(off).max()), beyond


def _numbers(texts):
    return [float.fromhex(text) for text in texts]
