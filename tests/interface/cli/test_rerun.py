"""Recordings for the Rerun viewer, read back with the Rerun SDK and compared with Pinocchio."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
import pytest
from scipy.spatial.transform import Rotation

import holdfast as hf
from holdfast import InputError
from holdfast.model.arms.builtin import DATA_FOLDER

pytest.importorskip("rerun", reason="needs rerun-sdk")

PANDA_AT = [0, 0.5, 0, -1.5, 0, 2, 0.8]


def read_columns(path):
    """Columns of each entity by their names, as lists of rows; static chunks have no timeline."""
    from rerun.chunk import RrdReader

    entities = {}
    for chunk in RrdReader(str(path)).stream():
        batch = chunk.to_record_batch()
        columns = entities.setdefault(chunk.entity_path, {})
        for name, values in zip(batch.schema.names, batch.columns, strict=True):
            rows = values.cast("int64").to_pylist() if "duration" in str(values.type) else values.to_pylist()
            columns.setdefault(name, []).extend(rows)
    return entities


def flatten(rows):
    return np.array([row[0] for row in rows])


def test_a_timed_recovery_contains_poses_joints_and_the_lock(tmp_path):
    arm = hf.arms.load("panda")
    goal = arm.forward_kinematics(np.array([0.0, -0.3, 0.3, -1.5, 0.0, 1.6, 0.8]))
    recovery = hf.recover(arm, {"panda_joint4": -1.5}, PANDA_AT, goal=goal, samples=0, accelerations=2.0)
    assert recovery.timed is not None
    entities = read_columns(recovery.to_rrd(tmp_path / "motion.rrd"))
    timed = recovery.timed
    for joint, name in enumerate(arm.joint_names):
        columns = entities[f"/joints/{name}"]
        np.testing.assert_array_equal(flatten(columns["Scalars:scalars"]), timed.q[:, joint])
        np.testing.assert_allclose(np.array(columns["time"]) / 1e9, timed.time, atol=1e-9)
    assert entities["/events"]["TextLog:text"] == [["panda_joint4 locked"]]
    model = pin.buildModelFromUrdf(str(DATA_FOLDER / "panda.urdf"))
    data, tip = model.createData(), model.getFrameId("panda_hand_tcp")
    translations = flatten(entities["/arm/tool"]["Transform3D:translation"])
    quaternions = flatten(entities["/arm/tool"]["Transform3D:quaternion"])
    for sample in (0, len(timed.q) // 2, -1):
        q = pin.neutral(model)
        q[[model.joints[model.getJointId(name)].idx_q for name in arm.joint_names]] = timed.q[sample]
        pin.framesForwardKinematics(model, data, q)
        np.testing.assert_allclose(translations[sample], data.oMf[tip].translation, atol=1e-6)
        np.testing.assert_allclose(Rotation.from_quat(quaternions[sample]).as_matrix(), data.oMf[tip].rotation, atol=1e-6)
    shapes = [path for path in entities if "/shape" in path]
    assert any(path.startswith("/arm/panda_joint4/shape") for path in shapes)
    for path in shapes:
        corners = np.array(entities[path]["Mesh3D:vertex_positions"][0])
        normals = np.array(entities[path]["Mesh3D:vertex_normals"][0])
        assert len(corners) == len(normals)
        assert np.isfinite(corners).all()


def test_a_lock_during_a_run_is_at_its_time(tmp_path):
    law = hf.control.pseudoinverse(hf.arms.load("planar-3r"), "planar")
    cell = hf.Cell([hf.cell.Sphere("ball", 0.1, pose=[0.0, -2.0, 0.0])])
    runs = hf.simulate(law, [0.3, 0.5, 0.4], [1.5, 1.5], locked=["joint2"], time=0.5, cell=cell)
    entities = read_columns(runs.to_rrd(tmp_path / "run.rrd"))
    time = np.array(entities["/joints/joint2"]["time"]) / 1e9
    lock_time = entities["/events"]["time"][0] / 1e9
    assert lock_time == pytest.approx(0.5, abs=np.diff(time).max())
    joint2 = flatten(entities["/joints/joint2"]["Scalars:scalars"])
    assert np.ptp(joint2[time >= lock_time]) < 1e-9
    assert np.ptp(joint2[time < 0.5]) > 1e-3
    # The ball is fixed to the base: its corners are around its centre.
    balls = [
        np.array(columns["Mesh3D:vertex_positions"][0])
        for path, columns in entities.items()
        if path.startswith("/arm/base/shape")
    ]
    assert any(np.abs(np.linalg.norm(corners - [0, -2, 0], axis=1) - 0.1).max() < 0.01 for corners in balls)


def test_the_response_to_a_fault_contains_the_first_lock(tmp_path):
    law = hf.control.pseudoinverse(hf.arms.load("planar-3r"), "planar")
    fault = hf.faults.FaultEvent("locked", "joint2", 0.4)
    run = hf.simulate_faults(law, [0.3, 0.5, 0.4], [1.5, 1.5], faults=[fault], react="known", plan=False, time_limit=1.0)
    entities = read_columns(run.to_rrd(tmp_path / "fault.rrd"))
    assert entities["/events"]["TextLog:text"] == [["joint2 locked"]]
    assert entities["/events"]["time"][0] / 1e9 == pytest.approx(0.4, abs=1e-9)
    np.testing.assert_array_equal(flatten(entities["/joints/joint3"]["Scalars:scalars"]), run.q[:, 2])


def test_an_execution_and_a_followed_path_are_recorded(tmp_path):
    arm, q = hf.arms.load("planar-3r"), np.array([0.3, 0.5, 0.4])
    played = hf.execute(arm, [q, q + 0.2], [0.0, 1.0], locked=["joint1"], lock_time=0.5)
    entities = read_columns(played.to_rrd(tmp_path / "played.rrd"))
    assert entities["/events"]["time"][0] / 1e9 == pytest.approx(0.5)
    assert len(entities["/joints/joint2"]["time"]) == len(played.time)
    start = arm.forward_kinematics(q)[:3, 3]
    path = hf.paths.TimedPath(hf.paths.line(start, start + np.array([0.05, 0, 0])), hf.paths.Constant(1.0))
    index = hf.indices.relative_manipulability(arm, "planar")
    followed = hf.follow(arm, path, maximise=index, q=q, samples=5, task="planar")
    entities = read_columns(followed.to_rrd(tmp_path / "followed.rrd"))
    tool = np.exp(1j * np.cumsum(followed.q, axis=1)).sum(axis=1)
    translations = flatten(entities["/arm/tool"]["Transform3D:translation"])
    np.testing.assert_allclose(translations[:, 0] + 1j * translations[:, 1], tool, atol=1e-6)
    assert "/events" not in entities


def test_a_recovery_without_timing_numbers_its_samples(tmp_path):
    arm = hf.arms.load("planar-3r")
    recovery = hf.recover(arm, ["joint2"], [0.2, 0.4, 0.3], goal=[1.0, 0.4, -0.5], samples=0)
    columns = read_columns(recovery.to_rrd(tmp_path / "way.rrd"))["/joints/joint1"]
    assert "time" not in columns
    assert columns["sample"] == list(range(len(columns["sample"])))
    assert flatten(columns["Scalars:scalars"])[[0, -1]] == pytest.approx([0.2, 1.0])


def test_a_result_without_a_motion_is_refused(tmp_path):
    arm = hf.arms.load("planar-3r")
    with pytest.raises(InputError, match="contains no motion"):
        hf.tolerant_workspace(arm, "planar").to_rrd(tmp_path / "none.rrd")
    assert not list(tmp_path.iterdir())


def test_the_command_writes_the_recording(cli, tmp_path):
    file = tmp_path / "run.rrd"
    code, out, _ = cli(
        "simulate", "planar-3r", "--start", "0.3 0.5 0.4", "--target", "1.5,1.5", "--lock", "2@0.5", "--rrd", file
    )
    assert code == 0
    assert f"written: {file}" in out.replace("\n", "")
    assert "/joints/joint2" in read_columns(file)
