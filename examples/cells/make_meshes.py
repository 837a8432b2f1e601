"""Makes the meshes of bench.yaml: bodies of blocks, written as STL and GLB. Own work, in m (the STL of the vise in mm)."""

from pathlib import Path

import numpy as np
import trimesh


def body(x: list[float], y: list[float], z: list[float], solid: list[tuple[int, int, int]]) -> trimesh.Trimesh:
    """The surface of some blocks of the grid with these edges."""
    edges = [np.array(e) for e in (x, y, z)]
    filled = np.zeros([len(e) - 1 for e in edges], dtype=bool)
    for block in solid:
        filled[block] = True
    padded = np.pad(filled, 1)
    triangles = []
    for block in np.argwhere(filled):
        for axis in range(3):
            for side in (0, 1):
                beside = block + 1
                beside[axis] += 2 * side - 1
                if padded[tuple(beside)]:
                    continue
                a, b = (axis + 1) % 3, (axis + 2) % 3
                corner = np.zeros((4, 3))
                for k, (i, j) in enumerate([(0, 0), (1, 0), (1, 1), (0, 1)]):
                    place = np.array(block)
                    place[[axis, a, b]] += [side, i, j]
                    corner[k] = [edges[n][place[n]] for n in range(3)]
                order = [0, 1, 2, 0, 2, 3] if side else [0, 2, 1, 0, 3, 2]
                triangles.append(corner[order].reshape(2, 3, 3))
    made = trimesh.Trimesh(**trimesh.triangles.to_kwargs(np.concatenate(triangles)))
    made.merge_vertices()
    assert made.is_watertight
    return made


here = Path(__file__).parent
# Two jaws on a bed: not convex.
vise = body([-60, -35, 35, 60], [-70, 70], [0, 40, 110], [(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 0, 1), (2, 0, 1)])
vise.export(here / "vise.stl")
# A tray with a floor and four walls.
edge = [-0.15, -0.14, 0.14, 0.15]
walls = [(i, j, k) for i in range(3) for j in range(3) for k in range(2) if k == 0 or (i, j) != (1, 1)]
body(edge, edge, [0, 0.01, 0.12], walls).export(here / "tray.glb")
# A portal that carries a camera.
body([-0.03, 0.03], [-0.45, -0.4, 0.4, 0.45], [0, 0.75, 0.8], [(0, 0, 0), (0, 2, 0), (0, 0, 1), (0, 1, 1), (0, 2, 1)]).export(
    here / "portal.stl"
)
