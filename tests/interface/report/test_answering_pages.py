"""What pages do beyond being read: thresholds that move, poses that are pointed at, sorting, themes, keyboard, paper."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import numpy as np
import pytest
from markupsafe import Markup
from matplotlib.figure import Figure

import axe
import chromium
import holdfast as hf
from holdfast.core.formatting import format_interval, insert_nonbreaking_spaces
from holdfast.interface.presentation.arm.view import scene
from holdfast.interface.report import figures
from holdfast.interface.report.page import Callout, Code, Page, Picture, Section, Table, write

NINE = hf.arms.load("pa10-9dof")
REGION = hf.Region.box([0.968, 0, 0.041], 0.5, np.deg2rad([0, 174, 0]), np.deg2rad([90, 90, 90]))
CELLS = ["2 b", "1 a", "10 c", "3 d"]
NUMBERS: list[str | Markup] = [Markup("−1.5<br>900"), "1,200 (3 to 4)", "–", "<0.1 %"]


@pytest.fixture(scope="module")
def found() -> hf.Assessment:
    return hf.assess(NINE, REGION, poses=160, seed=1, optimise=True)


@pytest.fixture(scope="module")
def browser():
    with chromium.opened(chromium.required, scenes=True) as opened:
        yield opened


@pytest.fixture(scope="module")
def report(browser, found, tmp_path_factory):
    file = found.report(tmp_path_factory.mktemp("page") / "report.html")
    page = browser.new_page(viewport={"width": 1200, "height": 900})
    page.on("pageerror", lambda error: pytest.fail(str(error)))
    page.goto(file.as_uri())
    return page


@pytest.fixture
def small(browser, tmp_path):
    table = Table([[a, b] for a, b in zip(CELLS, NUMBERS, strict=True)], ["name", "number"], frozenset({1}))
    blocks = [table, Table([["key", "value"]]), Code("holdfast arms"), Callout("bad", "bad"), Callout("good", "good")]
    numbers = [("0.2", "median"), ("15 %", "left")]
    page = Page("t", "h", [Section("One", blocks), Section("Two", [Table([["a", "b"]])])], facts=numbers, again="holdfast arms")
    opened = browser.new_page()
    opened.goto(write(page, tmp_path / "small.html").as_uri())
    yield opened
    opened.close()


def moved(page, kind: str, read: str) -> list:
    """What ``read``, of the box, is at every step of the slider of an extra."""
    return page.evaluate(
        """([kind, read]) => {
            const box = document.querySelector(`[data-extra="${kind}"]`), slider = box.querySelector("input");
            const get = new Function("box", "return " + read);
            return Array.from({length: Number(slider.max) + 1}, (_, k) => {
                slider.value = k;
                slider.dispatchEvent(new Event("input"));
                return get(box);
            });
        }""",
        [kind, read],
    )


def test_a_threshold_has_the_answers_that_python_gives(report, found):
    asked = [float(x) for x in moved(report, "threshold", "box.querySelector('.asked').textContent")]
    assert len(asked) > 50
    assert asked == sorted(asked)
    assert 0.29 in asked  # half of the bound, sqrt(3 / 9)
    shown = moved(report, "threshold", "[...box.querySelectorAll('[data-row]')].map(x => x.textContent)")
    expected = [[format_interval(found.interval(at_least=x, optimised=o)) for o in (False, True)] for x in asked]
    assert shown == [[insert_nonbreaking_spaces(text) for text in texts] for texts in expected]


def test_no_option_of_a_command_is_broken_behind_its_hyphens(report):
    """Each has its own line, or stays on one, however narrow the page is; the text is what it was."""
    lines = report.evaluate("""() => {
        document.body.style.width = "330px";
        const found = [...document.querySelectorAll("pre .option")].map(x => [x.textContent, x.getClientRects().length]);
        document.body.style.width = "";
        return found;
    }""")
    assert {"--poses", "--seed", "--optimise"} <= {name for name, _ in lines}
    assert {count for _, count in lines} == {1}


def test_a_threshold_names_the_worst_joints_and_moves_its_line(report, found):
    failed = found.dataset["by_failure"].values
    failed = failed[np.isfinite(failed).all(axis=1)]
    asked = [float(x) for x in moved(report, "threshold", "box.querySelector('.asked').textContent")]
    bars = "[...box.querySelectorAll('.bars li')].map(x => [...x.querySelectorAll('.name, .part')].map(y => y.textContent))"
    for k, shown in list(enumerate(moved(report, "threshold", bars)))[::9]:
        missed = {f"{j + 1}  {name}": 100 * (failed[:, j] < asked[k]).mean() for j, name in enumerate(NINE.joint_names)}
        assert [float(part[:-2]) for _, part in shown] == sorted([float(p[:-2]) for _, p in shown], reverse=True)
        for name, part in shown:
            assert abs(missed[name] - float(part[:-2])) < 0.051
    line = "document.querySelector('.threshold-line').getBBox().x"
    at = np.array(moved(report, "threshold", line))
    assert np.ptp(np.diff(at) / np.diff(asked)) < 1e-2 * np.diff(at).mean() / np.diff(asked).mean()


def test_a_pose_says_its_index_its_worst_joint_and_the_command_that_opens_it(report, found):
    data = found.dataset
    told = moved(report, "poses", "[box.querySelector('.told').textContent, box.querySelector('pre').lastChild.textContent]")
    assert len(told) == int(np.isfinite(data["index"].values).sum())
    values = []
    for text, command in told:
        row = int(re.match(r"Pose ([\d,]+): index ([\d.e+-]+), worst if (\d+) ", text)[1].replace(",", "")) - 1
        index = float(data["index"].values[row])
        worst = int(data["by_failure"].values[row].argmin())
        assert f"index {float(f'{index:.3g}'):g}, worst if {worst + 1} {NINE.joint_names[worst]} locks" in text
        words = shlex.split(command)
        assert words[:3] == ["holdfast", "studio", "pa10-9dof"]
        assert words[-2:] == ["--lock", NINE.joint_names[worst]]
        q = next(word for word in words if word.startswith("--q=")).removeprefix("--q=")
        np.testing.assert_allclose([float(x) for x in q.split(",")], data["q"].values[row], rtol=0, atol=2e-6)
        values.append(index)
    assert values == sorted(values)


def test_poses_are_pointed_at_pinned_and_reached_with_the_keyboard(report):
    box = report.locator("[data-extra=poses]")
    slider, told = box.locator("input"), box.locator(".told")
    slider.focus()
    report.keyboard.press("Home")
    first = told.text_content()
    report.keyboard.press("ArrowRight")
    second = told.text_content()
    assert second != first
    ring = report.locator(".picked").first
    places = []
    for key in ("End", "Home"):
        slider.press(key)
        at = ring.bounding_box()
        places.append((told.text_content(), at["x"] + at["width"] / 2, at["y"] + at["height"] / 2))
    (last, *there), (_, *here) = places
    report.mouse.click(*there)
    assert told.text_content() == last
    assert "pinned" in ring.get_attribute("class")
    report.mouse.move(*here)
    assert told.text_content() == last
    report.mouse.click(*there)  # lets go
    assert "pinned" not in ring.get_attribute("class")
    report.mouse.move(*here)
    assert told.text_content() == first


def test_the_arm_in_three_dimensions_takes_the_pose_that_is_chosen(report, found):
    box = report.locator("[data-extra=poses]")
    box.locator("input").press("End")
    command = box.locator("pre").text_content()
    q = [float(x) for x in re.search(r"--q=(\S+)", command)[1].split(",")]
    shown = report.evaluate("document.getElementById('arm').view3d.configurations()")
    np.testing.assert_allclose(shown, [q], atol=1e-5)
    report.evaluate("document.getElementById('arm').dispatchEvent(new CustomEvent('view3d:point', {detail: 3}))")
    third = np.sort(found.dataset["index"].values)[3]
    assert f"index {float(f'{third:.3g}'):g}, " in box.locator(".told").text_content()


BUSY = "setInterval(() => { const t = performance.now(); while (performance.now() - t < 25); }, 30);"


def test_play_plays_every_time_also_on_a_busy_page(browser, tmp_path):
    """While a page is busy, the first frame after a click carries a time from before the click."""
    time = np.linspace(0, 2, 11)
    view = scene(hf.arms.load("planar-3r"), np.stack([time, 0 * time, time], axis=1), time=time)
    file = write(Page("t", "h", [Section("", [Picture(view.to_html("motion", "An arm"), "c")])]), tmp_path / "motion.html")
    opened, errors = browser.new_page(viewport={"width": 240, "height": 300}), []
    opened.on("pageerror", lambda error: errors.append(str(error)))
    opened.add_init_script(BUSY)
    opened.goto(file.as_uri())
    slider, button = opened.locator("#motion input"), opened.locator("#motion button").first
    for _ in range(3):
        button.click()
        opened.wait_for_function("() => document.querySelector('#motion input').value > 0")
        button.click()
        assert button.inner_text() == "Play"
        slider.fill("0")
    button.click()
    opened.wait_for_function("() => document.querySelector('#motion button').textContent === 'Play'")
    assert slider.input_value() == "10"
    assert not errors
    opened.close()


def test_where_the_axes_are_in_the_svg():
    """Matplotlib itself writes where it draws a marker."""
    figure = Figure(figsize=(5, 3))
    axes = figure.add_subplot()
    axes.plot([0.3], [7.0], "o")
    axes.set(xlim=(0.1, 10), ylim=(5, 8), xscale="log")
    frame = figures.locate_axes(figures.settle_layout(figure).axes[0])
    markers = re.findall(r'<use [^>]*x="([\d.]+)" y="([\d.]+)"', str(figures.svg(figure, "a", "b")))
    left, top, right, bottom = frame["box"]
    part = np.log(0.3 / 0.1) / np.log(10 / 0.1)
    expected = [left + part * (right - left), bottom - (7 - 5) / (8 - 5) * (bottom - top)]
    assert frame["log"]
    assert min(np.abs(np.array(m, float) - expected).max() for m in markers) < 0.01


@pytest.mark.parametrize("kind", ["light 1200", "dark 390"])
def test_nothing_serious_stands_in_the_way(report, small, kind):
    scheme, width = kind.split()
    for page in (report, small):
        page.emulate_media(color_scheme=scheme)
        page.set_viewport_size({"width": int(width), "height": 900})
        assert axe.serious(page) == []
        assert page.evaluate("document.documentElement.scrollWidth") <= int(width)


def column(page, k: int) -> list[str]:
    texts = page.locator("table.sortable tbody tr").evaluate_all("(rows, k) => rows.map(row => row.cells[k].textContent)", k)
    return [text.replace("\u00a0", " ") for text in texts]


def test_tables_are_sorted_by_their_heads(small):
    small.locator("th button", has_text="name").click()
    assert column(small, 0) == ["1 a", "2 b", "3 d", "10 c"]
    assert small.locator("th[aria-sort=ascending]").text_content() == "name"
    number = small.locator("th button", has_text="number")
    number.press("Enter")
    assert column(small, 1) == ["1,200 (3 to 4)", "<0.1 %", "−1.5900", "–"]
    assert small.locator("th[aria-sort=descending]").text_content() == "number"
    number.press("Enter")
    assert column(small, 1) == ["−1.5900", "<0.1 %", "1,200 (3 to 4)", "–"]  # nothing is last either way
    number.press("Enter")
    assert column(small, 0) == CELLS
    assert small.locator("table.sortable").count() == 1  # not the one without a head


def test_the_theme_is_the_systems_until_it_is_chosen(small):
    small.emulate_media(color_scheme="dark")
    colour = "getComputedStyle(document.body).backgroundColor"
    dark = small.evaluate(colour)
    small.locator(".theme").click()
    assert small.evaluate(colour) == "rgb(255, 255, 255)" != dark
    assert small.evaluate("localStorage.getItem('holdfast-theme')") == "light"
    small.add_init_script("localStorage.setItem('holdfast-theme', 'light')")  # the browser writes when it likes
    small.reload()
    assert small.evaluate(colour) == "rgb(255, 255, 255)"
    assert small.locator(".theme").text_content() == "Dark theme"
    small.locator(".theme").click()
    small.emulate_media(media="print")
    assert small.evaluate(colour) == "rgb(255, 255, 255)"  # paper is white


def test_contents_lead_to_the_sections_and_stay_in_sight(report):
    report.set_viewport_size({"width": 390, "height": 800})
    report.locator("nav a", has_text="Repeat this run").click()
    report.wait_for_url("**#again")
    top = report.locator("#again").bounding_box()["y"]
    assert report.locator("nav").bounding_box()["height"] <= top < 800
    assert report.locator("nav a[aria-current]").text_content() == "Repeat this run"


def test_on_paper_tables_are_whole_and_pages_have_numbers(small):
    small.emulate_media(media="print")
    style = "x => { const s = getComputedStyle(x); return [s.breakInside, s.display]; }"
    assert {small.locator("table").nth(k).evaluate(style)[0] for k in range(3)} == {"avoid"}
    assert small.locator("tbody tr").first.evaluate(style)[0] == "avoid"
    assert small.locator("thead").evaluate(style)[1] == "table-header-group"
    assert not small.locator("nav").is_visible()
    rules = small.evaluate("[...document.styleSheets[0].cssRules].map(x => x.cssText).join()")
    assert "counter(page)" in rules


def test_without_javascript_everything_but_the_extras_is_there(browser, report):
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto(report.url.partition("#")[0])
    assert page.locator(".extra:visible, .theme:visible, th button").count() == 0
    assert page.locator("section:visible").count() == page.locator("section").count() > 8
    assert page.locator("nav a").count() > 8
    context.close()


def luminance(colour: str) -> float:
    """WCAG 2.2, relative luminance."""
    digits = colour[1:] if len(colour) == 7 else "".join(2 * x for x in colour[1:])
    parts = np.array([int(digits[k : k + 2], 16) / 255 for k in (0, 2, 4)])
    linear = np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)
    return float(linear @ [0.2126, 0.7152, 0.0722])


def test_text_stands_out_in_both_themes():
    """Axe looks away where a background is a gradient, as behind every table."""
    css = (Path(figures.__file__).parent / "templates/page.css").read_text()
    pairs = re.findall(r"--(\w+): light-dark\((#\w+), (#\w+)\)", css)
    for theme in (0, 1):
        colour = {name: luminance(both[theme]) for name, *both in pairs if len(both[theme]) in (4, 7)}
        for text in ("ink", "soft", "blue", "red", "green"):
            for behind in ("paper", "wash", "bad", "good") if text == "ink" else ("paper", "wash"):
                low, high = sorted([colour[text], colour[behind]])
                assert (high + 0.05) / (low + 0.05) >= 4.5, (text, behind, theme)
    for text in (figures.INK, figures.SOFT):
        assert 1.05 / (luminance(text) + 0.05) >= 4.5
