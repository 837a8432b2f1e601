"""``holdfast power-loss``: what it prints, writes and draws."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import matplotlib.image
import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "interface" / "report"))
import holdfast as hf
from wellformed import check

CALL = ["power-loss", "planar-3r", "--q", "10 20 30", "--degrees", "--coulomb", "1.5", "--viscous", "2"]
Q = np.radians([10.0, 20, 30])
FRICTION = hf.Friction(coulomb=1.5, viscous=2.0)


@pytest.fixture(scope="module")
def planar():
    return hf.arms.load("planar-3r")


def test_help_has_an_example(cli):
    code, out, _ = cli("power-loss", "--help")
    assert code == 0
    assert "Example: holdfast power-loss" in " ".join(out.split())


def test_json_is_the_answer_of_the_library(ask, planar):
    data = ask(*CALL, "--free", "2,3", "--brake-after", "150", "--brake-torque", "30")
    brakes = hf.Brakes(after=0.15, torque=30.0)
    expected = hf.power_loss(planar, Q, free="2,3", friction=FRICTION, brakes=brakes)
    assert data["free"] == ["joint2", "joint3"]
    assert (data["drop_m"], data["released_J"], data["rest_time_s"]) == (expected.drop, expected.released, expected.rest_time)
    assert [entry["time_s"] for entry in data["drops"]] == [0.05, 0.1, 0.2, 0.5]
    assert [entry["drop_m"] for entry in data["drops"]] == list(expected.drop_at([0.05, 0.1, 0.2, 0.5]))
    assert data["coulomb"]["joint1"] == 1.5
    assert (data["outcome"], data["compared"]) == ("rest", {})


def test_a_friction_file_has_brakes_and_boards(ask, cli, tmp_path, planar):
    file = tmp_path / "friction.yaml"
    file.write_text("joint2: {coulomb: 1, brake: 30}\njoint3: {coulomb: 1, brake: 20}\nboards: {far: [joint2, joint3]}\n")
    call = ["power-loss", "planar-3r", "--q", "10 20 30", "--degrees", "--friction", file, "--free", "board:far"]
    friction, brakes = hf.Friction.from_file(file, planar), hf.Brakes(after=0.1, torque=[0, 30, 20])
    data = ask(*call, "--brake-after", "100", "--band")
    expected = hf.power_loss(planar, Q, free=[1, 2], friction=friction, brakes=brakes)
    assert (data["free"], data["drop_m"]) == (["joint2", "joint3"], expected.drop)
    compared = ask(*call, "--brake-after", "50", "--brake-after", "100")
    assert compared["torque"] == [[0, 30, 20]]
    code, out, err = cli(*call[:-1], "board:near")
    assert (code, out) == (2, "")
    assert err == "holdfast: board 'near' is unknown; the boards of the friction are far\n"
    assert json.loads(cli("holds", *call[1:], "--json")[1])["free"] == ["joint2", "joint3"]


def test_a_moving_start_falls_further(ask, planar):
    rates = np.radians([-20.0, 0, 0])
    data = ask(*CALL, "--rates", "-20 0 0")
    assert data["drop_m"] == hf.power_loss(planar, Q, rates, friction=FRICTION).drop
    assert data["drop_m"] > ask(*CALL)["drop_m"]


def test_the_drop_is_that_of_any_point(ask, cli, planar):
    data = ask(*CALL, "--of", "any point")
    expected = hf.power_loss(planar, Q, friction=FRICTION, of="any point")
    assert (data["of"], data["drop_m"]) == ("any point", expected.drop)
    assert data["drop_m"] >= ask(*CALL)["drop_m"]
    words = " ".join(cli(*CALL, "--of", "any point")[1].split())
    assert f"A point of the arm falls {expected.drop:.3g} m within" in words
    assert "largest drop of any point" in words


def test_the_swept_space_is_printed_and_drawn(ask, cli, tmp_path, planar):
    swept = hf.power_loss(planar, Q, friction=FRICTION, duration=0.3).sweep()
    assert ask(*CALL, "--duration", "0.3", "--sweep")["sweep"]["volume_m3"] == [swept.lower_volume, swept.upper_volume]
    code, out, _ = cli(*CALL, "--duration", "0.3", "--sweep", "--out", tmp_path)
    assert code == 0
    assert f"{1000 * swept.lower_volume:.3g} to {1000 * swept.upper_volume:.3g} L" in " ".join(out.split())
    assert "Points bound the swept space" in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_the_band_is_compared(ask, cli, planar):
    options = ("--brake-after", "20", "--brake-torque", "60", "--band")
    data = ask(*CALL, *options)
    drops = {label: entry["drop_m"] for label, entry in data["compared"].items()}
    for label, factor in (("without friction", 0), ("with twice the friction", 2)):
        friction = hf.Friction(coulomb=1.5 * factor, viscous=2.0 * factor)
        expected = hf.power_loss(planar, Q, friction=friction, brakes=hf.Brakes(after=0.02, torque=60.0))
        assert drops[label] == expected.drop, label
    assert "from no friction to twice the friction" in " ".join(cli(*CALL, *options)[1].split())


def test_several_brakes_are_compared(ask, cli, planar):
    options = ("--brake-after", "20", "--brake-after", "100", "--brake-torque", "60", "--brake-torque", "40,50,60")
    expected = hf.compare_brakes(planar, Q, torque=[60.0, [40.0, 50, 60]], after=[0.02, 0.1], friction=FRICTION)
    assert ask(*CALL, *options) == expected.to_dict()
    assert "stops at once" in cli(*CALL, *options)[1]


def test_a_motion_loses_its_power_at_every_instant(ask, cli, tmp_path, planar):
    time = np.linspace(0, 1, 8)
    q = Q + 0.3 * np.sin(time)[:, None]
    table = tmp_path / "motion.csv"
    header = "time_s,joint1_rad,joint2_rad,joint3_rad"
    np.savetxt(table, np.column_stack([time, q]), delimiter=",", header=header, comments="", fmt="%.17g")
    call = ["power-loss", "planar-3r", "--along", table, "--coulomb", "1.5", "--viscous", "2"]
    assert ask(*call) == hf.power_loss_along(planar, q, time, friction=FRICTION).to_dict()
    code, out, _ = cli(*call, "--out", tmp_path / "out")
    assert code == 0
    assert "is the worst of" in out
    assert (tmp_path / "out" / "drop.png").is_file()


def test_a_recording_in_degrees_is_a_motion(ask, tmp_path, planar):
    time = np.linspace(0, 1, 9)
    q = Q + 0.3 * np.sin(time)[:, None]
    log = hf.faults.Log(t=time, q_ref=q, q=q)
    data = ask("power-loss", "planar-3r", "--along", log.save(tmp_path / "log.npz"), "--coulomb", "1.5", "--viscous", "2")
    expected = hf.power_loss_along(planar, q, time, friction=FRICTION)
    np.testing.assert_allclose(data["drop"], expected.drop, atol=1e-5)  # logs have single precision


def test_random_configurations_give_a_probability(ask, cli, tmp_path, planar):
    call = ["power-loss", "planar-3r", "--anywhere", "--below", "0.5", "--samples", "200", "--coulomb", "1.5", "--viscous", "2"]
    expected = hf.power_loss_probability(planar, 0.5, samples=200, friction=FRICTION)
    assert ask(*call) == expected.to_dict()
    code, out, _ = cli(*call, "--out", tmp_path / "out")
    assert code == 0
    assert "stays at or below 0.500 m" in " ".join(out.split())
    assert (tmp_path / "out" / "map.png").is_file()


def test_people_read_the_answer_and_the_joints(cli, planar):
    code, out, err = cli(*CALL, "--brake-after", "50", "--brake-torque", "70")
    assert (code, err) == (0, "")
    fall = hf.power_loss(planar, Q, friction=FRICTION, brakes=hf.Brakes(after=0.05, torque=70.0))
    words = " ".join(out.split())
    assert f"The tool falls {1000 * fall.drop:.3g} mm, and the arm is at rest after {fall.rest_time:.3g} s" in words
    assert f"{1000 * fall.drop_at(0.1):.4g} mm" in out
    assert f"{planar.gravity_torque(Q)[0]:.2f} N m" in out
    assert "Neither the arm nor the options state" not in out


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ((), "nor viscous friction, so the joints swing on"),
        (("--viscous", "1"), "options state dry friction."),
        (("--coulomb", "400"), "The arm stays where it is"),
        (("--duration", "0.1", "--coulomb", "1"), "the arm still moves then"),
    ],
)
def test_the_words_say_what_is_assumed(cli, options, words):
    code, out, _ = cli("power-loss", "planar-3r", "--q", "0.1 0.2 0.3", *options)
    assert code == 0
    assert words in " ".join(out.split())


def test_the_motion_goes_to_a_file_and_a_picture(cli, tmp_path, planar):
    table, picture = tmp_path / "motion.csv", tmp_path / "motion.png"
    code, out, _ = cli(*CALL, "--csv", table, "--plot", picture, "--duration", "0.5")
    assert code == 0
    assert str(table) in out.replace("\n", "")
    rows = np.genfromtxt(table, delimiter=",", names=True)
    fall = hf.power_loss(planar, Q, friction=FRICTION, duration=0.5)
    assert rows["time_s"][[0, -1]].tolist() == [0.0, 0.5]
    np.testing.assert_allclose(rows["joint2_rad"], fall.q_at(rows["time_s"])[:, 1], atol=1e-8)
    np.testing.assert_allclose(rows["tool_y_m"], fall.tool_at(rows["time_s"])[:, 1], atol=1e-8)
    pixels = matplotlib.image.imread(picture)
    assert pixels.shape[1] > 900
    assert pixels[..., :3].std() > 0.05


def test_the_page_shows_both_simulations(cli, tmp_path):
    cell = tmp_path / "cell.yaml"
    cell.write_text("objects:\n  table: {box: [2, 2, 0.1], pose: {xyz: [1.4, 0, 0.2]}}\n")
    call = ["power-loss", "panda", "--q", "0 -10 0 -90 0 90 45", "--degrees", "--free", "2", "--viscous", "5", "--physics"]
    around = ["--cell", cell, "--radius", "0.04", "--duration", "1"]
    data = json.loads(cli(*call, *around, "--json")[1])
    assert data["compared"]["in MuJoCo"]["contacts"][0]["object"] == "table"
    code, out, _ = cli(*call, *around, "--out", tmp_path / "fall")
    assert code == 0
    assert "touches table" in " ".join(out.split())
    page = (tmp_path / "fall" / "report.html").read_text(encoding="utf-8").replace("\u00a0", " ")
    check(page)
    assert "<h1>Power loss of panda</h1>" in page
    assert "touches table" in page
    assert page.count("<svg") == 2  # of the view one


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["power-loss", "pa10-7dof", "--q", "0 0 0 0 0 0 0"], "it has no inertial data"),
        ([*CALL, "--free", "4"], "joint 4 is out of range"),
        (["power-loss", "planar-3r", "--q", "0 0"], "it must have 3"),
        ([*CALL, "--rates", "0 0"], "it must have 3"),
        ([*CALL, "--free", "2", "--rates", "1 0 0"], "which is held"),
        ([*CALL, "--brake-after", "-1", "--brake-torque", "3"], "after is -0.001 s"),
        ([*CALL, "--brake-after", "50"], "give both"),
        ([*CALL, "--brake-after", "50", "--brake-torque", "-1"], "brake torque of joint 'joint1' is -1"),
        ([*CALL, "--restitution", "2"], "restitution is 2"),
        ([*CALL, "--duration", "-1"], "duration is -1 s"),
        ([*CALL, "--accuracy", "0"], "accuracy is 0 m"),
        ([*CALL, "--of", "elbow"], "of is 'elbow'; use 'tool' or 'any point'"),
        ([*CALL, "--stiction", "1"], "below its coulomb friction"),
        ([*CALL, "--radius", "0.1", "--physics"], "there is none; add --cell"),
        (["power-loss", "planar-3r"], "give one of --q, --along, and --anywhere"),
        ([*CALL, "--anywhere"], "give one of --q, --along, and --anywhere"),
        (["power-loss", "planar-3r", "--anywhere"], "give --below"),
        (["power-loss", "planar-3r", "--anywhere", "--below", "0"], "below is 0"),
        (["power-loss", "planar-3r", "--anywhere", "--below", "1", "--measure", "fun"], "measure is"),
        (["power-loss", "planar-3r", "--along", "/nowhere.csv"], "/nowhere.csv"),
        (["power-loss", "planar-3r", "--anywhere", "--below", "1", "--sweep"], "describe one fall; give --q"),
        ([*CALL, "--brake-after", "1", "--brake-after", "2", "--brake-torque", "3", "--band"], "and at most one brake"),
        ([*CALL[:1], "planar-3r", "--anywhere", "--brake-after", "1", "--brake-after", "2", "--brake-torque", "3"], "give --q"),
        ([*CALL, "--csv", "/nowhere/motion.csv"], "cannot write motion"),
        ([*CALL, "--plot", "/nowhere/motion.png"], "cannot write picture"),
    ],
)
def test_bad_input_gives_one_sentence(cli, arguments, sentence):
    code, out, err = cli(*arguments)
    assert (code, out) == (2, "")
    assert sentence in err
    assert err.count("\n") == 1


def test_a_fall_ends_at_its_first_contact(ask, tmp_path):
    cell = tmp_path / "cell.yaml"
    cell.write_text("objects:\n  table: {box: [2, 2, 0.1], pose: {xyz: [1.4, 0, 0.2]}}\n")
    call = ["power-loss", "panda", "--q", "0 -10 0 -90 0 90 45", "--degrees", "--free", "2", "--viscous", "5"]
    data = ask(*call, "--cell", cell, "--radius", "0.04")
    assert data["outcome"] == "contact"
    assert data["drop_m"] < ask(*call)["drop_m"]
