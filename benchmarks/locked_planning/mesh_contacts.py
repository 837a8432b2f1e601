"""Contacts of the collision meshes, by python-fcl, for the track *meshes* of the validator."""

from __future__ import annotations

from typing import Any

import numpy as np
from benchmarks.locked_planning.validator import Floats, Json, forward_kinematics, rotation_matrix, signed_distances


class MeshContacts:
    """Contacts of a robot of triangle meshes with objects and with itself; same interface as ``SphereContacts``.

    The bounding sphere of each mesh is tested first, in NumPy; python-fcl tests the rest.
    """

    def __init__(self, robot: Json, objects: list[Json]) -> None:
        import fcl

        self.robot, self.objects, self.fcl = robot, objects, fcl
        pieces = robot["pieces"]
        self.links = [piece["link"] for piece in pieces]
        self.middles = np.array([(piece["vertices"].min(axis=0) + piece["vertices"].max(axis=0)) / 2 for piece in pieces])
        gaps = [np.linalg.norm(piece["vertices"] - middle, axis=1) for piece, middle in zip(pieces, self.middles, strict=True)]
        self.reach = np.array([gap.max() for gap in gaps])
        self.meshes = [fcl.CollisionObject(self._model(piece)) for piece in pieces]
        self.solids = [self._solid(shape) for shape in objects]

    def _model(self, piece: Json) -> Any:
        model = self.fcl.BVHModel()
        model.beginModel(len(piece["vertices"]), len(piece["faces"]))
        model.addSubModel(piece["vertices"], piece["faces"])
        model.endModel()
        return model

    def _solid(self, shape: Json) -> Any:
        fcl, kind = self.fcl, shape["kind"]
        makers = {
            "box": lambda: fcl.Box(*shape["size"]),
            "cylinder": lambda: fcl.Cylinder(shape["radius"], shape["length"]),
            "capsule": lambda: fcl.Capsule(shape["radius"], shape["length"]),
            "sphere": lambda: fcl.Sphere(shape["radius"]),
        }
        return fcl.CollisionObject(makers[kind](), fcl.Transform(rotation_matrix(shape["quaternion_xyzw"]), shape["position"]))

    def _depth(self, one: Any, other: Any) -> float:
        """Return the depth of the overlap of two objects, m; 0 if they do not touch."""
        result = self.fcl.CollisionResult()
        request = self.fcl.CollisionRequest(num_max_contacts=1, enable_contact=True)
        if not self.fcl.collide(one, other, request, result):
            return 0.0
        return max([abs(float(contact.penetration_depth)) for contact in result.contacts] + [1e-9])

    def distances(self, q: Floats) -> tuple[Floats, list[str]]:
        """Return (N,) minus the depth of the first overlap found at each configuration, m, or 0, and the names of the parts."""
        poses, _ = forward_kinematics(self.robot, q)
        centers = np.stack(
            [
                poses[:, link, :3, :3] @ middle + poses[:, link, :3, 3]
                for link, middle in zip(self.links, self.middles, strict=True)
            ],
            axis=1,
        )
        near = np.zeros((len(q), len(self.links), len(self.objects)), dtype=bool)
        for index, shape in enumerate(self.objects):
            near[..., index] = signed_distances(shape, centers) < self.reach
        pairs = [
            (first, second)
            for first, link in enumerate(self.links)
            for second, other in enumerate(self.links)
            if [link, other] in self.robot["self_pairs"]
        ]
        depths, names = np.zeros(len(q)), [""] * len(q)
        for row in range(len(q)):
            close = [
                (one, other)
                for one, other in pairs
                if np.linalg.norm(centers[row, one] - centers[row, other]) < self.reach[one] + self.reach[other]
            ]
            touched = np.argwhere(near[row])
            for piece in {*touched[:, 0].tolist(), *(index for pair in close for index in pair)}:
                pose = poses[row, self.links[piece]]
                self.meshes[piece].setTransform(self.fcl.Transform(pose[:3, :3], pose[:3, 3]))
            tests = [
                (self.solids[index], self.meshes[piece], f"link {self.links[piece]} and '{self.objects[index]['name']}'")
                for piece, index in touched
            ] + [
                (self.meshes[one], self.meshes[other], f"link {self.links[one]} and link {self.links[other]}")
                for one, other in close
            ]
            for one, other, name in tests:
                depth = self._depth(one, other)
                if depth > 0:
                    depths[row], names[row] = depth, name
                    break
        return -depths, names
