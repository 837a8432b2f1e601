"""Counts and intervals in the tables of faults."""

from __future__ import annotations

import numpy as np
import pytest
from papers.faults import blind, chain, records
from papers.faults.store import Store, limits
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
