"""Files that are sent to the page: what is opened, what is refused, and that no path of theirs is ever followed."""

from __future__ import annotations

import sys
from base64 import b64encode
from pathlib import Path

import numpy as np
import pytest
from studio_requests import Page

import holdfast as hf
from holdfast.interface.studio import State, serve, server, upload
from holdfast.model.arms import dh_file
from holdfast.model.arms.dh_rows import dh_table

CRANE = Path(__file__).parent / "arms" / "inspection-crane.urdf"


@pytest.fixture(scope="module")
def page():
    with serve(hf.arms.load("planar-3r"), port=0) as studio:
        yield Page(studio.url)


def sent(name, content):
    return {"name": name, "content": b64encode(content).decode()}


def test_an_arm_is_read_as_from_its_file():
    with upload.open_uploaded_arm("C:\\arms\\crane.urdf", CRANE.read_bytes()) as (machine, state):
        same = hf.Arm.from_urdf(CRANE)
        q = np.array(state.q)
        np.testing.assert_array_equal(machine.tool_pose(q), same.frames(q)[-1])
        assert state.arm == "crane.urdf"
        assert state.names == same.joint_names
    table = dh_file.format_dh_file(dh_table(hf.arms.load("pa10-7dof")), "mine")
    with upload.open_uploaded_arm("mine.yaml", table.encode()) as (machine, state):
        assert (machine.arm.name, machine.arm.n, state.task) == ("mine", 7, "pose")


def test_an_arm_that_is_sent_gets_its_own_page(page):
    address = page.ask("open", file=sent("../crane.urdf", CRANE.read_bytes()))["address"]
    assert address == "/arm/1/"
    other = Page(f"http://{page.host}{address}")
    same = hf.Arm.from_urdf(CRANE)
    assert other.data["name"] == same.name
    assert tuple(other.state["names"]) == same.joint_names
    assert "camera.stl" in other.html  # named as missing
    assert "holdfast-studio" not in other.html
    reading = other.ask("reading")
    model = hf.susceptibility.by_name("torque", same)
    assert reading["susceptibility"]["values"] == abs(model.by_joint(other.state["q"])).tolist()
    assert reading["command"].startswith("holdfast studio crane.urdf")
    assert len(other.ask("best-worst")["q"][0]) == same.n
    assert page.ask("reading")["command"].startswith("holdfast studio planar-3r")  # the first page keeps its arm
    assert "another arm" in page.post("reading", {"state": other.state})[1][0]["error"]


def test_only_the_last_arms_are_kept(page, monkeypatch):
    monkeypatch.setattr(server, "MAX_UPLOADED_ARMS", 2)
    table = sent("a.yaml", b"rows:\n- {a: 1, alpha: 0}\n- {a: 1, alpha: 0}\n- {a: 0.5, alpha: 0}\n")
    addresses = [page.ask("open", file=table)["address"] for _ in range(3)]
    assert len(set(addresses)) == 3
    assert [page.request("GET", address)[0] for address in addresses] == [404, 200, 200]
    assert page.request("GET", "/")[0] == 200


def test_a_motion_that_is_sent_is_played(page, tmp_path):
    assert page.ask("open") == "There is no motion; open a CSV file, or start the studio with --file"
    text = "time_s,joint1_rad,joint2_rad,joint3_rad\n0,0.1,0.2,0.3\n1.5,0.2,0.3,0.4\n"
    motion = page.ask("open", file=sent("a\\run.csv", text.encode()))["motion"]
    assert motion == {"label": "run.csv: 2 rows", "unit": "s", "time": [0, 1.5], "q": [[0.1, 0.2, 0.3], [0.2, 0.3, 0.4]]}
    assert "run backwards" in page.ask("open", file=sent("run.csv", text.replace("1.5", "-1").encode()))
    (tmp_path / "own.csv").write_text(text)
    arm = hf.arms.load("planar-3r")
    state = State("planar-3r", arm.joint_names, (0.1, 0.2, 0.3), task="planar", file=str(tmp_path / "own.csv"))
    with serve(arm, state, port=0) as studio:
        own = Page(studio.url)
        assert own.ask("open")["motion"]["q"] == motion["q"]


