"""The reader of recordings on files that pyarrow, rosbags, mcap and plain text wrote: arrays, names, units, and bad input."""

from __future__ import annotations

import json
import os
import re

import numpy as np
import pyarrow
import pytest
from pyarrow import parquet

from holdfast.core.errors import InputError
from holdfast.response.diagnosis import read_recording
from holdfast.response.faults import Log

JOINTS = ["pan", "lift", "elbow"]


def pairs(rng, count=40, n=3):
    q = np.cumsum(rng.normal(size=(count, n)), axis=0)
    return q, q + rng.normal(size=(count, n))


def write_lerobot(folder, episodes, *, version="v3.0", fps=29.943, state_names=JOINTS, action_names=JOINTS, late=0.0):
    """Write a data set as LeRobot does, without its own package: one file an episode before 3.0, and one for all from then."""
    (folder / "meta").mkdir(parents=True)
    size, count = episodes[0][0].shape[1], episodes[0][1].shape[1]
    features = {
        "observation.state": {"dtype": "float32", "shape": [size], "names": state_names},
        "action": {"dtype": "float32", "shape": [count], "names": action_names},
        "observation.images.top": {"dtype": "video", "shape": [480, 640, 3], "names": ["height", "width", "channels"]},
        "timestamp": {"dtype": "float32", "shape": [1], "names": None},
    }
    info = {"codebase_version": version, "fps": fps, "robot_type": "so101_follower", "features": features}
    (folder / "meta" / "info.json").write_text(json.dumps(info))
    tables = []
    for number, (q, action) in enumerate(episodes):
        frames = np.arange(len(q))
        tables.append(
            pyarrow.table(
                {
                    "observation.state": pyarrow.array(list(q.astype(np.float32))),
                    "action": pyarrow.FixedSizeListArray.from_arrays(pyarrow.array(action.astype(np.float32).ravel()), count),
                    "timestamp": pyarrow.array((frames / fps + late * (frames > 5)).astype(np.float32)),
                    "frame_index": pyarrow.array(frames),
                    "episode_index": pyarrow.array(np.full(len(q), number)),
                }
            )
        )
    (folder / "data" / "chunk-000").mkdir(parents=True)
    if version == "v3.0":
        parquet.write_table(pyarrow.concat_tables(tables), folder / "data" / "chunk-000" / "file-000.parquet")
    else:
        for number, table in enumerate(tables):
            parquet.write_table(table, folder / "data" / "chunk-000" / f"episode_{number:06d}.parquet")
    return folder


@pytest.mark.parametrize("version", ["v2.0", "v2.1", "v3.0"])
@pytest.mark.parametrize(
    ("names", "expected"),
    [
        (JOINTS, JOINTS),
        ([f"{name}.pos" for name in JOINTS], JOINTS),
        ({"motors": JOINTS}, JOINTS),
        (["motors"], ["joint_1", "joint_2", "joint_3"]),
        (None, ["joint_1", "joint_2", "joint_3"]),
    ],
)
def test_lerobot(rng, tmp_path, version, names, expected):
    episodes = [pairs(rng, count) for count in (30, 1, 17)]
    folder = write_lerobot(tmp_path / "set", episodes, version=version, state_names=names, action_names=names)
    recording = read_recording(folder)
    assert (recording.format, recording.fps, recording.unit) == (f"LeRobot {version}", 29.943, None)
    assert list(recording.joints) == expected
    assert [episode.index for episode in recording.episodes] == [0, 1, 2]
    for episode, (q, action) in zip(recording.episodes, episodes, strict=True):
        np.testing.assert_allclose(episode.q, q, rtol=1e-6)
        np.testing.assert_allclose(episode.q_ref, action, rtol=1e-6)
        np.testing.assert_allclose(episode.t, np.arange(len(q)) / 29.943, atol=1e-6)
        assert episode.clock == "computed"
    assert [each.index for each in read_recording(folder, episodes=[2, 0]).episodes] == [0, 2]


