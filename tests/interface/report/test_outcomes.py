"""Figures of outcomes, quantiles and differences."""

from __future__ import annotations

import numpy as np

from holdfast.interface.report import svg
from holdfast.interface.report.motions import StickMotion, TimePanel, stick_motion_figure
from holdfast.interface.report.outcomes import Gains, Spread, Stack, gain_figure, spread_figure, stack_figure
from holdfast.interface.report.views import View
from wellformed import check


def test_bars_say_what_they_are(rng):
    shares = rng.dirichlet(np.ones(4), size=3)
    stacks = [
        Stack(name=name, bars=["a $ law", "b", "c"], shares=shares, low=shares[:, 0] - 0.1, high=shares[:, 0] + 0.1, level=0.5)
        for name in ("x", "y")
    ]
    figure = stack_figure(stacks, ["converged", "stuck", "moving", "undecided"], "share of 100 runs", level="within reach")
    text = str(svg(figure, "a", "bars"))
    check(f"<html>{text}</html>")
    for word in ("a $ law", "share of 100 runs", "undecided", "95 % interval of converged", "within reach"):
        assert word in text
    bars = [p for p in figure.axes[0].patches if p.get_height() > 0]
    assert len(bars) == 2 * 3 * 4
    np.testing.assert_allclose(sum(b.get_width() for b in bars), 6)


def test_quantiles_and_differences_are_where_they_belong(rng):
    quantiles = np.sort(rng.uniform(size=(2, 5)), axis=1)
    figure = spread_figure(["one", "two"], [Spread("m", quantiles), Spread("s", quantiles)])
    medians = [line.get_xdata()[0] for line in figure.axes[0].get_lines()]
    np.testing.assert_allclose(medians, quantiles[:, 2])
    value = rng.normal(size=3)
    gains = [Gains(label=name, value=value, low=value - 1, high=value + 1) for name in ("b", "c")]
    text = str(svg(gain_figure(["joint1", "joint2", "any"], [("share", gains), ("error, m", gains)]), "g", "gains"))
    check(f"<html>{text}</html>")
    assert "error, m" in text
    assert "joint2" in text


def test_a_drawn_motion_shows_lock_target_and_error(rng):
    chain = rng.normal(size=(7, 4, 3)).cumsum(axis=1)
    motion = StickMotion(chain, np.zeros(4, dtype=bool), chain[[0, -1], -1], np.arange(4) == 1, chain[-1, -1])
    view = View(np.eye(3)[0], np.eye(3)[2], "Side view")
    panel = TimePanel(
        np.linspace(0, 1, 7), np.geomspace(1, 1e-3, 7), "error, m", "Ends stuck", None, ((0.5, 0.03, "joint1 locks"),), True
    )
    figure = stick_motion_figure(motion, [view], panel, "caption", "time, s")
    text = str(svg(figure, "m", "motion"))
    check(f"<html>{text}</html>")
    for word in ("locked", "target", "joint1 locks", "Side view", "error, m"):
        assert word in text
    assert figure.axes[1].get_yscale() == "log"
