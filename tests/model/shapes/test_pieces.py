"""Shapes of a URDF file: sizes, places, and meshes as written, against values by hand and trimesh."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

import holdfast as hf
from holdfast.model.shapes import read_pieces, unchecked_pairs

JOINT = '<joint name="j{k}" type="revolute"><parent link="l{a}"/><child link="l{k}"/><origin xyz="{x} 0 0"/><axis xyz="0 0 1"/>'
LIMIT = '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>'
COLLISION = (
    '<link name="{name}"><collision><origin xyz="{xyz}" rpy="0 0 {yaw}"/><geometry>{geometry}</geometry></collision></link>'
)


@pytest.fixture
def arm(tmp_path):
    """Three links with a box, a cylinder, and a tetrahedron, and a sphere at the base."""
    trimesh.creation.box([0.2, 0.4, 0.6]).export(tmp_path / "block.stl")
    geometries = {
        "l0": '<sphere radius="0.1"/>',
        "l1": '<box size="0.1 0.2 0.3"/>',
        "l2": '<cylinder radius="0.05" length="0.4"/>',
        "l3": '<mesh filename="block.stl" scale="1 1 2"/>',
    }
    links = [
        COLLISION.format(name=name, xyz=f"0 0 0.{k}", yaw=k / 10, geometry=geometry)
        for k, (name, geometry) in enumerate(geometries.items())
    ]
    joints = [JOINT.format(k=k, a=k - 1, x=k / 2) + LIMIT for k in (1, 2, 3)]
    file = tmp_path / "arm.urdf"
    file.write_text(f'<robot name="shapes">{"".join(links + joints)}</robot>', encoding="utf-8")
    return hf.Arm.from_urdf(file)


def test_sizes_and_poses_are_those_of_the_file(arm):
    pieces, missing = read_pieces(arm, "collision")
    assert missing == []
    assert [(piece.link, piece.owner, piece.kind) for piece in pieces] == [
        (-1, "l0", "sphere"),
        (0, "l1", "box"),
        (1, "l2", "cylinder"),
        (2, "l3", "mesh"),
    ]
    assert [piece.size for piece in pieces[:3]] == [(0.1,), (0.1, 0.2, 0.3), (0.05, 0.4)]
    for k, piece in enumerate(pieces):
        np.testing.assert_allclose(piece.pose[:3, 3], [0, 0, k / 10], atol=1e-12)
        np.testing.assert_allclose(piece.pose[0, :2], [np.cos(k / 10), -np.sin(k / 10)], atol=1e-12)


def test_a_mesh_has_the_volume_that_trimesh_computes(arm):
    mesh = read_pieces(arm, "collision")[0][-1]
    assert trimesh.Trimesh(mesh.vertices, mesh.faces).volume == pytest.approx(0.2 * 0.4 * 1.2)


def test_a_mesh_that_is_gone_is_named(arm, tmp_path):
    (tmp_path / "block.stl").unlink()
    pieces, missing = read_pieces(arm, "collision")
    assert len(pieces) == 3
    (gone,) = missing
    assert gone.link == 2
    assert "block.stl" in gone.what
    assert not gone.is_present


def test_without_an_srdf_file_no_pair_is_excluded(arm):
    assert unchecked_pairs(arm) == frozenset()