def test_lerobot_vectors_with_other_entries(rng, tmp_path):
    q, _ = pairs(rng, n=6)
    state_names = ["a.pos", "a.vel", "a.torque", "gripper.pos", "gripper.vel", "gripper.torque"]
    hand_pose = ["left_ee.x", "left_ee.y"]
    folder = write_lerobot(
        tmp_path / "set", [(q, q[:, :2])], state_names=state_names, action_names=hand_pose, late=0.01, fps=30
    )
    recording = read_recording(folder)
    assert recording.joints == ("a",)
    episode = recording.episodes[0]
    np.testing.assert_allclose(episode.q, q[:, :1], rtol=1e-6)
    np.testing.assert_allclose(episode.tau, q[:, 2:3], rtol=1e-6)
    assert episode.q_ref is None
    assert episode.clock == "measured"
    assert any("left_ee.x" in note for note in recording.notes)
    assert any("'gripper' is left out" in note for note in recording.notes)
    both = read_recording(folder, joints=["gripper", "a"], unit="deg")
    np.testing.assert_allclose(both.episodes[0].q, q[:, [3, 0]], rtol=1e-6)
    assert both.unit == "deg"


def test_lerobot_actions_are_matched_by_name(rng, tmp_path):
    q, action = pairs(rng)
    folder = write_lerobot(tmp_path / "set", [(q, action)], action_names=[f"{name}.pos" for name in JOINTS[::-1]])
    np.testing.assert_allclose(read_recording(folder).episodes[0].q_ref, action[:, ::-1], rtol=1e-6)


def test_calibration_files_convert_to_degrees(rng, tmp_path):
    q, action = pairs(rng)
    folder = write_lerobot(tmp_path / "set", [(q, action)])
    ranges = {"pan": (1000, 3000), "lift": (500, 3500), "elbow": (800, 2900)}
    entries = {name: {"id": 1, "drive_mode": 0, "range_min": low, "range_max": high} for name, (low, high) in ranges.items()}
    (tmp_path / "robot.json").write_text(json.dumps(entries))
    recording = read_recording(folder, unit=tmp_path / "robot.json")
    for column, (low, high) in enumerate(ranges.values()):
        # LeRobot: a position p from -100 to 100 is at tick low + (p + 100) / 200 * (high - low) of 4096.
        ticks = low + (q[:, column] + 100) / 200 * (high - low)
        expected = (ticks - (low + high) / 2) * 360 / 4095
        np.testing.assert_allclose(recording.episodes[0].q[:, column], expected, rtol=1e-5, atol=1e-6)


# ---- ROS 2 -------------------------------------------------------------------------------------------------------


def joint_state(store, t, names, q):
    types = store.types
    header = types["std_msgs/msg/Header"](types["builtin_interfaces/msg/Time"](int(t), round(t % 1 * 1e9)), "")
    empty = np.array([])
    return types["sensor_msgs/msg/JointState"](header, list(names), np.asarray(q, float), empty, empty)


