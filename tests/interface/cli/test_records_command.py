"""``holdfast record-designs`` and ``holdfast upper-bound``."""

import json

import numpy as np
import pytest

import holdfast as hf


def test_a_submission_is_held_against_the_current_record(tmp_path, cli):
    text = hf.designs.record_design("pose-9R-k2-001").text.rpartition("digest:")[0]
    file = tmp_path / "mine.yaml"
    file.write_text(text.replace("id: pose-9R-k2-001", "id: mine"), encoding="utf-8")
    code, out, _ = cli("record-designs", "check", str(file))
    assert code == 0
    assert "does not beat pose-9R-k2-001" in out
    file.write_text(text.replace("0.24742", "0.26742"), encoding="utf-8")
    code, out, _ = cli("record-designs", "check", str(file))
    assert code == 3
    assert "the value beats a proven bound: one of both is wrong" in out
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


def test_an_arm_of_a_ceiling_is_written_and_read(tmp_path, cli):
    file = tmp_path / "nine.yaml"
    code, out, _ = cli("upper-bound", "9", "pose", "2", "--arm", str(file), "--json")
    assert code == 0
    made = json.loads(out)
    arm = hf.Arm.from_dh(hf.arms.dh_table(hf.arms.resolve(str(file))).rows)
    j = arm.jacobian(np.zeros(9))
    null = np.linalg.svd(j)[2][6:].T
    least = min(abs(np.linalg.det(null[[a, b]] @ null[[a, b]].T)) ** 0.5 for a in range(9) for b in range(a))
    assert least == pytest.approx(made["value"] - min(made["losses"]), abs=1e-9)


def test_a_search_for_a_new_record(tmp_path, cli):
    """A null space, an arm that has it, its file, and the check: each command takes what the last wrote."""
    arm, file = tmp_path / "arm.yaml", tmp_path / "mine.yaml"
    code, out, _ = cli("upper-bound", "5", "planar", "2", "--search", "0.3", "--arm", str(arm))
    assert code == 0
    assert f"written: {arm}" in out.replace("\n", " ").replace("  ", " ")
    code, out, _ = cli(
        "record-designs", "new", str(arm), "--task", "planar", "--failures", "2", "--name", "mine", "--by", "A: user"
    )
    assert code == 0
    file.write_text(out, encoding="utf-8")
    record = hf.designs.record_design(str(file))
    assert (record.id, record.data.found.by) == ("mine", "A: user")
    model = hf.arms.resolve(str(arm))
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
        (("panda", "--task", "pointing"), "records are of tasks"),
    ):
        assert said in cli("record-designs", "new", *wrong)[2]
    both = json.loads(cli("upper-bound", "4", "2", "1", "--search", "0.1", "--arm", str(arm), "--json")[1])
    assert len(both) == 2


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
    assert "planar-3r: judged as a whole" in page
    assert "is no measure; there are" in cli("compare-arms", "planar-3r", "--task", "planar", "--measures", "speed")[2]


def test_ceilings_on_the_command_line(cli):
    assert "the best that is known is 0.2474358297 = sqrt(3)/7" in cli("upper-bound", "9", "pose", "2")[1]
    found = json.loads(cli("upper-bound", "8", "6", "2", "--verify", "--json")[1])
    assert found["attained"]
    assert np.array(found["null_space"]).shape == (8, 2)
    assert len(json.loads(cli("upper-bound", "--table", "--task", "planar", "--json")[1])["ceilings"]) == 13
    better = json.loads(cli("upper-bound", "6", "3", "2", "--search", "0.3", "--json")[1])
    assert better["value"] == pytest.approx(5**-0.5, rel=1e-6)
    for words, said in (
        (("7", "7"), "there is no redundancy"),
        (("9", "6", "4"), "the ceiling is 0"),
        (("9", "seven"), "neither a number of rows nor a task"),
        ((), "give the joints and the rows"),
        (("--table", "--task", "7"), "nothing is stored"),
        (("7", "5", "2", "--arm", "a.yaml"), "arms are made for"),
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
    assert "is a null space alone" in cli("record-designs", "show", "jacobian-9-6-2-001", "--urdf")[2]
    book = tmp_path / "book"
    assert cli("record-designs", "list", "--out", str(book))[0] == 0
    page = (book / "records.html").read_text(encoding="utf-8")
    for kind in ("yaml", "urdf"):
        assert f'href="pose-9R-k2-001.{kind}"' in page
    assert hf.designs.record_design(str(book / "pose-9R-k2-001.yaml")).id == "pose-9R-k2-001"


def test_arms_from_files_of_numbers(tmp_path, cli):
    file = tmp_path / "null.csv"
    np.savetxt(file, hf.index_bounds.upper_bound(n=4, m=2, k=1).null_space, delimiter=",")
    code, out, _ = cli(
        "synthesise", str(file), "--null-space", "--task", "planar", "--starts", "1", "--out", str(tmp_path / "a")
    )
    assert code == 0
    assert "no arm can beat 0.707107" in out
    assert hf.arms.resolve(str(tmp_path / "a" / "arm-1.yaml")).n == 4
    assert "orders are judged for poses" in cli("synthesise", str(file), "--null-space", "--task", "planar", "--judge")[2]
    file.write_text("1, 2\n3, x\n", encoding="utf-8")
    assert "null.csv, line 2: '3, x' is no row of numbers" in cli("synthesise", str(file))[2]
    file.write_text("1 2\n3\n", encoding="utf-8")
    assert "line 2: 1 numbers; the first row has 2" in cli("synthesise", str(file))[2]


def test_the_least_singular_value_and_designs_without_slopes(cli):
    found = json.loads(cli("upper-bound", "7", "pose", "--singular-value", "1", "--json")[1])
    assert found["bound"] == pytest.approx(3**-0.5)
    code, _, told = cli("design", "planar-3r", "--vary", "a1=0.5..2", "--maximise", "self-motion-size", "--keep-reach")
    assert code == 2
    assert "--keep-reach to that and to tolerant-workspace" in told
