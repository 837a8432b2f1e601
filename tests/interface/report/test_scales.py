"""Axes of drawings without matplotlib, against matplotlib's."""

import itertools

import numpy as np
import pytest
from matplotlib.scale import SymmetricalLogTransform
from matplotlib.ticker import MaxNLocator

from holdfast.interface.report.scales import AxisScale, choose_round_numbers, format_tick_labels

RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")


def read(text):
    """The number that a label says."""
    sign, text = (-1, text[1:]) if text.startswith("−") else (1, text)
    if text[:2] == "10" and text[2:3] and text[2] in "⁰¹²³⁴⁵⁶⁷⁸⁹⁻":
        return sign * 10.0 ** int(text[2:].translate(RAISED))
    return sign * float(text.replace("−", "-"))


@pytest.mark.parametrize("most", [4, 5, 8])
def test_round_numbers_are_those_of_matplotlib(most, rng):
    locator = MaxNLocator(most, steps=[1, 2, 2.5, 5, 10])
    for _ in range(300):
        low = rng.normal() * 10.0 ** rng.uniform(-3, 3)
        high = low + abs(low) * 10.0 ** rng.uniform(-3, 3)
        expected = [t for t in locator.tick_values(low, high) if low <= t <= high]
        found = choose_round_numbers(low, high, most)
        np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9 * (high - low))


def test_ends_that_are_round_are_ticks():
    assert choose_round_numbers(0.0, 8.0, 8) == [0, 1, 2, 3, 4, 5, 6, 7, 8]
    assert choose_round_numbers(0.1, 0.3, 4) == [0.1, 0.15, 0.2, 0.25, 0.3]


def test_labels_say_the_numbers(rng):
    for _ in range(300):
        low = rng.normal() * 10.0 ** rng.uniform(-12, 12)
        numbers = choose_round_numbers(low, low + abs(low) * 10.0 ** rng.uniform(-4, 4), 5)
        texts = format_tick_labels(numbers)
        assert len(set(texts)) == len(texts)
        np.testing.assert_allclose([read(t) for t in texts], numbers, rtol=1e-9, atol=1e-6 * (numbers[1] - numbers[0]))


def test_labels_as_people_write_them():
    assert format_tick_labels([-0.5, 0.0, 0.5]) == ["−0.5", "0.0", "0.5"]
    assert format_tick_labels([0.0, 25.0, 50.0]) == ["0", "25", "50"]
    assert format_tick_labels([0.0, 2.5e-6, 5e-6]) == ["0", "2.5e−6", "5.0e−6"]
    assert format_tick_labels([-2e7, 0.0, 2e7]) == ["−2e7", "0", "2e7"]


@pytest.mark.parametrize("kind", ["linear", "log", "symlog"])
@pytest.mark.parametrize("run", range(20))
def test_values_have_the_places_that_the_ticks_say(kind, run, rng):
    values = rng.normal(size=60) * 10.0 ** rng.uniform(-4, 3, 60) * 10.0 ** rng.uniform(-3, 3)
    small = float(np.median(np.abs(values)))
    axis = AxisScale(values, kind, small, 0.05, 6)
    bent = {"linear": lambda x: x, "log": np.log10, "symlog": SymmetricalLogTransform(10, small, 1).transform}[kind]
    used = values[values > 0] if kind == "log" else values
    places = axis.to_fraction(used)
    assert places.min() == pytest.approx(1 / 22)
    assert places.max() == pytest.approx(21 / 22)
    scaled = np.interp(bent(used), [bent(used).min(), bent(used).max()], [1 / 22, 21 / 22])
    np.testing.assert_allclose(places, scaled, atol=1e-12)
    assert len(axis.ticks) >= 2
    for place, text in axis.ticks:
        assert 0 <= place <= 1
        slope = (bent(used).max() - bent(used).min()) / (20 / 22)
        assert bent(np.array([read(text)]))[0] == pytest.approx(bent(used).min() + (place - 1 / 22) * slope, abs=1e-6 * slope)
    gaps = [abs(a - b) for (a, _), (b, _) in itertools.combinations(axis.ticks, 2)]
    assert min(gaps) > 0.05


def test_what_has_no_place():
    axis = AxisScale(np.array([np.nan, -1.0, 0.0, 1e-3, 10.0]), "log")
    assert np.isnan(axis.to_fraction(np.array([np.nan, -1.0, 0.0]))).all()
    assert [text for _, text in axis.ticks] == ["10⁻³", "10⁻²", "10⁻¹", "1", "10"]


@pytest.mark.parametrize("kind", ["linear", "log", "symlog"])
@pytest.mark.parametrize("value", [0.0, 3.0, -2e-7, 5e8])
def test_what_does_not_change_is_flat_and_in_the_middle(kind, value):
    axis = AxisScale(np.array([value, value * (1 + 1e-12)]), kind, 1.0, 0.1)
    np.testing.assert_allclose(axis.to_fraction(np.array([value])), 0.5, atol=1e-6)
    assert axis.ticks


def test_nothing_at_all_has_an_axis():
    assert len(AxisScale(np.full(3, np.nan)).ticks) >= 2
