"""Certificates from the command line."""

from __future__ import annotations

import json
import math
import shlex
import sys
from contextlib import nullcontext
from itertools import product

import numpy as np
import pinocchio
import pytest

import holdfast as hf
from holdfast.core.errors import InputError


def test_the_commands(cli, tmp_path):
    file = tmp_path / "a.certificate"
    words = ["certify", "reach", "planar-3r", "--box", "1.5 0.5", "--size", "0.4", "--out", str(file)]
    code, out, _ = cli(*words, "--lock", "2=50..60", "--degrees", "--json")
    assert code == 0
    assert json.loads(out)["rejected"] == 0
    lines = [line for line in cli("certificate", "show", str(file))[1].splitlines() if line]
    assert "joint2 may be locked" in lines[0]
    assert "not checked" in lines[-1]
    code, out, _ = cli("certificate", "check", str(file))
    assert code == 0
    assert "rejected: 0" in out
    code, out, _ = cli(*words[:3], "--box", "2.6 1.2", "--size", "0.6", "--halvings", "3", "--no-check", "--out", str(file))
    assert code == 3
    assert "not yet verified" in out
    assert "undecided" in out
    code, _, err = cli(*words, "--lock", "2=50")
    assert code == 2
    assert "JOINT=LOW..HIGH" in err
    text = file.read_text().replace('"locked": -1', '"locked": 1')
    file.write_text(text)
    assert cli("certificate", "check", str(file))[0] == 2


def test_a_tolerant_box(cli, tmp_path, monkeypatch):
    words = ["certify", "tolerant", "planar-3r", "--box", "1.5 0.5", "--size", "0.1", "--out", str(tmp_path / "box")]
    (tmp_path / "ranges.yaml").write_text("joint1: [-60, 30]\njoint2: [0, 80]\n")
    ranges = ["--ranges", str(tmp_path / "ranges.yaml"), "--range", "3=0..80", "--degrees"]
    code, out, _ = cli(*words, *ranges, "--json", "--plot", str(tmp_path / "a.png"))
    assert code == 0
    assert (tmp_path / "a.png").stat().st_size > 5000
    assert {part["undecided"]["value"] for part in json.loads(out)["parts"].values()} == {0}
    code, out, _ = cli("certificate", "check", str(tmp_path / "box" / "tolerant.certificate"))
    assert code == 0
    assert "healthy" in out
    code, out, _ = cli(*words, *ranges, "--failures", "3", "--no-check")
    assert code == 2  # of three joints at once
    monkeypatch.setattr("holdfast.interface.cli.certify_search.stop_on_signal", lambda said: nullcontext(lambda: True))
    code, out, err = cli(*words, *ranges)
    assert (code, err) == (130, "holdfast: stopped\n")
    assert "undecided" in out
    assert cli("certificate", "check", str(tmp_path / "box" / "tolerant.certificate"))[0] == 0
    (tmp_path / "ranges.yaml").write_text("joint1: 60\n")
    code, _, err = cli(*words, *ranges)
    assert code == 2
    assert "[LOW, HIGH]" in err


def test_out_of_reach(cli, tmp_path):
    file = tmp_path / "a.certificate"
    words = ["certify", "out-of-reach", "planar-3r", "--lock", "2=90..100", "--degrees", "--out", str(file)]
    code, out, _ = cli(*words, "--box", "2.5 1", "--size", "0.2", "--json")
    assert code == 0
    assert json.loads(out)["undecided"]["value"] == 0
    assert "the tool is elsewhere" in cli("certificate", "show", str(file))[1]
    code, out, _ = cli(*words, "--box", "1.5 1", "--size", "0.2")
    assert code == 4
    assert "Refuted: at (" in out
    assert cli("certificate", "check", str(file))[0] == 0
    code, out, _ = cli(*words, "--box", "2.6 0", "--size", "0.2", "--time-limit", "1e-9", "--no-check", "--json")
    assert code == 3
    assert json.loads(out)["witness"] is None


def test_poses(cli, tmp_path):
    file = tmp_path / "a.certificate"
    words = ["certify", "reach", "panda", "--box", "0.5 0 0.5", "--size", "0.01", "--degrees", "--out", str(file)]
    for size, axes in ((), "xyz"), (("--rotation-size", "1"), "xyzRPY"):
        assert cli(*words, "--rotation", "180 0 0", *size)[0] == 0
        document = json.loads(file.read_text())
        assert document["target"]["axes"] == axes
        assert (document["target"]["orientation"] is None) == bool(size)
    roll = [math.degrees(float.fromhex(x)) for x in document["target"]["box"][3]]
    assert roll == pytest.approx([179.5, 180.5])
    code, _, err = cli(*words, "--rotation-size", "1")
    assert code == 2
    assert "--rotation" in err
    assert cli(*words, "--rotation", "180 0")[0] == 2


