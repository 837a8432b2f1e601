"""What is drawn of an arm: closed bodies in the right frames."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import holdfast as hf
from holdfast import arms
from holdfast.interface.presentation.arm.body import build_stick_parts, mesh_block, mesh_box, mesh_cylinder, mesh_sphere
from holdfast.interface.presentation.arm.view import scene
from holdfast.interface.presentation.arm.visuals import build_body, read_visual_parts
from holdfast.interface.report.viewer import embed_viewer_library
from holdfast.interface.studio.scene.machine import CompiledArm
from holdfast.model.arm.formats.mesh_files import find_mesh
from holdfast.model.arm.task import as_task

CRANE = Path(__file__).parent / "arms" / "inspection-crane.urdf"


def volume(vertices, faces):
    """Of a closed body, above 0 if its normals look outwards (Gauss)."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def test_shapes_are_closed_and_look_outwards(rng):
    start, end = rng.normal(size=(2, 3))
    length = np.linalg.norm(end - start)
    ring = 20 * np.sin(2 * np.pi / 20) / 2
    assert volume(*mesh_cylinder(start, end, 0.3)) == pytest.approx(ring * 0.3**2 * length)
    assert volume(*mesh_box(np.array([1.0, 2.0, 3.0]))) == pytest.approx(6)
    axis = rng.normal(size=3)
    assert volume(*mesh_block(axis / np.linalg.norm(axis), 0.5)) == pytest.approx(0.125)
    assert volume(*mesh_sphere(40)) == pytest.approx(4 / 3 * np.pi, rel=0.01)


def test_sticks_reach_from_joint_to_joint(mixed7, rng):
    machine = CompiledArm(mixed7, as_task(mixed7, "pose"))
    parts = build_stick_parts(mixed7, machine.size)
    frames = machine.arm.frames(rng.uniform(-1, 1, 7))
    assert {p.joint for p in parts if p.joint is not None} == set(range(7))
    for k in range(7):
        cloud = np.concatenate(
            [p.vertices @ frames[p.frame, :3, :3].T + frames[p.frame, :3, 3] for p in parts if p.frame <= k and p.joint is None]
        )
        origin = (frames[k] @ mixed7.joints[k].origin)[:3, 3]
        assert np.linalg.norm(cloud - origin, axis=1).min() < 0.1 * machine.size


def test_visuals_are_where_the_file_puts_them():
    arm = arms.load(str(CRANE))
    machine = CompiledArm(arm, as_task(arm, "pose"))
    parts, missing = read_visual_parts(arm)
    assert missing == [(6, "package://inspection_crane/meshes/camera.stl", False)]
    assert sorted({p.frame for p in parts}) == list(range(7))
    rail = next(p for p in parts if p.frame == 0)
    np.testing.assert_allclose(rail.vertices.max(axis=0) - rail.vertices.min(axis=0), [0.3, 1.6, 0.08])
    np.testing.assert_allclose(rail.vertices.mean(axis=0), [0, 0, -0.06], atol=1e-12)
    assert rail.color == (158, 168, 178)
    boom = next(p for p in parts if p.frame == 3)
    q = np.array([0.3, 0.0, np.pi / 2, 0.4, 0, 0, 0])
    world = boom.vertices @ machine.arm.frames(q)[3, :3, :3].T + machine.arm.frames(q)[3, :3, 3]
    np.testing.assert_allclose(world.mean(axis=0), [0.25, 0.3, 0.5], atol=1e-9)  # lies along x at the height of the mast


def test_meshes_are_read_and_missing_ones_named(tmp_path):
    pytest.importorskip("trimesh")
    folder = tmp_path / "inspection_crane"
    (folder / "meshes").mkdir(parents=True)
    (folder / "urdf").mkdir()
    file = folder / "urdf" / "crane.urdf"
    file.write_text(CRANE.read_text())
    corners, faces = mesh_box(np.array([0.06, 0.06, 0.08]))
    text = ["solid camera"]
    for face in faces:
        text += [
            "facet normal 0 0 0",
            "outer loop",
            *(f"vertex {' '.join(map(str, corners[k]))}" for k in face),
            "endloop",
            "endfacet",
        ]
    (folder / "meshes" / "camera.stl").write_text("\n".join([*text, "endsolid camera"]))
    parts, missing = read_visual_parts(arms.load(str(file)))
    assert missing == []
    camera = next(p for p in parts if p.frame == 7)
    assert volume(camera.vertices, camera.faces) == pytest.approx(0.06 * 0.06 * 0.08)
    assert find_mesh("../meshes/camera.stl", file) is not None
    assert find_mesh("http://example.org/camera.stl", file) is None
    (folder / "meshes" / "camera.stl").write_text("no mesh")
    _, missing = read_visual_parts(arms.load(str(file)))
    assert len(missing) == 1
    assert "camera.stl" in missing[0].what


def test_links_above_the_base_are_left_out():
    arm = arms.load(str(CRANE), base="mast")
    parts, _ = read_visual_parts(arm)
    assert arm.joint_names[0] == "luff"
    assert sorted({p.frame for p in parts}) == [0, 1, 2, 3, 4]


def test_a_built_in_arm_and_a_missing_file_have_sticks():
    arm = hf.arms.load("panda")
    assert build_body(arm, 1.0)[1] == ""
    parts, note = build_body(arms.load(str(CRANE)), 1.0)
    assert "camera.stl" in note
    assert {p.frame for p in parts} == set(range(8))


def test_a_mesh_that_is_there_and_cannot_be_read_is_not_called_missing_and_noted_once(tmp_path):
    file = tmp_path / "crane.urdf"
    file.write_text(CRANE.read_text().replace("package://inspection_crane/meshes/camera.stl", "camera.stl"))
    (tmp_path / "camera.stl").write_text("solid camera")
    arm = hf.arms.load(str(file))
    _, note = build_body(arm, 1.0)
    assert note.startswith("of the meshes in the file, 1 found but not readable, such as camera.stl (")
    shown = scene(arm, [0.0] * arm.n)
    page = embed_viewer_library(f"<head></head><body>{shown.to_html('one', 'a')}{shown.to_html('two', 'b')}</body>")
    assert page.count("found but not readable") == 1
