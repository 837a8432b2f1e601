"""The same cell through URDF, MJCF and YAML is the same cell; MuJoCo agrees on where its objects are."""

import mujoco
import numpy as np
import pytest
import trimesh

import holdfast as hf
from holdfast.model.cell import Box, HalfSpace, Mesh, field

URDF = """<robot name="bench">
  <link name="world"/>
  <link name="table"><collision><origin xyz="0.5 0 -0.02"/><geometry><box size="0.8 1.2 0.04"/></geometry></collision></link>
  <link name="post"><collision><origin rpy="0 0.1 0"/><geometry><cylinder radius="0.05" length="1"/></geometry></collision>
    <collision><origin xyz="0 0 0.6"/><geometry><sphere radius="0.12"/></geometry></collision></link>
  <link name="jig"><collision><geometry><mesh filename="jig.stl" scale="0.001 0.001 0.001"/></geometry></collision></link>
  <link name="foot"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
  <link name="arm1"><collision><origin xyz="0.15 0 0"/><geometry><box size="0.3 0.05 0.05"/></geometry></collision></link>
  <link name="arm2"><collision><origin xyz="0.15 0 0"/><geometry><box size="0.3 0.05 0.05"/></geometry></collision></link>
  <joint name="t" type="fixed"><parent link="world"/><child link="table"/><origin xyz="0 0 0" rpy="0 0 0.3"/></joint>
  <joint name="p" type="fixed"><parent link="table"/><child link="post"/><origin xyz="0.2 0.55 0.5" rpy="0.2 0 0"/></joint>
  <joint name="j" type="fixed"><parent link="table"/><child link="jig"/><origin xyz="0.4 -0.3 0.2" rpy="0 1 0"/></joint>
  <joint name="f" type="fixed"><parent link="world"/><child link="foot"/><origin xyz="0 0 0.3" rpy="0 0 1"/></joint>
  <joint name="a" type="revolute"><parent link="foot"/><child link="arm1"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2"/></joint>
  <joint name="b" type="revolute"><parent link="arm1"/><child link="arm2"/><origin xyz="0.3 0 0"/><axis xyz="0 0 1"/>
    <limit lower="-2" upper="2"/></joint>
  <link name="tip"/>
  <joint name="e" type="fixed"><parent link="arm2"/><child link="tip"/><origin xyz="0.3 0 0"/></joint>
</robot>"""

MJCF = """<mujoco model="bench"><compiler angle="radian" eulerseq="XYZ" meshdir="."/>
  <asset><mesh name="jig" file="jig.stl" scale="0.001 0.001 0.001"/></asset>
  <worldbody>
    <body name="table" euler="0 0 0.3"><geom type="box" size="0.4 0.6 0.02" pos="0.5 0 -0.02"/>
      <body name="post" pos="0.2 0.55 0.5" euler="0.2 0 0"><geom type="cylinder" size="0.05 0.5" euler="0 0.1 0"/>
        <geom type="sphere" size="0.12" pos="0 0 0.6"/></body>
      <body name="jig" pos="0.4 -0.3 0.2" euler="0 1 0"><geom type="mesh" mesh="jig"/></body>
    </body>
    <body name="foot" pos="0 0 0.3" euler="0 0 1"><geom type="box" size="0.05 0.05 0.05"/>
      <body name="arm1"><joint name="a" axis="0 1 0" range="-2 2"/><geom type="box" size="0.15 0.025 0.025" pos="0.15 0 0"/>
        <body name="arm2" pos="0.3 0 0"><joint name="b" axis="0 0 1" range="-2 2"/>
          <geom type="box" size="0.15 0.025 0.025" pos="0.15 0 0"/><site name="tip" pos="0.3 0 0"/></body></body></body>
  </worldbody></mujoco>"""

YAML = """
objects:
  table: {box: [0.8, 1.2, 0.04], pose: %s}
  post: {cylinder: {radius: 0.05, length: 1.0}, pose: %s}
  post 2: {sphere: 0.12, pose: %s}
  jig: {mesh: jig.stl, scale: 0.001, pose: %s}
"""