def test_a_ceiling(cli, tmp_path):
    file = tmp_path / "a.certificate"
    words = ["certify", "ceiling", "panda", "--around", "-35 -45 51 -111 -46 84 -3", "--degrees", "--out", str(file)]
    code, out, _ = cli(*words, "--within", "3", "--below", "0.07", "--json")
    assert code == 0
    assert json.loads(out)["rejected"] == 0
    assert "is at most 0.07; angles in rad" in cli("certificate", "show", str(file))[1]
    page = tmp_path / "a.html"
    code, out, _ = cli(*words, "--within", "3", "--below", "0.06", "--report", str(page))
    assert code == 4
    assert "certify ceiling panda" in page.read_text(encoding="utf-8")
    assert "Refuted: 0.06" in out
    assert cli("certificate", "check", str(file))[0] == 0
    code, _, err = cli(*words, "--within", "3 4", "--below", "0.06")
    assert code == 2
    assert "give 7, and one or 7" in err
    assert cli(*words, "--below", "0.06")[0] == 2
    code, out, _ = cli(
        *words, "--within", "5", "--limit", "2=-50..-40", "--below", "0.07", "--halvings", "0", "--no-check", "--json"
    )
    assert code == 3
    assert len(json.loads(out)["extreme"]) == 7


def test_a_hold(cli, tmp_path):
    """Friction a little above and below the largest gravity torque that Pinocchio finds at the corners of the box."""
    arm, center, half = hf.arms.load("yam"), np.deg2rad([0, 60, 60, 0, 0, 0]), np.deg2rad(2)
    corners = center + half * np.array(list(product((-1, 1), repeat=6)))
    model = arm.to_pinocchio()
    data = model.createData()
    most = max(np.abs(pinocchio.computeGeneralizedGravity(model, data, corner)).max() for corner in corners)
    file, page = tmp_path / "a.certificate", tmp_path / "a.html"
    words = ["certify", "hold", "yam", "--around", "0 60 60 0 0 0", "--within", "2", "--degrees", "--out", str(file)]
    code, out, _ = cli(*words, "--coulomb", str(1.02 * most), "--json", "--report", str(page))
    assert (code, json.loads(out)["rejected"]) == (0, 0)
    assert "certify hold yam" in page.read_text(encoding="utf-8")
    assert cli("certificate", "check", str(file))[0] == 0
    assert cli(*words, "--coulomb", str(0.8 * most))[0] == 4
    assert cli(*words, "--stiction", str(0.8 * most), "--gravity", "0,0,-4.9")[0] == 0
    code, _, err = cli(*words, "--coulomb", "9", "--plot", str(tmp_path / "a.png"))
    assert code == 2
    assert "figure" in err
    code, _, err = cli(*words, "--coulomb", "0")
    assert code == 2
    assert "nothing holds this arm but its motors" in err


def test_a_structural_zero(cli, tmp_path):
    words = ["certify", "structural-zero", "--out", str(tmp_path / "a.certificate")]
    code, out, _ = cli(*words, "iiwa14", "lbr_iiwa_joint_4")
    assert code == 0
    assert "a lock of lbr_iiwa_joint_4 is 0" in " ".join(out.split())
    code, out, _ = cli(*words, "iiwa14", 4)
    assert code == 0
    assert "a lock of lbr_iiwa_joint_4 is 0" in " ".join(out.split())
    code, out, _ = cli(*words, "panda", "panda_joint4", "--json")
    assert code == 3
    assert json.loads(out)["proved"] is False


