"""Which locks a motion of four unit links in the plane survives: reachability over closed forms of the failed arm.

With a joint locked three are left for the two coordinates of the tool: at every pose the failed arm has curves of
configurations, and it goes on to the next pose from whatever it gets to on them.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

JOINTS, GRID = 4, 241
NEAR, NEXT = 0.12, 0.2  # rad: joined on one pose, and from pose to pose


def around(x):
    return np.arctan2(np.sin(x), np.cos(x))


def configurations(low, high, lock, value, point):
    """Those (N, 4) of a point (2,) with a joint locked: one of the others on a grid, two by the law of cosines."""
    found, free = [], [k for k in range(JOINTS) if k != lock]
    for given in free:
        a, b = (k for k in free if k != given)
        q = np.zeros((GRID, JOINTS))
        q[:, lock], q[:, given] = value, np.linspace(low[given], high[given], GRID)
        links = np.exp(1j * np.cumsum(q, axis=1))
        # What lies between joints a and b is one link, what lies behind b another.
        first, second = links[:, a:b].sum(axis=1), links[:, b:].sum(axis=1)
        way = point[0] + 1j * point[1] - links[:, :a].sum(axis=1)
        one, other, far = abs(first), abs(second), abs(way)
        with np.errstate(all="ignore"):
            cosine = (far**2 - one**2 - other**2) / (2 * one * other)
        for sign in (-1, 1):
            bend = sign * np.arccos(np.clip(cosine, -1, 1))
            x = q.copy()
            x[:, a] = around(np.angle(way) - np.arctan2(other * np.sin(bend), one + other * np.cos(bend)) - np.angle(first))
            x[:, b] = around(bend - np.angle(second) + np.angle(first))
            found.append(x[(np.abs(cosine) <= 1) & ((x >= low - 1e-9) & (x <= high + 1e-9)).all(axis=1)])
    return np.concatenate(found)


def survives(low, high, q, lock, points):
    """Whether the arm at q (4,) with a joint locked gets through all points (S, 2), the first of which is that of q."""
    there = q[None]
    for k, point in enumerate(points):
        every = configurations(low, high, lock, q[lock], point)
        if not len(every):
            return False
        pairs = cKDTree(every).query_pairs(NEAR, output_type="ndarray")
        graph = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(every),) * 2)
        part = connected_components(graph, directed=False)[1]
        reached = part[cKDTree(there).query(every)[0] <= (NEXT if k else NEAR)]
        there = every[np.isin(part, reached)]
        if not len(there):
            return False
    return True
