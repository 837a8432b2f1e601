"""Path files: what they mean, and the sentence for everything that can be wrong in one."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import oracles
from holdfast import InputError
from holdfast.kinematics.paths import Path, TimedPath, path_file


@pytest.fixture
def write(tmp_path):
    def to(text, name="along.yaml"):
        path = tmp_path / name
        path.write_bytes(text) if isinstance(text, bytes) else path.write_text(text)
        return path

    return to


def test_the_example_of_the_documentation(write):
    block, rest = path_file.__doc__.split(".. code-block:: yaml\n", 1)[1].split("Other paths::")
    timed = TimedPath.load(write(block))
    assert (timed.path.name, timed.duration, timed.stop) == ("along the glove box", 10, False)
    np.testing.assert_allclose(timed.path.pose([0, 1])[:, :3, 3], [[0.4, -0.3, 0.5], [0.4, 0.3, 0.5]])
    np.testing.assert_allclose(timed.path.pose([0, 1])[:, :3, :3], [np.diag([1, -1, -1])] * 2, atol=1e-15)
    write("x,y,z\n0,0,1\n1,0,1\n", "poses.csv")
    for text in rest.split("If no pose")[0].strip().splitlines():
        path = Path.load(write(text.strip()))
        assert not path.oriented
        assert path.name == "along"


def test_angles(write):
    poses = "poses: [{{xyz: [0, 0, 0], urdf_rpy: [{0}, {1}, {2}]}}, {{xyz: [0, 0, 1e-1]}}]"
    want = Rotation.from_euler("ZYX", [0.3, -0.2, 0.1]).as_matrix()  # Rz(yaw) Ry(pitch) Rx(roll)
    path = Path.load(write(poses.format(0.1, -0.2, 0.3)))
    np.testing.assert_allclose(path.pose([0, 1])[:, :3, :3], [want] * 2, atol=1e-15)
    assert path.length == pytest.approx(0.1)
    degrees = Path.load(write("angles: deg\n" + poses.format(*np.degrees([0.1, -0.2, 0.3]))))
    np.testing.assert_allclose(degrees.pose(0.3), path.pose(0.3), atol=1e-14)
    arc = Path.load(write("angles: deg\narc: {from: {xyz: [1, 0, 0]}, center: [0, 0, 0], axis: [0, 0, 1], angle: 90}"))
    np.testing.assert_allclose(arc.pose(1.0)[:3, 3], [0, 1, 0], atol=1e-15)


def test_a_table_of_poses(write, rng):
    poses = np.stack([oracles.random_pose(rng) for _ in range(4)])
    quaternion = Rotation.from_matrix(poses[:, :3, :3]).as_quat()
    rows = [
        "qw,qx,qy,qz, x,y,z",
        *[",".join(f"{v:.17g}" for v in (q[3], *q[:3], *t[:3, 3])) for q, t in zip(quaternion, poses, strict=True)],
    ]
    write("\n".join(rows) + "\n\n", "given.csv")
    path = Path.load(write("poses: given.csv"))
    np.testing.assert_allclose(path.pose(path.bounds), poses, atol=1e-12)


def test_timing(write):
    timed = TimedPath.load(
        write("poses: [{xyz: [0, 0, 0]}, {xyz: [1, 0, 0]}]\ntiming: {duration: 4, accelerate: 0.1, stop: true}")
    )
    assert (timed.timing.accelerate, timed.timing.decelerate, timed.stop) == (0.1, 0.2, True)
    file = write("poses: [{xyz: [0, 0, 0]}, {xyz: [1, 0, 0]}]")
    with pytest.raises(InputError, match="has no timing; write 'timing"):
        TimedPath.load(file)


P = "{xyz: [0, 0, 0]}"
REFUSED = [
    ("", "the file must hold keys and values, at least line, arc or poses"),
    ("- 1", "the file must hold keys and values"),
    ("line: [", "this is not valid YAML"),
    ("name: x", "it must hold one of 'line:', 'arc:' and 'poses:'"),
    (f"line: {{from: {P}, to: {P}}}\nposes: [{P}]", "it must hold one of"),
    (f"line: {{from: {P}, to: {P}}}", "are the same; leave one of them out"),
    (f"line: {{from: {P}}}", "line.to: it is missing; it must be given"),
    (f"line: {{from: {P}, to: {P}, to: {P}}}", "the key 'to' is given twice"),
    (f"line: {{start: {P}, to: {P}}}", "line.start: the key 'start' is not known; the keys here are from, to"),
    ("lines: 3", "lines: the key 'lines' is not known; the keys here are name, angles, line, arc, poses, timing"),
    (f"poses: [{P}, {{xyz: [0, 1]}}]", "poses[1].xyz: it has 2 entries; it must have 3"),
    (f"poses: [{P}, {{xyz: [0, 1, .nan]}}]", "poses[1].xyz[2]: nan is wrong; input should be a finite number"),
    (
        f"poses: [{P}, {{xyz: [0, 1, 2], rpy: 1}}]",
        "poses[1].rpy: the key 'rpy' is not known; the keys here are xyz, urdf_rpy, quaternion",
    ),
    (
        f"poses: [{P}, {{xyz: [0, 1, 2], quaternion: [0, 0, 0, 2]}}]",
        "poses[1]: the quaternion (x, y, z, w) has length 2; it must be 1",
    ),
    (
        f"poses: [{P}, {{xyz: [0, 1, 2], quaternion: [0, 0, 0, 1], urdf_rpy: [0, 0, 0]}}]",
        "poses[1]: it has both urdf_rpy and quaternion; give one",
    ),
    (f"poses: [{P}]", "a path needs 2 poses or more, got 1"),
    ("poses: 3", "poses: 3 is wrong; input should be a valid list"),
    ("poses: none.csv", "poses: 'none.csv' cannot be read (No such file or directory)"),
    ("poses: heads.csv", "the first line of 'heads.csv' must be x,y,z or x,y,z,qx,qy,qz,qw; it is x,y,w"),
    ("poses: word.csv", "poses: 'word.csv', line 3: it must hold 3 numbers, got 1,up,3"),
    ("poses: short.csv", "poses: 'short.csv', line 2: it must hold 3 numbers, got 1,2"),
    ("poses: nan.csv", "poses: 'nan.csv', line 2: it holds NaN or infinity"),
    ("poses: binary.csv", "'binary.csv' is not a CSV file"),
    ("poses: empty.csv", "the first line of 'empty.csv' must be x,y,z"),
    (f"arc: {{from: {P}, angle: 1}}", "an arc needs either via and end, or center, axis and angle"),
    (f"arc: {{from: {P}, center: [0, 0], axis: [0, 0, 1], angle: 1}}", "arc.center: it has 2 entries; it must have 3"),
    (f"angles: grad\nposes: [{P}]", "angles: 'grad' is not known; use 'deg' or 'rad'"),
    (f"poses: [{P}, {{xyz: [1, 0, 0]}}]\ntiming: {{duration: 0}}", "timing: duration is 0 s; it must be above 0"),
    (f"poses: [{P}, {{xyz: [1, 0, 0]}}]\ntiming: {{}}", "timing.duration: it is missing; it must be given"),
    (f"poses: [{P}, {{xyz: [1, 0, 0]}}]\ntiming: {{duration: true}}", "timing.duration: True is wrong; it must be a number"),
    (f"poses: [{P}, {{xyz: [1, 0, 0]}}]\ntiming: {{duration: 1, accelerate: 0.9}}", "they are fractions of time"),
]


@pytest.mark.parametrize(("text", "message"), REFUSED, ids=[m for _, m in REFUSED])
def test_a_bad_file_is_answered_with_one_sentence(text, message, write):
    for name, content in {
        "heads.csv": "x,y,w\n1,2,3\n",
        "word.csv": "x,y,z\n1,2,3\n1,up,3\n",
        "short.csv": "x,y,z\n1,2\n",
        "nan.csv": "x,y,z\n1,2,nan\n",
        "binary.csv": b"\xff\xfe\xfa",
        "empty.csv": "",
    }.items():
        write(content, name)
    with pytest.raises(InputError) as caught:
        TimedPath.load(write(text))
    assert str(caught.value).startswith("path file '")
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_file_that_cannot_be_read(tmp_path):
    with pytest.raises(InputError, match=r"none.yaml': the file cannot be read \(No such file or directory\)"):
        Path.load(tmp_path / "none.yaml")