def turned(axis: str, angle: float, xyz=(0, 0, 0)) -> np.ndarray:
    pose = trimesh.transformations.rotation_matrix(angle, np.eye(3)["xyz".index(axis)])
    pose[:3, 3] = xyz
    return pose


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setattr(field, "_MAX_NODES", 30_000)
    shape = trimesh.convex.convex_hull(np.random.default_rng(5).normal(scale=60, size=(30, 3)))
    shape.export(tmp_path / "jig.stl")
    (tmp_path / "bench.urdf").write_text(URDF)
    (tmp_path / "bench.xml").write_text(MJCF)
    table = turned("z", 0.3)
    post = table @ turned("x", 0.2, (0.2, 0.55, 0.5))
    poses = [table @ turned("z", 0, (0.5, 0, -0.02)), post @ turned("y", 0.1), post @ turned("z", 0, (0, 0, 0.6))]
    poses.append(table @ turned("y", 1.0, (0.4, -0.3, 0.2)))
    (tmp_path / "bench.yaml").write_text(YAML % tuple(pose.tolist() for pose in poses))
    return tmp_path


def test_the_same_cell_from_three_files_gives_the_same_clearances(folder, rng):
    cells = [hf.Cell.load(folder / name) for name in ("bench.yaml", "bench.urdf", "bench.xml")]
    names = ["table", "post", "post 2", "jig"]
    assert [sorted(solid.name for solid in cell) for cell in cells] == [sorted(names)] * 3
    assert cells[1].name == cells[2].name == "bench"
    jig = next(solid for solid in cells[0] if solid.name == "jig")
    points = np.concatenate([rng.uniform(-1, 1, (300, 3)), jig.pose[:3, 3] + rng.uniform(-0.2, 0.2, (300, 3))])
    expected = np.stack([solid.signed_distance(points) for solid in cells[0]])
    by_name = [{solid.name: solid for solid in cell} for cell in cells]
    assert np.abs(expected).min() < 0.01
    for solids, atol in ((by_name[1], 1e-6), (by_name[2], 4 * by_name[0]["jig"].field.grid.width)):
        for name, row in zip(names, expected, strict=True):
            # MuJoCo turns a mesh into its own axes, so its grid is another one; what is beyond it is seen less sharply.
            close = row < (0.1 if name == "jig" else np.inf)
            assert close.sum() > 5
            np.testing.assert_allclose(
                solids[name].signed_distance(points)[close], row[close], atol=atol if name == "jig" else 1e-7
            )
    arms = [
        hf.Arm.from_urdf(folder / "bench.urdf"),
        hf.Arm.from_urdf(folder / "bench.urdf"),
        hf.Arm.from_mjcf(folder / "bench.xml", tip="tip"),
    ]
    q = rng.uniform(-2, 2, (200, 2))
    primitives = [hf.Cell([by[name] for name in names[:3]], may_touch=[("table", "base")]) for by in by_name]
    clear = [
        hf.Clearance(arm, hf.Capsules.along_links(arm, 0.03), cell, itself=False)(q)
        for arm, cell in zip(arms, primitives, strict=True)
    ]
    np.testing.assert_allclose(clear[1], clear[0], atol=1e-7)
    np.testing.assert_allclose(clear[2], clear[0], atol=1e-7)
    assert (clear[0] < 0).any()
    assert (clear[0] > 0).any()


def test_mujoco_sees_the_objects_where_they_are(folder):
    cell = hf.Cell.from_mjcf(folder / "bench.xml")
    model = mujoco.MjModel.from_xml_path(str(folder / "bench.xml"))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    wanted = [k for k in range(model.ngeom) if model.body(int(model.geom_bodyid[k])).name in ("table", "post", "jig")]
    np.testing.assert_allclose([solid.pose[:3, 3] for solid in cell], data.geom_xpos[wanted], atol=1e-12)
    turns = np.stack([solid.pose[:3, :3].ravel() for solid in cell])
    np.testing.assert_allclose(turns, data.geom_xmat[wanted], atol=1e-12)


