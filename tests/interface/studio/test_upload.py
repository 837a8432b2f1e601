"""Files that are sent to the page: what is opened, what is refused, and that no path of theirs is ever followed."""

from __future__ import annotations

import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import holdfast as hf
from holdfast.interface.studio.page import upload
from holdfast.model.arms import dh_file
from holdfast.model.arms.dh_rows import dh_table

CRANE = Path(__file__).parent / "arms" / "inspection-crane.urdf"


def test_an_arm_is_read_as_from_its_file():
    machine, state, parts, note = upload.read_uploaded_arm("C:\\arms\\crane.urdf", CRANE.read_bytes())
    same = hf.Arm.from_urdf(CRANE)
    q = np.array(state.q)
    np.testing.assert_array_equal(machine.tool_pose(q), same.frames(q)[-1])
    assert state.arm == "crane.urdf"
    assert state.names == same.joint_names
    assert len(parts) > 8
    assert "camera.stl" in note
    table = dh_file.format_dh_file(dh_table(hf.arms.load("pa10-7dof")), "mine")
    machine, state, parts, note = upload.read_uploaded_arm("mine.yaml", table.encode())
    assert (machine.arm.name, machine.arm.n, state.task, note) == ("mine", 7, "pose", "")


def test_no_path_of_a_file_is_followed(tmp_path):
    secret = tmp_path / "secret.stl"
    secret.write_text("solid x\nendsolid x\n")
    text = f"""<robot name="r"><link name="a"/><joint name="j" type="continuous">
        <parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
        </joint><link name="b"><visual><geometry><mesh filename="file://{secret}"/></geometry></visual>
        <visual><geometry><mesh filename="{secret}"/></geometry></visual></link></robot>"""
    opened, watching = [], True
    sys.addaudithook(lambda event, given: opened.append(str(given[0])) if event == "open" and watching else None)
    try:
        _, _, _, note = upload.read_uploaded_arm("../../x.urdf", text.encode())
    finally:
        watching = False
    assert str(secret) in note  # named as not found
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
    with pytest.raises(hf.HoldfastError) as found:
        upload.read_uploaded_arm(name, content)
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


def test_what_is_too_large_is_not_even_kept():
    """As a client that does not keep to the page's own limit would send it."""
    pytest.importorskip("viser")
    handlers, begun, refused, sent = {}, [], [], []
    connection = SimpleNamespace(
        unregister_handler=lambda kind, handler: handlers.pop(kind),
        register_handler=handlers.__setitem__,
        queue_message=sent.append,
    )
    gui = SimpleNamespace(
        _websock_interface=connection,
        _handle_file_transfer_start=lambda client, message: begun.append(message),
        _current_file_upload_states={},
    )
    from viser._messages import FileTransferStartUpload

    handlers[FileTransferStartUpload] = gui._handle_file_transfer_start
    upload.limit_uploads(gui, refused.append)
    (handler,) = handlers.values()

    def start(size, parts):
        handler(0, FileTransferStartUpload("button", "1", "a.urdf", "", parts, size))

    start(1000, 1)
    assert (len(begun), refused) == (1, [])
    for size, parts in ((upload.MAX_FILE_BYTES + 1, 9), (1000, 100_000), (-1, 1)):
        start(size, parts)
    assert len(begun) == 1
    assert len(refused) == len(sent) == 3
    assert "'a.urdf'" in refused[0]
    gui._current_file_upload_states.update({"1": None, "2": None})
    start(1000, 1)  # a third at the same time
    assert len(begun) == 1
