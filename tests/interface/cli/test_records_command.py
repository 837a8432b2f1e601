"""``holdfast record-designs`` and ``holdfast upper-bound``."""

import json

import numpy as np
import pytest
import yaml

import holdfast as hf


def test_a_submission_is_held_against_the_current_record(tmp_path, cli):
    text = hf.designs.record_design("pose-9R-k2-001").text.rpartition("digest:")[0]
    file = tmp_path / "mine.yaml"
    file.write_text(text.replace("id: pose-9R-k2-001", "id: mine"), encoding="utf-8")
    code, out, _ = cli("record-designs", "check", str(file))
    assert code == 0
    assert "is not better than pose-9R-k2-001" in out
    file.write_text(text.replace("0.24742", "0.26742"), encoding="utf-8")
    code, out, _ = cli("record-designs", "check", str(file))
    assert code == 3
    assert "the value beats a proven bound: one of them is wrong" in out
    for wrong, said in ((text.replace("licence:", "license:"), "license"), (text.replace("a: 0.", "b: 0."), "rows")):
        file.write_text(wrong, encoding="utf-8")
        code, _, err = cli("record-designs", "check", str(file))
        assert code == 2
        assert said in err
    assert cli("record-designs", "check", "nothing")[0] == 2


def test_the_book_is_listed_and_checked_at_once(cli):
    listed = json.loads(cli("record-designs", "list", "--json")[1])["records"]
    code, out, _ = cli("record-designs", "check", "--all", "--json")
    assert code == 0, out
    assert len(listed) >= 50
    assert [x["id"] for x in listed] == [x["record"] for x in json.loads(out)]
    assert cli("record-designs", "check")[0] == 2


def test_a_submission_of_a_new_record(tmp_path, cli):
    """An arm, the file of its record, and the check: each command takes what the last wrote."""
    arm, file = tmp_path / "arm.yaml", tmp_path / "mine.yaml"
    book = hf.designs.record_designs()
    arm.write_text(yaml.safe_dump(yaml.safe_load(book["planar-5R-k2-001"].text)["arm"]), encoding="utf-8")
    code, out, _ = cli(
        "record-designs", "new", str(arm), "--task", "planar", "--failures", "2", "--name", "mine", "--by", "A: user"
    )
    assert code == 0
    file.write_text(out, encoding="utf-8")
    record = hf.designs.record_design(str(file))
    assert (record.id, record.data.found.by) == ("mine", "A: user")
    model = hf.arms.load(str(arm))
    index = hf.indices.relative_manipulability(model, "planar", 2)
    assert record.data.value == pytest.approx(index(np.zeros(5)), rel=1e-9)
    code, out, _ = cli("record-designs", "check", str(file))
    assert code == 0
    assert "planar-5R-k2-001" in out
    at = hf.designs.new_record(model, "planar", 2, q=[0.1, 0.2, 0.3, 0.4, 0.5])
    assert at.data.value == pytest.approx(index(at.q), rel=1e-9)
    assert at.check().ok
    for wrong, said in (
        (("planar-3r", "--task", "planar"), "is singular for task planar"),
        (("panda", "--task", "pointing"), "for a record it must be"),
    ):
        assert said in cli("record-designs", "new", *wrong)[2]


def test_arms_are_judged_on_the_command_line(tmp_path, cli):
    words = (
        "compare-arms",
        "planar-3r",
        "--task",
        "planar",
        "--measures",
        "fraction-above",
        "--samples",
        "500",
        "--thresholds",
        "0.3",
    )
    found = json.loads(cli(*words, "--json")[1])
    mine = hf.designs.compare_arms(
        hf.arms.load("planar-3r"), task="planar", measures=["fraction-above"], samples=500, thresholds=[0.3]
    )
    assert found["columns"][0]["values"] == mine.values[:, 0].tolist()
    assert cli(*words, "--out", str(tmp_path))[0] == 0
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "Global fault tolerance of planar-3r" in page
    assert "measure 'speed' is not known; use" in cli("compare-arms", "planar-3r", "--task", "planar", "--measures", "speed")[2]


def test_ceilings_on_the_command_line(cli):
    assert "The best known value is 0.2474358297 = sqrt(3)/7" in cli("upper-bound", "9", "pose", "2")[1]
    found = json.loads(cli("upper-bound", "8", "6", "2", "--verify", "--json")[1])
    assert found["attained"]
    assert np.array(found["null_space"]).shape == (8, 2)
    assert len(json.loads(cli("upper-bound", "--table", "--task", "planar", "--json")[1])["ceilings"]) == 13
    for words, said in (
        (("7", "7"), "there is no redundancy"),
        (("9", "6", "4"), "the bound is 0"),
        (("9", "seven"), "neither a number of task components nor a task"),
        ((), "give the number of joints and of task components"),
        (("--table", "--task", "7"), "nothing is stored"),
    ):
        code, _, err = cli("upper-bound", *words)
        assert code == 2
        assert said in err


def test_a_record_as_urdf_and_the_book_as_a_folder(tmp_path, cli):
    code, out, _ = cli("record-designs", "show", "pose-9R-k2-001", "--urdf")
    assert code == 0
    file = tmp_path / "arm.urdf"
    file.write_text(out, encoding="utf-8")
    record = hf.designs.record_design("pose-9R-k2-001")
    assert hf.indices.relative_manipulability(hf.Arm.from_urdf(file), "pose", 2)(record.q) == pytest.approx(record.data.value)
    assert "has only a null space" in cli("record-designs", "show", "jacobian-9-6-2-001", "--urdf")[2]
    book = tmp_path / "book"
    assert cli("record-designs", "list", "--out", str(book))[0] == 0
    page = (book / "records.html").read_text(encoding="utf-8")
    for kind in ("yaml", "urdf"):
        assert f'href="pose-9R-k2-001.{kind}"' in page
    assert hf.designs.record_design(str(book / "pose-9R-k2-001.yaml")).id == "pose-9R-k2-001"


def test_the_least_singular_value(cli):
    found = json.loads(cli("upper-bound", "7", "pose", "--singular-value", "1", "--json")[1])
    assert found["bound"] == pytest.approx(3**-0.5)


def test_the_options_of_convergence_are_refused_for_an_index(cli):
    code, _, told = cli("design", "planar-3r", "--vary", "a1=0.5..2", "--keep-reach")
    assert code == 2
    assert "--law and --keep-reach need --maximise convergence" in told
