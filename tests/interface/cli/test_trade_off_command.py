"""``holdfast trade-off``: the numbers of the library, printed, as JSON and drawn."""

from __future__ import annotations

import matplotlib.image
import numpy as np
import pytest

import holdfast as hf

CALL = ["trade-off", "planar-3r", "--samples", "200", "--allowed", "0 0.25 0.5", "--seed", "3"]


def test_json_is_what_the_library_says(ask):
    data = ask(*CALL)
    curve = hf.control.trade_off(hf.arms.load("planar-3r"), "planar", 200, allowed=[0, 0.25, 0.5], seed=3)
    assert (data["task"], data["samples"], data["seed"]) == ("planar", 200, 3)
    assert data["pre_failure_error"] == [0, 0.25, 0.5]
    np.testing.assert_array_equal(data["gain"]["q50"], np.median(curve.gain, axis=0))
    np.testing.assert_array_equal(data["healthy_error"]["q95"], np.quantile(curve.healthy_error, 0.95, axis=0))
    np.testing.assert_array_equal(
        np.transpose(data["peak_error"]["median_95_percent_interval"]), curve.median_interval("peak_error")
    )


def test_it_is_printed_and_drawn(cli, tmp_path):
    figure = tmp_path / "curve.png"
    code, out, err = cli(*CALL, "--plot", figure)
    assert (code, err) == (0, "")
    assert "200 random configurations" in out
    assert "0.25" in out
    assert matplotlib.image.imread(figure).shape[1] > 900


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--allowed", "0.5 0.2"], "in increasing order"),
        (["--allowed", "x"], "'x' is not a number"),
        (["--samples", "3"], "give 10 or more"),
        (["--task", "pose"], "6 rows"),
    ],
)
def test_wrong_input_is_one_sentence(refused, arguments, words):
    assert words in refused(*CALL, *arguments)