def test_a_floor(cli, tmp_path):
    file = tmp_path / "a.certificate"
    words = [
        "certify",
        "floor",
        "panda",
        "--around",
        "40 20 -30 -90 30 120 0",
        "--within",
        "2",
        "--degrees",
        "--out",
        str(file),
    ]
    code, out, _ = cli(*words, "--above", "0.02", "--json")
    assert code == 0
    assert json.loads(out)["undecided"]["value"] == 0
    code, out, _ = cli(*words, "--above", "0.03")
    assert code == 4
    assert "Refuted: 0.02" in out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("reach panda --box '0.5 0' --size 0.1", "arms that move in the xy plane"),
        ("reach planar-3r --box '1.5 0.5' --size 0.4 --lock 2=..1", "'2=..1' is not an interval; write JOINT=LOW..HIGH"),
        ("reach planar-3r --box '1.5 0.5' --size 0.4 --lock 2=1..0.5", "joint2 is 1 to 0.5; it must be"),
        ("reach planar-3r --box '1.5 0.5' --size 0.4 --rotation-size 1", "need --rotation, which is missing; give it as well"),
        ("reach planar-3r --box '1.5 0.5' --size 0.4 --out none/a.certificate", "there is no folder 'none'"),
        ("reach planar-3r --box '1.5 0.5' --size 0.4 --out .", "is a folder; give the name of a file"),
        ("reach planar-3r --box '1.5 0.5' --size 0.4 --out arm.urdf", "exists and is not a certificate"),
        ("tolerant planar-3r --box '1.5 0.5' --size 0.1 --out arm.urdf", "exists and is not a certificate"),
        ("floor panda --around '1 1 1 1 1 1 1' --within -1 --above 0.1", "--within is -1; a half width must be 0 or larger"),
        ("floor ur5-rail --limit rail=0..0.1 --above 0.1", "rail is prismatic; bounds are for arms with revolute joints only"),
        ("structural-zero ur5-rail rail", "structural zeros are for arms with revolute joints only"),
        ("path planar-3r motion.csv --during 1", "--during has 1 number; give two fractions"),
    ],
)
def test_what_makes_no_claim_is_said_before_the_search(refused, tmp_path, monkeypatch, words, said):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "arm.urdf").write_text("<robot/>")
    assert said in refused("certify", *shlex.split(words))
    assert (tmp_path / "arm.urdf").read_text() == "<robot/>"


def test_the_arm_that_a_certificate_is_about(cli, refused, tmp_path):
    file = tmp_path / "a.certificate"
    words = ["--around", "-35 -45 51 -111 -46 84 -3", "--within", "3", "--degrees", "--below", "0.06", "--out", file]
    assert cli("certify", "ceiling", "panda", *words)[0] == 4
    code, out, _ = cli("certificate", "check", file, "--arm", "panda")
    assert code == 0
    assert "refuted         by a witness" in out
    assert "another arm, 'panda': its joints are panda_joint1" in refused("certificate", "check", file, "--arm", "iiwa14")
    panda = hf.arms.load("panda")
    with pytest.raises(InputError, match="'panda': panda_joint1 differs"):
        hf.check_certificate(file, arm=panda.with_limits(0.9 * panda.lower, panda.upper))
    assert "undecided 100 %" in cli("certificate", "show", file)[1]


@pytest.mark.parametrize(
    "words",
    [
        "reach planar-3r --box '1.5 0.5' --size 0.4",
        "tolerant planar-3r --box '1.5 0.5' --size 0.1 --range 1=-1..0.5 --range 2=0..1.4 --range 3=0..1.4",
        "tolerant planar-3r --box '1.5 0.5' --size 0.1 --find-ranges",
        "out-of-reach planar-3r --box '2.5 1' --size 0.2",
        "ceiling panda --around '0 0 0 -1 0 1 0' --within 0.01 --below 0.1",
        "floor panda --around '0 0 0 -1 0 1 0' --within 0.01 --above 0.01",
        "structural-zero iiwa14 lbr_iiwa_joint_4",
    ],
)
def test_python_flint_is_asked_for_before_the_search(refused, monkeypatch, tmp_path, words):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setitem(sys.modules, "flint", None)
    for search in ("certify", "find_working_ranges"):
        monkeypatch.setattr(hf, search, lambda *_, **__: pytest.fail("the search begins"))
    assert "pip install 'holdfast-arms[certify]'" in refused("certify", *shlex.split(words))
    assert not list(tmp_path.iterdir())


def test_without_a_check_python_flint_is_not_needed(cli, monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "flint", None)
    words = ["certify", "reach", "planar-3r", "--box", "1.5 0.5", "--size", "0.02", "--out", tmp_path / "a.certificate"]
    assert cli(*words, "--no-check")[0] == 0