@pytest.mark.parametrize("storage", ["SQLITE3", "MCAP"])
def test_bags(rng, tmp_path, storage):
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_HUMBLE)
    q, command = pairs(rng, 60)
    times = 1.7e9 + np.arange(60) / 20 + 3.0 * (np.arange(60) >= 35)  # a pause separates two runs
    order = [2, 0, 1]  # messages name their joints in another order now and then
    with Writer(tmp_path / "bag", version=9, storage_plugin=StoragePlugin[storage]) as writer:
        state = writer.add_connection("/joint_states", "sensor_msgs/msg/JointState", typestore=store)
        goal = writer.add_connection("/position/commands", "std_msgs/msg/Float64MultiArray", typestore=store)
        leader = writer.add_connection("/leader", "sensor_msgs/msg/JointState", typestore=store)
        hand = writer.add_connection("/hand", "sensor_msgs/msg/JointState", typestore=store)
        for k, t in enumerate(times):
            names, values = (JOINTS, q[k]) if k % 7 != 3 else ([JOINTS[j] for j in order], q[k, order])
            message = joint_state(store, t, names, values)
            writer.write(state, int((t + 0.003) * 1e9), store.serialize_cdr(message, state.msgtype))
            fingers = joint_state(store, t, ["finger"], [0.1])
            writer.write(hand, int(t * 1e9), store.serialize_cdr(fingers, hand.msgtype))
            wish = joint_state(store, t, [JOINTS[j] for j in order], command[k, order] + 1)
            writer.write(leader, int((t - 0.001) * 1e9), store.serialize_cdr(wish, leader.msgtype))
            layout = store.types["std_msgs/msg/MultiArrayLayout"]([], 0)
            array = store.types["std_msgs/msg/Float64MultiArray"](layout, command[k])
            writer.write(goal, int((t - 0.002) * 1e9), store.serialize_cdr(array, goal.msgtype))
    paths = [tmp_path / "bag", *(tmp_path / "bag").glob("*.mcap"), *(tmp_path / "bag").glob("*.db3")]
    for path in paths:
        recording = read_recording(path)
        assert (recording.joints, recording.unit) == (tuple(JOINTS), "rad")
        assert recording.fps == pytest.approx(20, rel=1e-3)
        assert [len(episode.t) for episode in recording.episodes] == [35, 25]
        np.testing.assert_array_equal(np.concatenate([episode.q for episode in recording.episodes]), q)
        np.testing.assert_array_equal(np.concatenate([episode.q_ref for episode in recording.episodes]), command)
        np.testing.assert_allclose(recording.episodes[1].t, np.arange(25) / 20, atol=1e-6)
        by_leader = read_recording(path, reference="/leader")
        np.testing.assert_array_equal(np.concatenate([episode.q_ref for episode in by_leader.episodes]), command + 1)
    assert len(paths) == 2
    assert read_recording(tmp_path / "bag", state="/hand").joints == ("finger",)
    with pytest.raises(InputError, match=r"has no joint states; its topics are .*/joint_states"):
        read_recording(tmp_path / "bag", state="/nothing")
    with pytest.raises(InputError, match="has no joint commands in '/hands'"):
        read_recording(tmp_path / "bag", reference="/hands")
    damaged = tmp_path / "damaged.mcap"
    damaged.write_bytes(b"\x89MCAP0\r\n" + b"x" * 40)
    with pytest.raises(InputError, match="cannot be read as a ROS 2 bag or MCAP file"):
        read_recording(damaged)


CONTROLLER_STATE = """std_msgs/Header header
string[] joint_names
trajectory_msgs/JointTrajectoryPoint reference
trajectory_msgs/JointTrajectoryPoint feedback
================================================================================
MSG: trajectory_msgs/JointTrajectoryPoint
float64[] positions
float64[] velocities
float64[] accelerations
float64[] effort
builtin_interfaces/Duration time_from_start
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Duration
int32 sec
uint32 nanosec
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""


@pytest.mark.parametrize("fields", [("reference", "feedback"), ("desired", "actual")])
def test_mcap_of_another_writer(rng, tmp_path, fields):
    """A controller's states, encoded by mcap-ros2-support, which shares no code with rosbags."""
    from mcap_ros2.writer import Writer

    q, wanted = pairs(rng, 25)
    text = CONTROLLER_STATE.replace(" reference\n", f" {fields[0]}\n").replace(" feedback\n", f" {fields[1]}\n")

    def point(values):
        return {"positions": list(values), "effort": list(2 * values), "time_from_start": {"sec": 0, "nanosec": 0}}

    with (tmp_path / "one.mcap").open("wb") as stream:
        writer = Writer(stream)
        schema = writer.register_msgdef("control_msgs/msg/JointTrajectoryControllerState", text)
        for k in range(25):
            message = {
                "header": {"stamp": {"sec": 100, "nanosec": 40_000_000 * k}, "frame_id": ""},
                "joint_names": JOINTS,
                fields[0]: point(wanted[k]),
                fields[1]: point(q[k]),
            }
            time = 10**11 + k * 40_000_000
            writer.write_message("/arm/state", schema, message, log_time=time, publish_time=time, sequence=k)
        writer.finish()
    recording = read_recording(tmp_path / "one.mcap")
    episode = recording.episodes[0]
    np.testing.assert_array_equal(episode.q, q)
    np.testing.assert_array_equal(episode.q_ref, wanted)
    np.testing.assert_array_equal(episode.tau, 2 * q)
    assert recording.fps == pytest.approx(25)