def test_the_links_of_the_arm_and_what_carries_it_are_no_objects(folder):
    for cell in (hf.Cell.from_urdf(folder / "bench.urdf"), hf.Cell.from_mjcf(folder / "bench.xml", tip="arm2")):
        assert not {solid.name for solid in cell} & {"foot", "arm1", "arm2"}
    held = hf.Cell.from_urdf(folder / "bench.urdf", hold={"a": 0.5})
    assert "arm1" not in {solid.name for solid in held}
    above = hf.Cell.from_urdf(folder / "bench.urdf", base="foot")
    table = next(solid for solid in above if solid.name == "table")
    world = np.linalg.inv(turned("z", 1.0, (0, 0, 0.3))) @ turned("z", 0.3) @ turned("z", 0, (0.5, 0, -0.02))
    np.testing.assert_allclose(table.pose, world, atol=1e-12)


def test_files_in_which_nothing_moves(tmp_path):
    (tmp_path / "a.urdf").write_text(
        '<robot name="r"><link name="x"><collision><geometry><box size="1 1 1"/></geometry></collision></link></robot>'
    )
    (tmp_path / "b.xml").write_text(
        '<mujoco><worldbody><geom type="plane" size="1 1 1" pos="0 0 -1"/><geom type="box" size="1 1 1"/>'
        '<geom type="box" size="2 2 2" contype="0" conaffinity="0"/></worldbody></mujoco>'
    )
    assert [type(x) for x in hf.Cell.load(tmp_path / "a.urdf")] == [Box]
    floor, box = hf.Cell.load(tmp_path / "b.xml")
    assert isinstance(floor, HalfSpace)
    assert floor.name == "half space"
    assert (box.name, box.size.tolist()) == ("box", [2, 2, 2])
    np.testing.assert_allclose(floor.signed_distance([5, 5, 0]), 1)


def test_objects_have_the_names_of_their_geoms(folder):
    named = MJCF.replace('<geom type="sphere"', '<geom name="knob" type="sphere"').replace(
        '<geom type="mesh"', '<geom name="post" type="mesh"'
    )
    (folder / "named.xml").write_text(named)
    cell = hf.Cell.from_mjcf(folder / "named.xml")
    model = mujoco.MjModel.from_xml_path(str(folder / "named.xml"))
    assert [solid.name for solid in cell] == ["table", "post 2", "knob", "post"]  # the first of the body 'post' has no name
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    for solid in cell:
        if solid.name in ("knob", "post"):
            np.testing.assert_allclose(solid.pose[:3, 3], data.geom(solid.name).xpos, atol=1e-12)


@pytest.mark.parametrize(
    ("file", "text", "said"),
    [
        ("a.urdf", URDF.replace("jig.stl", "none.stl"), r"a shape in it cannot be read: none\.stl"),
        ("a.urdf", URDF.replace('box size="0.8 1.2 0.04"', 'torus size="1"'), "shape 'torus'"),
        ("a.urdf", URDF.replace('<link name="tip"/>', '<link name="tip"/><link name="tip"/>'), "used more than once"),
        ("a.urdf", "<robot", "not valid XML"),
        ("a.xml", "<other/>", "outermost"),
        (
            "a.xml",
            MJCF.replace('type="sphere" size="0.12"', 'type="ellipsoid" size="1 1 2"'),
            "is an ellipsoid, which has no distance formula",
        ),
        ("a.xml", MJCF.replace("jig.stl", "none.stl"), "none.stl"),
        ("a.mjcf", "<mujoco", "not valid XML"),
    ],
)
def test_what_is_wrong_is_one_sentence(folder, file, text, said):
    (folder / file).write_text(text)
    with pytest.raises(hf.InputError, match=said) as caught:
        hf.Cell.load(folder / file)
    assert str(caught.value).startswith("cell file '")


def test_a_mesh_that_is_not_closed_is_its_hull(folder):
    shape = trimesh.load(folder / "jig.stl")
    trimesh.Trimesh(shape.vertices, shape.faces[1:]).export(folder / "jig.stl")
    jig = next(x for x in hf.Cell.load(folder / "bench.urdf") if isinstance(x, Mesh))
    assert jig.solid == "hull"
