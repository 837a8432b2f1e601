"""Counts and intervals in the tables of faults."""

from __future__ import annotations

import numpy as np
import pytest
from measurements.faults import blind, chain, fitting, records
from measurements.faults.store import Store, limits
from scipy.stats import beta, binomtest

import holdfast as hf


@pytest.mark.parametrize(("hits", "size"), [(343, 347), (346, 347), (300, 300), (0, 10), (117, 203)])
def test_intervals_are_exact_and_an_upper_end_below_one_is_not_rounded_to_it(hits, size):
    low, high = (float(x) for x in limits(hits, size).split(" to "))
    exact = binomtest(hits, size).proportion_ci(0.95, method="exact")
    assert (low, high) == pytest.approx((100 * exact.low, 100 * exact.high), rel=6e-4)
    assert (high == 100) == (hits == size)
    assert chain.percent([{"ok": k < hits} for k in range(size)], "ok").endswith(f"({limits(hits, size)})")


def test_an_unnoticed_fault_is_not_counted_as_right(monkeypatch):
    """The table of logs: five faults and a healthy log whose answers are known."""
    answers = [
        {"kind": None, "joint": None, "said": None, "named": "unknown", "alarm": False, "early": False},
        *[{"kind": "limp", "joint": "b", "said": "b", "named": "limp", "alarm": True, "early": False}] * 2,
        {"kind": "weak", "joint": "b", "said": None, "named": "unknown", "alarm": False, "early": False},
        {"kind": "weak", "joint": "b", "said": "c", "named": "weak", "alarm": True, "early": False},
        {"kind": "weak", "joint": "b", "said": "b", "named": "weak", "alarm": True, "early": True},
    ]
    monkeypatch.setattr(blind, "calibrated", lambda arm: "")
    monkeypatch.setattr(blind, "judged", lambda arm, bounds, k: answers[k])
    monkeypatch.setattr(blind, "undeclared", lambda arm, bounds, k: {"alarm": k > 0, "named": "sensor"})
    text = "\n".join(blind.table(Store(None, hf.arms.load("planar-3r")), len(answers)))
    assert f"named in 2 of 5 ({100 * beta.ppf(0.025, 2, 4):.4g} to {100 * beta.ppf(0.975, 3, 3):.4g} %)" in text
    assert "no alarm in 1 of 5" in text
    assert "before the fault in 2 of 5" in text
    assert "healthy logs: 0 of 1" in text
    assert "Alarms in 9 of 10" in text
    assert "silence" not in text


def test_measured_delays_are_compared_with_the_prediction():
    locked = [{"delay": d, "expected": 0.01} for d in (0.004, 0.006, 0.012, 0.02)] + [{"noticed": False, "delay": -1.0}]
    (line, _) = records.predictions(locked)
    assert "0.40 to 2.00" in line
    assert f"is {np.median([0.4, 0.6, 1.2, 2.0]):.2f} in the median" in line
    assert "3 of 4" in line


def test_fitted_masses_are_compared_on_the_losses_that_both_bounds_state(monkeypatch):
    """Three robots whose answers are known: detected with both bounds, with fitted ones alone, and before the fault."""
    silent = {"early": False, "right": False, "kind": "unknown"}
    stated = {"early": False, "right": True, "kind": "weak", "uncertainty": 0.05}
    answers = [
        {"joint": 1, "many": {**stated, "error": 0.08}, "fitted": {**stated, "error": 0.02}},
        {"joint": 1, "many": silent, "fitted": {**stated, "error": 0.04, "kind": "sluggish"}},
        {"joint": 1, "many": {**silent, "early": True, "kind": "limp"}, "fitted": silent},
    ]
    monkeypatch.setattr(fitting, "judged", lambda arm, bounds, k: answers[k])
    text = fitting.table(Store(None, hf.arms.load("planar-3r")), None, 60, len(answers))
    many, fitted, many_both, fitted_both, weak = (line.split(" | ") for line in text if line.startswith(("| of", "| fit")))
    assert many[1:] == [f"1 of 3 ({limits(1, 3)} %)", "1", "1", "0.080 / 0.080 / 0.080", "0 of 1 (0 to 97.5 %) |"]
    assert fitted[1:5] == [f"2 of 3 ({limits(2, 3)} %)", "0", "2", "0.030 / 0.038 / 0.040"]
    assert (many_both[4], fitted_both[4], weak[4]) == ("0.080 / 0.080 / 0.080", *["0.020 / 0.020 / 0.020"] * 2)
    assert weak[3] == "1"