# ---- text --------------------------------------------------------------------------------------------------------


def numbered(name, n=3, form="{}[{}]"):
    return [form.format(name, k) for k in range(n)]


def write_text(path, header, rows, mark=","):
    lines = [mark.join(header), *(mark.join("" if cell is None else repr(float(cell)) for cell in row) for row in rows)]
    path.write_text("\n".join(lines) + "\n")
    return path


@pytest.mark.parametrize("kind", ["libfranka 0.15", "libfranka 0.8", "libfranka 0.5", "RTDE", "RTDE with blanks"])
def test_known_logs(rng, tmp_path, kind):
    q, wanted = pairs(rng, 25)
    tau, t = rng.normal(size=(25, 3)), np.arange(25) / 50
    ones, mark = np.ones((25, 1)), ","
    if kind == "libfranka 0.5":  # q_d twice: in the state, and as a command
        header = ["duration", " success rate", *numbered(" q"), *numbered(" q_d"), *numbered("tau_J"), "sent commands"]
        header += numbered("q_d")
        rows = [[*row[:11], None, *row[11:]] for row in np.hstack([t[:, None] * 1000, ones, q, wanted, tau, 99 + q])]
    elif kind.startswith("libfranka"):
        blank = " " if kind.endswith("8") else ""  # before 0.9, blanks preceded the names
        header = ["time", f"{blank}success_rate", *numbered(f"{blank}state.q"), *numbered("state.q_d")]
        header += [*numbered("state.tau_J"), *numbered("cmd.q_d")]
        rows = np.hstack([t[:, None] * 1000, ones, q, wanted, tau, 99 + q])
    else:
        header = [
            "timestamp",
            *(name for key in ("target_q", "actual_q", "target_moment") for name in numbered(key, 3, "{}_{}")),
        ]
        rows, mark = np.hstack([t[:, None], wanted, q, tau]), " " if "blanks" in kind else ","
    path = write_text(tmp_path / "robot.csv", header, rows, mark)
    recording = read_recording(path)
    episode = recording.episodes[0]
    np.testing.assert_array_equal(episode.q, q)
    np.testing.assert_array_equal(episode.q_ref, wanted)
    np.testing.assert_array_equal(episode.tau, tau)
    np.testing.assert_allclose(episode.t, t, rtol=1e-12)
    assert (recording.unit, recording.fps) == ("rad", pytest.approx(50))
    np.testing.assert_array_equal(Log.load(path).q, q)  # diagnose and calibrate read the same files


def test_folders_of_logs_and_column_files(rng, tmp_path):
    logs = [Log(t=np.arange(25) / 50, q=q, q_ref=r) for q, r in (pairs(rng, 25) for _ in range(3))]
    folder = tmp_path / "logs"
    folder.mkdir()
    for number, log in enumerate(logs):
        log.save(folder / f"{number}.csv")
    recording = read_recording(folder)
    assert [episode.index for episode in recording.episodes] == [0, 1, 2]
    for episode, log in zip(recording.episodes, logs, strict=True):
        np.testing.assert_allclose(episode.q, log.q, atol=1e-8)
    (tmp_path / "columns.yaml").write_text(
        "t: {column: clock, unit: ms}\nq: {column: 'a*', unit: deg}\nq_ref: {column: 'r*', unit: deg}\n"
    )
    rows = np.hstack([logs[0].t[:, None] * 1000, logs[0].q, logs[0].q_ref])
    path = write_text(tmp_path / "own.csv", ["clock", "a1", "a2", "a3", "r1", "r2", "r3"], rows)
    np.testing.assert_allclose(read_recording(path, columns=tmp_path / "columns.yaml").episodes[0].q, np.radians(logs[0].q))
    (folder / "9.csv").write_text("t,q_1,q_ref_1\n0,1,1\n0.02,1,1\n")
    with pytest.raises(InputError, match=r"9\.csv' has 1 joints at 50 Hz and .* has 3"):
        read_recording(folder)


