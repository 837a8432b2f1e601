"""``holdfast diagnose`` on a data set: exit codes, JSON, text, and the page."""

from __future__ import annotations

import json

import numpy as np
import pyarrow
import pytest
from pyarrow import parquet


@pytest.fixture
def data_set(tmp_path):
    """Twenty-six episodes of two joints, deg; the position of joint "lift" is shifted from second 4 on in the last two."""
    rng = np.random.default_rng(0)  # one of twelve healthy episodes would alarm with other numbers
    count, fps = 180, 30
    tables = []
    for number in range(26):
        t = np.arange(count) / fps
        action = 20 * np.sin(t[:, None] * [1.0, 1.7] + rng.uniform(0, 6, 2))
        q = np.vstack([action[:1], action[:-1]]) + rng.normal(0, 0.2, (count, 2))
        q[120:, 1] += 12 * (number >= 24)
        action[:, 0] = 3.0 if number == 23 else action[:, 0]
        q[:, 0] = 3.0 + rng.normal(0, 0.2, count) if number == 23 else q[:, 0]
        columns = {"observation.state": list(q.astype(np.float32)), "action": list(action.astype(np.float32))}
        columns |= {"timestamp": t.astype(np.float32), "frame_index": np.arange(count), "episode_index": np.full(count, number)}
        tables.append(pyarrow.table({name: pyarrow.array(values) for name, values in columns.items()}))
    vector = {"dtype": "float32", "shape": [2], "names": ["pan.pos", "lift.pos"]}
    info = {"codebase_version": "v3.0", "fps": fps, "robot_type": "so101_follower"}
    info["features"] = {"observation.state": vector, "action": vector}
    folder = tmp_path / "set"
    (folder / "data" / "chunk-000").mkdir(parents=True)
    (folder / "meta").mkdir()
    (folder / "meta" / "info.json").write_text(json.dumps(info))
    parquet.write_table(pyarrow.concat_tables(tables), folder / "data" / "chunk-000" / "file-000.parquet")
    return folder


def test_exit_codes_text_and_page(cli, data_set, tmp_path):
    code, out, error = cli("diagnose", data_set, "--healthy", "0:22", "--unit", "deg", "--out", tmp_path / "page")
    assert code == 3, error
    assert "so101_follower, LeRobot v3.0, 26 episodes, 2 joints, 30 frames per second (times computed" in out
    assert "11 healthy episodes fit the model, and 11 others set the threshold" in out
    assert "1 of 12 healthy episodes alarms on average" in out
    page = (tmp_path / "page" / "report.html").read_text(encoding="utf-8")
    for text in ("largest error held", "prediction of the healthy joint", "fit and threshold are healthy"):
        assert text in page
    code, out, _ = cli("diagnose", data_set, "--healthy", "0:22", "--unit", "deg", "--json")
    assert code == 3
    answer = json.loads(out)
    assert [answer["episodes"][k]["joint"] for k in (24, 25)] == ["lift", "lift"]
    assert answer["episodes"][24]["alarm"] == pytest.approx(4.0, abs=0.1)
    assert "pan" in answer["episodes"][23]["unheard"]
    assert answer["false_alarms"]["per_episode"] == pytest.approx(1 / 12)
    code, out, _ = cli("diagnose", data_set, "--healthy", "0:10")
    assert code == 0
    assert "Inconclusive: There are 10 healthy episodes; 20 are needed to state a rate" in out
    assert "No test for faults was possible in 16 episodes" in out
    code, out, _ = cli("diagnose", data_set, "--healthy", "0:24", "--joints", "pan", "--rate", 0.001)
    assert code == 0, out
    assert "extrapolated to 0.001 false alarms per hour and not guaranteed" in out


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--healthy", "first"), "--healthy is 'first'; give episodes such as 0:50"),
        (("--healthy", "0:22,99"), "healthy episode 99 is not in the recording; it has episodes 0 to 25"),
        (("--joints", "elbow"), "has no joint 'elbow'; its joints are 'pan', 'lift'"),
        (("--unit", "turns"), "calibration 'turns' cannot be read"),
        (
            ("--state", "observation.qpos"),
            "has no 'observation.qpos'; its vectors of numbers are 'observation.state'",
        ),
        (("--healthy", "0:22", "--arm", "panda"), "the recording 2"),
        (("--bounds", "b.json", "--healthy", "0:22"), "--bounds needs --arm and excludes --healthy"),
    ],
)
def test_bad_input(cli, data_set, options, message):
    code, _, error = cli("diagnose", data_set, *options)
    assert code == 2
    assert message in " ".join(error.split())
    assert "Traceback" not in error
