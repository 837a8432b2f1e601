"""Pages are well-formed, self-contained and escape what they are given; figures leave the caller's settings alone."""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.figure import Figure

from holdfast.core.errors import StoreError
from holdfast.core.formatting import (
    format_as_given,
    format_count,
    format_decimals,
    format_number,
    format_percent,
    format_share,
    indefinite_article,
    list_alternatives,
)
from holdfast.core.result import Result
from holdfast.interface import presentation
from holdfast.interface.presentation.presentation import FigureSpec, Presentation
from holdfast.interface.report import (
    Bin,
    Callout,
    Code,
    Curve,
    Mark,
    Page,
    Picture,
    Scale,
    Scene,
    Section,
    Table,
    Text,
    View,
    bar_figure,
    cdf_figure,
    distribution_figure,
    map_figure,
    render,
    save_png,
    svg,
    view_figure,
    write,
)
from holdfast.interface.report.figures import format_label
from wellformed import check

NASTY = '<script>alert("x")</script> & $\\frac$'


def some_figures() -> list[Figure]:
    rng = np.random.default_rng(0)
    x = np.linspace(0, 1, 50)
    curves = [Curve(x, x, "all", band=0.1), Curve(x, x**2, "some", second=True)]
    marks = [Mark(0.3, "asked for"), Mark(0.9, "most", "bound")]
    points, values = rng.random((300, 3)), rng.random(300)
    views = [View(np.eye(3)[0], np.eye(3)[2], "Side"), View(np.eye(3)[0], np.eye(3)[1], "Top")]
    chain = np.array([[0, 0, 0], [0, 0, 1], [0, 0, 1.0], [1, 0, 1]])
    scene = Scene(
        points,
        values,
        points[:5] + 1,
        chain=chain,
        square=np.array([True, False]),
        box=np.array([[0, 0, 0], [1, 1, 1.0]]),
    )
    return [
        cdf_figure(curves, marks, "value", ylabel="share"),
        distribution_figure(
            Bin(x[::7], np.ones(7), "density"),
            curves,
            marks,
            xlabel="value",
            ylabel="share",
            titles=("a", "b"),
        ),
        bar_figure([NASTY, "two"], [3, 0], "times"),
        bar_figure(["none"], [0], "times"),
        view_figure(
            scene,
            views,
            Scale.from_values(values),
            label="value",
            legend=[("dot", "point"), ("slide", "slider"), ("cross", "none")],
        ),
        view_figure(
            Scene(points[:0], values[:0], points[:0]),
            views[:1],
            Scale.from_values(values[:0]),
            label="value",
            legend=[("box", "box")],
        ),
        map_figure(
            points,
            {"found": values, "best": np.where(values < 0.1, np.nan, values + 1)},
            views,
            log=False,
            smaller_is_better=False,
            label="mean",
        ),
        map_figure(points, {"found": 10 ** (6 * values)}, views[:1], log=True, smaller_is_better=True, label="median"),
        map_figure(points, {"found": np.full(300, np.inf)}, views[:1], log=True, smaller_is_better=True, label="median"),
    ]


def test_a_page_of_everything() -> None:
    pictures = [Picture(svg(f, f"f{k}", NASTY), NASTY) for k, f in enumerate(some_figures())]
    table = Table([[NASTY, "1"], ["b", "2"]], ["name", "number"], frozenset({1}), caption=NASTY)
    keys = Table([["key", NASTY]])
    blocks = [Text(NASTY), Callout(NASTY, "bad", NASTY), table, keys, Code(NASTY, NASTY), *pictures]
    html = render(Page(NASTY, NASTY, [Section(NASTY, blocks)], subtitle=NASTY, warnings=[Callout(NASTY)], footer=NASTY))
    assert {"svg", "table", "pre"} <= check(html).tags
    assert "&lt;script&gt;" in html
    assert 'class="number">2<' in html