def damage(folder, name):
    info = json.loads((folder / "meta" / "info.json").read_text())
    if name == "version":
        info["codebase_version"] = "v1.6"
    if name == "state":
        info["features"]["robot_state"] = info["features"].pop("observation.state")
    if name == "features":
        del info["features"]
    (folder / "meta" / "info.json").write_text(json.dumps(info))
    file = next(folder.glob("data/*/*.parquet"))
    if name == "file":
        file.write_bytes(file.read_bytes()[:200])
    if name == "data":
        file.unlink()
    if name == "rows":
        table = parquet.read_table(file)
        vectors = [*table["action"].to_pylist()[:-1], [1.0]]
        parquet.write_table(table.drop_columns(["action"]).append_column("action", pyarrow.array(vectors)), file)


@pytest.mark.parametrize(
    ("damaged", "message"),
    [
        ("version", r"has LeRobot's format v1\.6; 2\.0, 2\.1 and 3\.0 are read: convert it with LeRobot"),
        ("state", "has no 'observation.state'; its vectors of numbers are .*robot_state.*: name one by --state"),
        ("features", "is not the description of a LeRobot data set"),
        ("file", r"file-000\.parquet' cannot be read"),
        ("data", r"has no data/\*/\*\.parquet; download the data set first"),
        ("rows", "cannot be read .*inhomogeneous"),
    ],
)
def test_damaged_data_sets(rng, tmp_path, damaged, message):
    folder = write_lerobot(tmp_path / "set", [pairs(rng)])
    damage(folder, damaged)
    with pytest.raises(InputError, match=message):
        read_recording(folder)


def test_other_bad_input(rng, tmp_path):
    folder = write_lerobot(tmp_path / "set", [pairs(rng)])
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "notes.md").touch()
    (tmp_path / "broken.csv").write_text("t,q_1,q_ref_1\n0,1,1\n0.1,1\n")
    (tmp_path / "named.csv").write_text("when,angle\n0,1\n")
    (tmp_path / "short.json").write_text('{"pan": {"range_min": 1}}')
    (tmp_path / "empty.npz").write_bytes(b"")
    (tmp_path / "one.csv").write_text("t,q_1,q_ref_1\n0,1,1\n")
    for arguments, message in (
        (("one.csv",), "has no two frames between which the time increases"),
        (("nowhere",), "'.*nowhere' does not exist"),
        (
            ("other",),
            r"is a folder without meta.info\.json .LeRobot. or metadata\.yaml .ROS 2 bag.; it contains 'notes\.md",
        ),
        (("broken.csv",), "line 3 has 2 cells, and the first line 3"),
        (("named.csv",), "has no column .* for t, but 'when', 'angle'; name them in a file of columns"),
        (("empty.npz",), "it is not an .npz file of numbers"),
        (("set", {"joints": ["pan", "knee"]}), "has no joint 'knee'; its joints are 'pan', 'lift'"),
        (("set", {"episodes": [5]}), "has no rows of the requested episodes"),
        (("set", {"unit": "grad"}), "calibration 'grad' cannot be read"),
        (("set", {"unit": str(tmp_path / "short.json")}), "has no range_min and range_max of every joint"),
    ):
        name, *options = arguments
        with pytest.raises(InputError, match=message) as error:
            read_recording(tmp_path / name, **(options[0] if options else {}))
        assert "\n" not in str(error.value)
    log = Log(t=np.arange(3) / 50, q=np.zeros((3, 1)), q_ref=np.zeros((3, 1))).save(tmp_path / "log.npz")
    with pytest.raises(InputError, match=re.escape("is in rad, and unit is 'deg'; leave it out")):
        read_recording(log, unit="deg")
    assert os.fspath(folder)
