"""``holdfast export``: the files of the library, and one sentence for everything that is wrong."""

from __future__ import annotations

import numpy as np

import holdfast as hf


def test_it_is_the_library(ask, tmp_path):
    arm = hf.arms.load("planar-3r")
    for label, law in (
        ("pseudoinverse", hf.control.pseudoinverse(arm, "planar")),
        ("weighted:1,2,3", hf.control.weighted(arm, [1, 2, 3], "planar")),
        ("damped:0.2", hf.control.damped(arm, 0.2, "planar")),
        ("damped:damping=0.3", hf.control.damped(arm, 0.3, "planar")),
        ("failure-tolerant:0.3", hf.control.failure_tolerant(arm, "planar", 0.3)),
        ("jacobian-transpose", hf.control.jacobian_transpose(arm, "planar")),
    ):
        name, out = law.slug, tmp_path / label
        data = ask("export", "planar-3r", "--law", label, "--language", "c", "--out", out, "--name", "law")
        assert (data["law"], data["task"], data["arm"]) == (name, "planar", "planar-3r")
        files = law.export_c(tmp_path / "library", "law")
        for key, file in zip(("source", "header", "example", "test"), files, strict=True):
            assert (out / file.name).read_text() == file.read_text()
            assert data[key] == str(out / file.name)


def test_a_monitor_stands_beside_the_law(ask, tmp_path):
    arm, t = hf.arms.load("planar-3r"), np.arange(500) / 1000
    q = 0.3 * np.sin(np.outer(t, [1.0, 0.5, 0.7]))
    bounds = hf.diagnosis.calibrate(arm, [hf.faults.Log(t=t, q_ref=q, q=q + 1e-3 * t[:, None])])
    known = bounds.to_json(tmp_path / "bounds.json")
    data = ask("export", "planar-3r", "--law", "pseudoinverse", "--monitor", known, "--out", tmp_path)
    assert (tmp_path / "pseudoinverse_monitor.c").read_text().count("pseudoinverse_monitor_step(") == 1
    assert str(tmp_path / "pseudoinverse_monitor.h") in data["files"]
    data = ask("export", "planar-3r", "--law", "pseudoinverse", "--monitor", known, "--controller", "--out", tmp_path / "more")
    for file in ("pseudoinverse_controller.hpp", "pseudoinverse_controller_monitor.c"):
        assert str(tmp_path / "more" / file) in data["files"]


def test_a_person_reads_what_was_written(cli, tmp_path):
    code, out, err = cli("export", "ur5-rail", "--law", "damped:0.1", "--task", "position", "--out", tmp_path)
    assert (code, err) == (0, "")
    for part in ("damped inverse", "position (3 rows)", "damping 0.1", "ur5-rail", "damped.c", "damped.h"):
        assert part in " ".join(out.split()), part
    assert "rail [m], " in (tmp_path / "damped.h").read_text()


def test_what_is_refused(refused, tmp_path):
    start = ("export", "planar-3r", "--out", tmp_path / "new")
    assert "needs damping" in refused(*start, "--law", "damped")
    assert "control law 'pseudoinverse' takes no setting" in refused(*start, "--law", "pseudoinverse:1")
    assert "control law 'damped' has no setting 'size'; write damped:DAMPING" in refused(*start, "--law", "damped:size=1")
    assert "a value holds no '+'; write 1e3 for 1e+3" in refused(*start, "--law", "damped:1e+3")
    assert "did you mean pseudoinverse?" in refused(*start, "--law", "pseudo-inverse")
    assert "control law 'pinv' is not known" in refused(*start, "--law", "pinv")
    assert "--language 'rust' is not known; use c" in refused(*start, "--language", "rust")
    assert "--controller needs a monitor; add --monitor BOUNDS" in refused(*start, "--controller")
    assert "between 0 and 1" in refused(*start, "--law", "failure-tolerant:2")
    assert "--law 'weighted:a,1,2': 'a' is not a number" in refused(*start, "--law", "weighted:a,1,2")
    assert "cannot name a C function" in refused(*start, "--law", "pseudoinverse", "--name", "3r")
    assert not (tmp_path / "new").exists()
