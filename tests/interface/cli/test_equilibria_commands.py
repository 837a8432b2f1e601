"""``holdfast stationary-points`` and ``holdfast basins``."""

from __future__ import annotations

import matplotlib.image
import numpy as np
import pytest

POINTS = ["stationary-points", "planar-3r", "--target", "1.5,1.5", "--lock", "2=140", "--degrees"]
CURVES = ["stationary-points", "planar-3r", "--target", "1.5,1.5", "--lock", "2"]
BASINS = ["basins", "planar-3r", "--target", "1.5,1.5", "--lock", "2=140", "--degrees"]


def test_rest_points(cli, ask):
    data = ask(*POINTS)
    assert [p["kind"] for p in data["points"]] == ["sink", "saddle", "saddle", "source"]
    assert data["points"][0]["position_error_m"] == pytest.approx(0.6456, abs=1e-4)
    assert data["points"][0]["q"]["joint1"] == pytest.approx(np.deg2rad(-10.5639), abs=1e-5)
    code, out, err = cli(*POINTS)
    assert (code, err) == (0, "")
    assert "sink" in out
    assert "-10.5639" in out
    assert "140 deg" in out


def test_curves_are_printed_and_drawn(cli, ask, tmp_path):
    figure = tmp_path / "curves.png"
    code, out, err = cli(*CURVES, "--plot", figure)
    assert (code, err) == (0, "")
    assert "Sinks with joint2 at 111.797 to 248.203 deg" in out
    assert matplotlib.image.imread(figure).shape[1] > 600
    data = ask(*CURVES)
    np.testing.assert_allclose(np.rad2deg(data["sink_arcs"]), [[111.797, 248.203]], atol=1e-3)


def test_basins_are_printed_and_drawn(cli, ask, tmp_path):
    for options in (["--starts", "50"], ["--grid", "12"]):
        figure = tmp_path / f"{options[0]}.png"
        code, out, err = cli(*BASINS, *options, "--plot", figure)
        assert (code, err) == (0, "")
        assert "sink 1" in out
        assert matplotlib.image.imread(figure).shape[1] > 600
    data = ask(*BASINS, "--starts", "50")
    assert data["fractions"][0]["fraction"] == 1
    assert data["converged"]["high"] < 0.1


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([*POINTS, "--plot", "x.png"], "--plot shows curves"),
        ([*POINTS, "--lock", "1"], "locked gives no value for 'joint1'; give {joint: value}"),
        ([*POINTS, "--lock", "2=1"], "--lock gives joint 'joint2' twice"),
        ([*CURVES, "--lock", "1"], "locked gives no value for 'joint2' and 'joint1'"),
        ([*BASINS, "--lock", "1"], "--lock '1' is not joint=number; write for example --lock joint1=0.3"),
        ([*BASINS, "--grid", "1"], "2 or more cells"),
        (["stationary-points", "planar-3r", "--target", "1", "--lock", "2"], "--target has 1 number"),
    ],
)
def test_wrong_input_is_one_sentence(refused, arguments, words):
    assert words in refused(*arguments)
