"""Tables of reports fit where they are read: on a screen, and on a sheet of A4."""

from __future__ import annotations

import pytest
from markupsafe import Markup

import chromium
from holdfast.interface.report.page import Page, Section, Table, write

NAMES = [f"manufacturer_of_arms_joint_{k}" for k in range(1, 10)]
SHARE = Markup('0.446 <span class="quiet">0.358 to 0.539</span>')
TABLES = [
    # As in a study of several laws, an assessment of nine joints, a search of eight parameters, a table of worst failures.
    Table(
        [
            ["panda", "failure-tolerant:0.5", "pose", SHARE, "−0.018 (−0.121 to 0.086)", f"{name}: 0.000", SHARE]
            for name in NAMES
        ],
        ["Arm", "law", "task", "converges", "gain over the first law", "worst joint", "converges, none locked"],
        frozenset({3, 4, 6}),
        wide=True,
    ),
    Table(
        [["pose (this run)", "3", *["fatal"] * 9, "single point of failure"]],
        ["Task", "Redundancy", *map(str, range(1, 10)), "Single point of failure"],
        frozenset({1}),
        wide=True,
    ),
    Table(
        [["best", "1.562", "0.632", "100 %", *["−0.0926"] * 8]],
        ["", "reach, m", "guaranteed", "poses reached", *[f"alpha{k}, deg" for k in range(8)]],
        frozenset(range(1, 12)),
        wide=True,
    ),
    Table(
        [
            [f"{k} {name}", "0.562", "0.222", "15.3 %", "0.963", "0.473", "0.281", "0 %", "0.996"]
            for k, name in enumerate(NAMES)
        ],
        [
            "If this locks",
            *(f"{when}{what}" for when in ("", "after: ") for what in ("median", "5 % quantile", "worst", "P(≥ 0.1)")),
        ],
        frozenset(range(1, 9)),
    ),
]
BEYOND = "() => [...document.querySelectorAll('.scroll')].map(x => x.scrollWidth - x.clientWidth)"


@pytest.fixture(scope="module")
def opened(tmp_path_factory):
    file = write(Page("t", "h", [Section("s", TABLES)]), tmp_path_factory.mktemp("page") / "tables.html")
    with chromium.opened(chromium.required) as browser:
        page = browser.new_page()
        page.goto(file.as_uri())
        yield page


@pytest.mark.parametrize(("media", "width"), [("screen", 1100), ("screen", 900), ("print", 688)])  # A4 without its margins
def test_no_table_is_cut(opened, media, width):
    opened.emulate_media(media=media)
    opened.set_viewport_size({"width": width, "height": 900})
    assert opened.evaluate(BEYOND) == [0] * len(TABLES)


def test_numbers_stay_whole_and_names_can_still_be_found(opened):
    opened.emulate_media(media="print")
    opened.set_viewport_size({"width": 688, "height": 900})
    words = opened.inner_text("main").split()
    assert words.count("−0.0926") == 8
    assert f"{NAMES[4]}:" in words


def test_where_there_is_no_room_a_table_scrolls_and_the_page_does_not(opened):
    opened.emulate_media(media="screen")
    opened.set_viewport_size({"width": 390, "height": 800})
    assert max(opened.evaluate(BEYOND)) > 0
    assert opened.evaluate("() => document.documentElement.scrollWidth") <= 390