@pytest.mark.parametrize(("spent", "left"), [(2.0, 8.0), (30.0, 0.0)])
def test_the_time_limit_is_that_of_search_and_check_together(cli, monkeypatch, tmp_path, spent, left):
    """Half is kept for the check, which gets what the search leaves as well; the clock is the test's."""
    clock, limits = iter([100.0, 100.0 + spent]), []
    search, check = hf.certify, hf.check_certificate
    monkeypatch.setattr("holdfast.interface.cli.certify_search.monotonic", lambda: next(clock))
    monkeypatch.setattr(hf, "certify", lambda *a, **b: limits.append(b.pop("time_limit")) or search(*a, **b))
    monkeypatch.setattr(hf, "check_certificate", lambda *a, **b: limits.append(b["time_limit"]) or check(*a, **b))
    file = tmp_path / "a.certificate"
    words = ["certify", "reach", "planar-3r", "--box", "1.5 0.5", "--size", "0.02", "--out", file]
    code, _, err = cli(*words, "--time-limit", "10")
    assert limits == [5.0, left]
    assert (code, "ended the check" in err) == ((0, False) if left else (3, True))
    monkeypatch.undo()
    assert hf.check_certificate(file).ok  # what the search found is written, and can be verified later


def test_a_folder_that_out_named_is_shown_and_checked(cli, refused, tmp_path):
    words = ["certify", "tolerant", "planar-3r", "--box", "2.95 0", "--size", "0.1", "--halvings", "2"]
    ranges = [text for joint in "123" for text in ("--range", f"{joint}=-0.3..0.3")]
    assert cli(*words, *ranges, "--out", tmp_path / "box")[0] == 3
    (first, *_), last = (lines := cli("certificate", "show", tmp_path / "box")[1].splitlines()), lines[-1]
    assert first.startswith("Not verified")
    assert "at any value of its range" in first
    assert "undecided" in last
    assert cli("certificate", "check", tmp_path / "box")[0] == 0
    file = tmp_path / "reach.certificate"
    reach = ["certify", "reach", "planar-3r", "--box", "2.5 0", "--size", "1.2 0.1", "--halvings", "4", "--out", file]
    code, out, _ = cli(*reach)
    assert code == 3
    share = out.split("Proved for only ")[1].split(" %")[0]
    assert cli("certificate", "show", file)[1].startswith(f"Not verified, proved for only {share} % of this claim: For every")
    (tmp_path / "empty").mkdir()
    assert "holds no certificate" in refused("certificate", "show", tmp_path / "empty")


def test_ranges_are_found_printed_and_certified(cli, tmp_path):
    """The printed command proves the same claim, without the search."""
    words = ["certify", "tolerant", "planar-3r", "--box", "1.5 0.5", "--size", "0.1", "--range=3=-2.5..2.5", "--find-ranges"]
    page = tmp_path / "a.html"
    code, out, err = cli(*words, "--out", tmp_path / "a", "--report", page)
    assert (code, err) == (0, "")
    assert "104 sampled targets" in out
    assert "The limiting joint is joint1: its range of -66.16 to 103.8 deg is 47.2 % of its limits." in " ".join(out.split())
    assert "Proved: 100 %" in out
    text = page.read_text(encoding="utf-8")
    assert "The limiting joint is joint1" in text
    assert "169.9 deg" in text.replace("\N{NO-BREAK SPACE}", " ")
    (line,) = [line for line in out.splitlines() if line.startswith("To prove the claim without the search: holdfast ")]
    again = shlex.split(line.partition(": holdfast ")[2])
    assert again.count("--range") == 3
    assert not {"--find-ranges", "--range=3=-2.5..2.5"} & set(again)
    claim = json.loads((tmp_path / "a" / "tolerant.certificate").read_text())["claim"]
    assert cli(*again, "--out", tmp_path / "b")[0] == 0
    assert json.loads((tmp_path / "b" / "tolerant.certificate").read_text())["claim"] == claim
    code, out, _ = cli(*words, "--out", tmp_path / "c", "--no-check", "--json")
    document = json.loads(out)
    assert document["claim"] == claim
    assert document["found_ranges"]["limiting_joint"] == "joint1"
    assert document["found_ranges"]["options"] == again[again.index("--range") + 1 :: 2]


def test_ranges_that_are_not_found_are_said_and_nothing_is_written(cli, refused, tmp_path):
    words = ["certify", "tolerant", "planar-3r", "--box", "3 0", "--size", "0.2", "--find-ranges", "--out", tmp_path / "a"]
    code, out, _ = cli(*words)
    assert code == 3
    assert "Not found: with the best working ranges" in out
    code, out, _ = cli(*words, "--json")
    assert code == 3
    assert json.loads(out)["found"] is False
    assert not list(tmp_path.iterdir())
    assert "outside of its limits" in refused(*words, "--range", "1=-9..9")
    (tmp_path / "arm.urdf").write_text("<robot/>")
    assert "exists and is not a certificate" in refused(*words[:-1], tmp_path / "arm.urdf")
