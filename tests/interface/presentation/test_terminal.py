"""What people read in windows of any width: nothing is cut, no word is broken, numbers are in line."""

from __future__ import annotations

import io
from itertools import chain

import hypothesis.strategies as st
import pytest
from hypothesis import given, settings

from holdfast.interface.presentation.printing import format_column
from holdfast.interface.presentation.terminal import BandedTable, WrappingConsole

CELLS = [
    ["pseudoinverse", "joint1", "70.0 %", "45.7 % to 88.1 %", "1.234"],
    ["failure-tolerant:0.5", "any joint", "100.0 %", "83.2 % to 100 %", ""],
]
HEAD = ["law", "locked", "converged", "95 % interval", "end error, m"]


def shown(grid, width):
    out = io.StringIO()
    screen = WrappingConsole()
    screen.file, screen.width = out, width
    screen.print(grid)
    return out.getvalue().splitlines()


def grid(head=HEAD, rows=CELLS):
    made = BandedTable(*head)
    for row in rows:
        made.add_row(*row)
    return made


@pytest.mark.parametrize("width", [140, 80, 72, 60, 44])
def test_every_word_is_there_whole(width):
    lines = shown(grid(), width)
    assert max(map(len, lines)) <= width
    assert set(" ".join([*HEAD, *chain(*CELLS)]).split()) <= set(" ".join(lines).split())


TEXTS = st.text("ab1. -", max_size=14).map(lambda text: " ".join(text.split()))


@given(st.lists(st.lists(TEXTS, min_size=3, max_size=3), min_size=1, max_size=4), st.integers(14, 60))
@settings(max_examples=60)
def test_no_width_breaks_a_word(rows, width):
    head = ["name", "value", "a longer head"]
    lines = shown(grid(head, rows), width)
    assert set(" ".join([*head, *chain(*rows)]).split()) <= set(" ".join(lines).split())


def test_a_table_that_is_too_wide_comes_in_bands_that_name_the_row():
    lines = shown(grid(), 50)
    assert [line.split()[0] for line in lines] == ["law", "pseudoinverse", "failure-tolerant:0.5"] * 3
    assert all("joint" in line for line in lines if not line.startswith("law"))


def test_numbers_end_where_their_heads_end_and_names_begin_where_theirs_begin():
    first, second, third = shown(grid(), 140)
    for word, one, two in (("converged", "70.0 %", "100.0 %"), ("interval", "to 88.1 %", "to 100 %")):
        assert first.index(word) + len(word) == second.index(one) + len(one) == third.index(two) + len(two)
    assert first.index("locked") == second.index("joint1") == third.index("any")


def test_one_precision_in_a_column():
    assert format_column([22.021, -0.6338462, 0.0, float("nan")]) == ["22.02", "-0.63", "0.00", "none"]
    assert format_column([22.021, 0.006338]) == ["22.0210", "0.0063"]
    assert format_column([1.5, 90.0, -12.25], ["m", "deg", "deg"]) == ["1.500 m", "90.00 deg", "-12.25 deg"]
    assert format_column([2.248e-08, 0.8039]) == ["2.248e-08", "0.8039"]  # of sizes that have none


@pytest.mark.parametrize(("terminal", "lines"), [(True, 3), (False, 1)])
def test_a_sentence_is_wrapped_between_words_where_a_window_would_cut_it(terminal, lines):
    out = io.StringIO()
    screen = WrappingConsole()
    screen.file, screen._force_terminal, screen.width = out, terminal, 20
    screen.print("The end effector stays on its path all the time", soft_wrap=True)
    found = out.getvalue().splitlines()
    assert len(found) == lines
    assert " ".join(" ".join(found).split()) == "The end effector stays on its path all the time"


def test_colours_are_for_a_terminal_that_wants_them(monkeypatch):
    def written(**environment):
        with monkeypatch.context() as patch:
            for name in ("NO_COLOR", "FORCE_COLOR", "TERM", "COLORTERM"):
                patch.delenv(name, raising=False)
            for name, value in environment.items():
                patch.setenv(name, value)
            screen = WrappingConsole()
            screen.file = out = io.StringIO()
            screen.print("[yellow]not finished[/]")
        return out.getvalue()

    assert written() == "not finished\n"
    assert "\x1b[33m" in written(FORCE_COLOR="1", TERM="xterm")
    assert "\x1b[33m" not in written(FORCE_COLOR="1", TERM="xterm", NO_COLOR="1")
