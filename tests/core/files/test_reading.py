"""Files that people name: what is no regular file, or larger than any sound one, is refused at once by all that reads."""

from __future__ import annotations

import os
import socket

import numpy as np
import pytest

import holdfast as hf
from holdfast import arms
from holdfast.core.files import reading
from holdfast.core.sweeps import Store, Study
from holdfast.interface.cli.values import read_weights
from holdfast.kinematics.paths import path_file
from holdfast.kinematics.paths.joint_table import read_joint_table
from holdfast.kinematics.regions.pose_list import PoseList
from holdfast.model.collision import Capsules
from holdfast.studies.study_files import study_file
from holdfast.teleop.protocol import protocol
from holdfast.teleop.serve import texts

FLAT = arms.load("planar-2r")


def _study(path):
    path.parent.joinpath("study").mkdir()
    path.rename(path.parent / "study" / "study.json")
    return Study.open(path.parent / "study")


def _run(path):
    path.parent.joinpath("run").mkdir()
    path.rename(path.parent / "run" / "run.json")
    return Store.open(path.parent / "run")


READERS = {
    "dh.yaml": lambda path: arms.load(str(path)),
    "arm.urdf": lambda path: arms.load(str(path)),
    "arm.xml": lambda path: arms.load(str(path)),
    "arm.mjcf": lambda path: arms.load(str(path)),
    "region.yaml": hf.Region.load,
    "path.yaml": path_file.parse_path_file,
    "points.csv": path_file.read_pose_table,
    "capsules.yaml": lambda path: Capsules.load(path, FLAT),
    "poses.csv": PoseList.read_csv,
    "joints.csv": lambda path: read_joint_table(FLAT, path, "waypoints", "step"),
    "weights.csv": lambda path: read_weights("--weights", str(path)),
    "study.yaml": study_file.read_study_file,
    "protocol.yaml": protocol.read_protocol,
    "texts.yaml": texts.load_texts,
    "study.json": _study,
    "run.json": _run,
}


@pytest.mark.parametrize("name", READERS)
def test_a_device_a_pipe_and_a_folder_are_refused(name, tmp_path):
    def pipe(path):
        os.mkfifo(path)

    def device(path):
        path.symlink_to("/dev/zero")

    made = (pipe, device) if name in ("study.json", "run.json") else (pipe, device, os.mkdir)
    for k, make in enumerate(made):
        path = tmp_path / str(k) / name
        path.parent.mkdir()
        make(path)
        with pytest.raises(hf.HoldfastError) as caught:
            READERS[name](path)
        assert "it is a folder" in str(caught.value) or "not a regular file" in str(caught.value)


@pytest.mark.parametrize("name", READERS)
def test_a_huge_file_is_refused(name, tmp_path):
    path = tmp_path / name
    with path.open("wb") as file:
        file.truncate(1 << 40)  # of nothing: it takes no room
    with pytest.raises(hf.HoldfastError, match=r"it is larger than \d+ MiB"):
        READERS[name](path)


def test_regular_files(tmp_path):
    path = tmp_path / "a.txt"
    path.write_bytes(b"\xef\xbb\xbfone\r\ntwo\rthree\n")
    assert reading.read_text(path) == "one\ntwo\nthree\n"
    assert reading.read_bytes(path, 18) == path.read_bytes()
    with pytest.raises(OSError, match="larger than"):
        reading.read_bytes(path, 17)
    assert "cpu" in reading.read_text("/proc/stat")  # its size is 0
    (tmp_path / "b").write_bytes(b"\xff")
    with pytest.raises(UnicodeDecodeError):
        reading.read_text(tmp_path / "b")


def test_names_that_no_file_has(tmp_path):
    with pytest.raises(OSError, match="null character"):
        reading.read_bytes("a\0b")
    for spec in ("x" * 5000, "x" * 5000 + ".yaml", "x" * 5000 + ".xml", "a\0b", "a\0.yaml"):
        with pytest.raises(hf.ArmError):
            arms.load(spec)
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(str(tmp_path / "s"))
        with pytest.raises(OSError, match="not a regular file"):
            reading.read_bytes(tmp_path / "s")


def test_a_long_message_keeps_its_ends():
    text = "the beginning " + "x" * 100_000 + " the end"
    shown = str(hf.InputError(text))
    assert shown.startswith("the beginning xxx")
    assert shown.endswith("xxx the end")
    assert len(shown) < 1100
    assert str(hf.InputError("short é")) == "short é"
    assert str(hf.InputError("a\nb \x1b[2J\u202e")) == "a\\nb \\x1b[2J\\u202e"


def test_numbers_that_overflow_are_no_arm():
    with pytest.raises(hf.ArmError, match="kg"):
        hf.Link(1e300, np.zeros(3), np.eye(3))
    with pytest.raises(hf.ArmError, match="metres"):
        FLAT.with_tool(np.array([[1, 0, 0, 1e300], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]]))