@pytest.mark.parametrize(
    ("file", "sentence"),
    [
        ({"name": "a.urdf", "content": "%%%"}, "not base64"),
        ({"name": "a.xacro", "content": ""}, "expanded first"),
        (sent("a.urdf", b"<robot/>"), "nothing has changed"),
        (sent("a.urdf", b" " * (upload.MAX_FILE_BYTES + 1)), "too large; at most 4 MiB"),
        (sent("a.csv", b"\xff\xfe"), "a.csv"),
        ({"name": "a.urdf"}, "file.content cannot be read"),
    ],
)
def test_files_that_cannot_be_opened_change_nothing(page, file, sentence):
    found = page.ask("open", file=file)
    assert sentence.lower() in found.lower()
    assert "holdfast-studio" not in found


def test_no_path_of_a_file_is_followed(page, tmp_path):
    secret = tmp_path / "secret.stl"
    secret.write_text("solid x\nendsolid x\n")
    text = f"""<robot name="r"><link name="a"/><joint name="j" type="continuous">
        <parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
        </joint><link name="b"><visual><geometry><mesh filename="file://{secret}"/></geometry></visual>
        <visual><geometry><mesh filename="{secret}"/></geometry></visual></link></robot>"""
    opened, watching = [], True
    sys.addaudithook(lambda event, given: opened.append(str(given[0])) if event == "open" and watching else None)
    try:
        found = page.ask("open", file=sent("../../x.urdf", text.encode()))
    finally:
        watching = False
    assert str(secret) in Page(f"http://{page.host}{found['address']}").html  # named as not found
    assert any("holdfast-studio" in name for name in opened)
    assert not any(name.startswith(str(tmp_path)) for name in opened)
    assert all(".." not in name for name in opened if "holdfast-studio" in name)


@pytest.mark.parametrize(
    ("name", "content", "sentence"),
    [
        ("a.urdf", b"", "not valid XML"),
        ("a.urdf", b"<html/>", "outermost element is <html>"),
        ("a.xml", b"<mujoco/>", "outermost element is <mujoco>"),
        ("a.urdf", b"<!DOCTYPE x><robot/>", "DOCTYPE"),
        ("a.urdf", b"<robot name='x'><link name='a'/></robot>", "no moving joint"),
        ("a.yaml", b"rows: []", "rows"),
        ("a.yaml", b"\xff\xfe\x00", "a.yaml"),
        ("a.urdf", b" " * (upload.MAX_FILE_BYTES + 1), "too large; at most 4 MiB"),
        ("a.yaml", b"rows:\n" + b"- {a: 1, alpha: 0}\n" * 41, "has 41 joints"),
    ],
)
def test_bad_files_are_refused_in_one_sentence_that_names_them(name, content, sentence):
    with pytest.raises(hf.HoldfastError) as found, upload.open_uploaded_arm(name, content):
        pass
    assert sentence in str(found.value)
    assert name in str(found.value)
    assert "holdfast-studio-" not in str(found.value)
    assert "\n" not in str(found.value)


@pytest.mark.parametrize(
    ("name", "found"), [("a.urdf", "arm"), ("A.XML", "arm"), ("a.yml", "arm"), ("x/trajectory.csv", "motion")]
)
def test_what_a_file_is(name, found):
    assert upload.detect_file_kind(name) == found


@pytest.mark.parametrize(
    ("name", "sentence"), [("a.xacro", "expanded first"), ("a.mjcf", "cannot be opened here"), ("", "'file'")]
)
def test_what_a_file_is_not(name, sentence):
    with pytest.raises(hf.InputError, match=sentence):
        upload.detect_file_kind(name)


@pytest.mark.parametrize(
    ("name", "tidied"),
    [
        ("../../etc/passwd", "passwd"),
        ("C:\\x\\y.urdf", "y.urdf"),
        ("..", "file"),
        ("-rf", "rf"),
        ("a b<c>.urdf", "a_b_c_.urdf"),
    ],
)
def test_names_are_tidied(name, tidied):
    assert upload.sanitise_file_name(name) == tidied
