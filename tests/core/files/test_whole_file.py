"""Files on a disk that fills up: what was there stays, and no empty or half a file is left."""

from __future__ import annotations

import resource
from contextlib import contextmanager

import numpy as np
import pytest

import holdfast as hf
from holdfast import arms
from holdfast.core.files.output import open_replacement, replace_file
from holdfast.interface.report.figures import save_png
from holdfast.model.arms.spec import ArmSpec
from holdfast.response.recovery.waypoints import write_waypoints
from holdfast.studies.study_files import template
from holdfast.teleop.protocol import protocol
from holdfast.teleop.serve import texts


@contextmanager
def full_disk(room=64):
    """No file may grow beyond ``room`` bytes: the write fails midway, as on a disk that is full."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (room, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


def test_all_or_nothing(tmp_path):
    path = tmp_path / "a.txt"
    path.write_text("before")
    for write in (lambda: replace_file(path, "x" * 1000), lambda: replace_file(path, b"x" * 1000), lambda: _lines(path, 1000)):
        with full_disk(), pytest.raises(hf.StoreError, match="too large"):
            write()
        assert path.read_text() == "before"
        assert list(tmp_path.iterdir()) == [path]
        path.unlink()
        with full_disk(), pytest.raises(hf.StoreError, match="too large"):
            write()
        assert list(tmp_path.iterdir()) == []
        write()
        assert path.read_bytes() == b"x" * 1000
        path.write_text("before")


def _lines(path, count):
    with open_replacement(path) as file:
        for _ in range(count):
            file.write("x")


def test_an_error_while_writing_leaves_what_was_there(tmp_path):
    path = tmp_path / "a.txt"
    path.write_text("before")

    def interrupted():
        with open_replacement(path) as file:
            file.write("half")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert path.read_text() == "before"
    assert list(tmp_path.iterdir()) == [path]


def test_links_and_devices(tmp_path):
    (tmp_path / "there").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "there" / "a.txt")
    replace_file(tmp_path / "link", "text")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "there" / "a.txt").read_text() == "text"
    (tmp_path / "null").symlink_to("/dev/null")
    replace_file(tmp_path / "null", "text")
    assert (tmp_path / "null").is_char_device()


@pytest.fixture(scope="module")
def arm():
    return arms.load("planar-3r")


WRITERS = {
    "waypoints": lambda arm, to: write_waypoints(arm, np.zeros((20, arm.n)), to),
    "study file": lambda arm, to: template.write(to, [ArmSpec("planar-3r")], 10, 5, 0),
    "texts": lambda arm, to: texts.copy_english_texts(to),
    "protocol": lambda arm, to: protocol.read_protocol().write(to),
    "figure": lambda arm, to: save_png(_figure(), to),
}


def _figure():
    from matplotlib.figure import Figure

    return Figure(figsize=(1, 1))


@pytest.mark.parametrize("what", WRITERS)
def test_nothing_is_left_by_what_people_write(what, tmp_path, arm):
    with full_disk(), pytest.raises(hf.HoldfastError, match="cannot"):
        WRITERS[what](arm, tmp_path / "out.txt")
    assert list(tmp_path.iterdir()) == []
    WRITERS[what](arm, tmp_path / "out.txt")
    assert (tmp_path / "out.txt").stat().st_size > 64