def test_figures_are_the_same_every_time_and_leave_settings_alone() -> None:
    with mpl.rc_context({"axes.facecolor": "black", "lines.linewidth": 9, "font.size": 30}):
        before = dict(mpl.rcParams)
        odd = [svg(f, "a", "b") for f in some_figures()[1:5]]
        assert dict(mpl.rcParams) == before
    assert odd == [svg(f, "a", "b") for f in some_figures()[1:5]]


def test_png(tmp_path: Path) -> None:
    path = save_png(bar_figure(["a"], [1], "b"), tmp_path / "a.png")
    assert path.read_bytes().startswith(b"\x89PNG")
    with pytest.raises(StoreError, match=r"cannot write picture .*No such file"):
        save_png(bar_figure(["a"], [1], "b"), tmp_path / "no" / "a.png")


class Told(Result):
    """A result without a presenter of its own."""

    def __init__(self) -> None:
        self.asked = 0

    def describe(self) -> list[str]:
        return ["The answer.", "More."]

    def draw(self) -> Figure:
        self.asked += 1
        return bar_figure(["a"], [1], "b")


def present(told: Told) -> Presentation:
    return Presentation("Told", "The answer.", lines=["More."], figures={"bars": FigureSpec(told.draw)})


def test_a_folder_and_its_page_hold_the_same_figure_drawn_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(presentation.PRESENTER_MODULES, f"{Told.__module__}.Told", "told_presenter")
    monkeypatch.setitem(sys.modules, "holdfast.interface.presentation.told_presenter", sys.modules[__name__])
    told = Told()
    picture, page = told.save(tmp_path, command="holdfast arms", dpi=150)
    assert told.asked == 1
    assert int.from_bytes(picture.read_bytes()[16:20]) == 1200  # 8 inches
    html = page.read_text(encoding="utf-8")
    check(html)
    assert str(svg(told.draw(), "bars", "Told: results")) in html
    assert html.index("The answer.") < html.index("More.") < html.index("<svg") < html.index("<pre>holdfast arms")


def test_writing_is_all_or_nothing(tmp_path: Path) -> None:
    page = Page("title", "\ud800 headline", [])
    path = write(page, tmp_path / "a.html")
    assert [p.name for p in tmp_path.iterdir()] == ["a.html"]
    assert path.stat().st_mode & 0o444 == 0o444
    check(path.read_text(encoding="utf-8"))
    folder = tmp_path / "folder"
    folder.mkdir()
    for bad in (folder, tmp_path / "no" / "a.html", path / "a.html"):
        with pytest.raises(StoreError, match=r"^cannot write report '[^\n]*; choose another path$"):
            write(page, bad)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.html", "folder"]


def test_words() -> None:
    assert [format_number(x) for x in (0.0, 1e-16, 0.20511, -0.5, 8.1e-4, 62.56, 1784.2, 2e8, np.inf, np.nan)] == [
        *("0", "0", "0.205", "−0.500", "8.1e−4", "62.6", "1,784", "2.0e8", "∞", "–")
    ]
    assert [format_percent(x) for x in (0, 1e-5, 0.0725, 0.99999, 1)] == ["0 %", "<0.1 %", "7.2 %", ">99.9 %", "100 %"]
    assert (format_decimals(-0.0001, 3), format_as_given(0.29), format_count(1, "pose"), format_count(2000, "pose")) == (
        "0.000",
        "0.29",
        "1 pose",
        "2,000 poses",
    )
    assert (
        indefinite_article("index"),
        indefinite_article("manipulability"),
        list_alternatives(["a"]),
        list_alternatives(["a", "b", "c"]),
    ) == (
        "an",
        "a",
        "a",
        "a, b or c",
    )
    # Clopper and Pearson, 145 of 2000: half of 5 % of the probability is beyond the count at 0.06152 and at 0.08477
    assert format_share(145, 2000) == "145 (7.2 %, 95 % interval 6.2 to 8.5 %)"
    assert format_label("a$b$\n" + "x" * 80, 10) == "a\\$b\\$ xxxx…"
