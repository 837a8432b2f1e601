"""Drawings over time: every line is where the ticks say its values are, and nothing is outside."""

import re

import numpy as np
import pytest

from holdfast.interface.report.timelines import Timeline, TimelineLine, draw_small_multiples, draw_stacked_panels
from wellformed import check

TIME = np.linspace(0, 4, 50)


def points(way):
    return np.array([[float(x) for x in p.split()] for p in re.findall(r"[ML]([^ML]+)", way)])


def paths(text):
    """Lines of data: path data, colour."""
    return re.findall(r'<path d="(M[^"hvHV]+)" fill="none" stroke="(#\w+)" stroke-width', text)


def test_a_line_is_where_the_ticks_say():
    values = 3 + 20 * np.sin(TIME)
    text = draw_stacked_panels(TIME, [Timeline([TimelineLine(values, "a", "first")], "deg", "A title")], "about")
    ((way, _),) = paths(text)
    found = points(way)
    ticks = re.findall(r'<text x="([\d.]+)" y="([\d.]+)" text-anchor="(middle|end)">([−\d.]+)</text>', text)
    across = np.array([[float(x), float(t)] for x, _, kind, t in ticks if kind == "middle"])
    upward = np.array([[float(y) - 4, float(t.replace("−", "-"))] for _, y, kind, t in ticks if kind == "end"])
    for place, expected, along in ((found[:, 0], TIME, across), (found[:, 1], values, upward)):
        assert len(along) > 3
        np.testing.assert_allclose(np.polyval(np.polyfit(*along.T, 1), place), expected, atol=1e-3 * np.ptp(expected))


def test_lines_are_broken_where_they_have_no_value():
    values = np.where(abs(TIME - 2) < 0.5, np.nan, TIME)
    ((way, _),) = paths(draw_stacked_panels(TIME, [Timeline([TimelineLine(values, "a")], "", "")], ""))
    assert way.count("M") == 2
    assert len(points(way)) == np.isfinite(values).sum()


def figures():
    lines = [TimelineLine(np.sin(TIME + k), f"joint $ <{k}>") for k in range(9)]
    return [
        Timeline(lines, "rad", "A title", (1.0, 2.0)),
        Timeline(
            [TimelineLine(1e-6 + TIME**4, "off", "first"), TimelineLine(np.ones(50), "cap", "compared")], "mm", "b", (), "log"
        ),
        Timeline([TimelineLine(TIME**7 - 1, "c", "second")], "N m", "c", (), "symlog", 0.1),
        Timeline([TimelineLine(0 * TIME, "zero", "first")], "mm", "d", (), "log"),
    ]


@pytest.mark.parametrize("drawn", [draw_stacked_panels, draw_small_multiples])
@pytest.mark.parametrize("count", [1, 2, 4])
def test_everything_is_drawn_once_and_inside(drawn, count):
    text = drawn(TIME, figures()[:count], 'It\'s "about" <this>')
    check(f"<html>{text}</html>")
    assert text.count("algorithmic singularity") == 1
    assert text.count("joint $ &lt;8&gt;") == 1
    assert "time, s" in text
    width, height = map(float, re.search(r'viewBox="0 0 (\d+) (\d+)"', text).groups())
    ways = paths(text)
    assert len(ways) == sum(len(p.lines) for p in figures()[:count])
    for way, _ in ways:
        assert (points(way) > 0).all()
        assert (points(way) < [width, height]).all()
    for x, y in re.findall(r'<text x="([^"]+)" y="([^"]+)"', text):
        assert 0 < float(x) < width
        assert 0 < float(y) < height


@pytest.mark.parametrize("drawn", [draw_stacked_panels, draw_small_multiples])
def test_lines_of_a_panel_can_be_told_apart(drawn):
    text = drawn(TIME, figures()[:1], "about")
    looks = re.findall(r'<path d="M[^"hvHV]+" (fill="none" stroke="[^/]+)/>', text)
    assert len(looks) == len(set(looks)) == 9


def test_long_names_leave_room_for_the_lines():
    lines = [TimelineLine(TIME, "x" * 200), TimelineLine(-TIME, "y")]
    ((way, _), *_) = paths(draw_stacked_panels(TIME, [Timeline(lines, "", "t" * 300)], ""))
    assert np.ptp(points(way)[:, 0]) > 300
