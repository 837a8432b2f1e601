"""The experimenter's page: a simulated operator drives the real page of a station, and is watched."""

import io
import zipfile
from dataclasses import replace
from urllib.parse import urlsplit

import numpy as np
import pytest
from PIL import Image

from holdfast.teleop.protocol.protocol import Training, read_protocol
from holdfast.teleop.records.entries import SubjectState
from holdfast.teleop.records.records import Records
from holdfast.teleop.rehearsal import simulate_experiment
from holdfast.teleop.trials.scenarios import Scenario


@pytest.fixture(scope="module")
def led(serve, tmp_path_factory):
    """Served: three who are done, for a report, and a training so long that the next one is still at it."""
    folder = tmp_path_factory.mktemp("led") / "experiment"
    whole = read_protocol()
    few = whole.with_tasks(whole.tasks.take(np.array([0, 2, 3])), ["a", "b", "c"])
    laws = [("pseudoinverse", False, {}), ("pseudoinverse", True, {}), ("damped", True, {"damping": 0.1})]
    short = replace(
        few,
        substeps=1,
        training=Training(at_least=40, in_a_row=1, limit=500.0, most=100, distance=0.4),
        scenarios=tuple(Scenario(k + 1, law, failed, options=options) for k, (law, failed, options) in enumerate(laws)),
        subjects=4,
    )
    simulate_experiment(folder, short, 3, seed=1).close()
    return serve(short, folder=folder)


@pytest.fixture
def parts(led):
    """(folder, base address, key) of it."""
    return led.folder, f"http://127.0.0.1:{led.port}", urlsplit(led.experimenter).query.removeprefix("key=")


def test_addresses_of_what_opens_in_a_tab(contexts, parts):
    _, base, key = parts
    page = contexts("Failed to load resource").new_page()  # what is refused has no icon either
    page.goto(f"{base}/experimenter?key={key}")
    at = page.get_by_test_id
    assert at("export").get_attribute("href") == f"{base}/experimenter/export.zip?key={key}"
    at("report-missing").select_option("mixed")
    assert at("report").get_attribute("href") == f"{base}/experimenter/report?missing=mixed&key={key}"
    at("robot-seed").fill("7")
    assert at("dry-run").get_attribute("href") == f"{base}/?robot=7"
    for link in ("export", "report", "dry-run"):
        assert at(link).get_attribute("rel") == "noopener"
    page.goto(f"{base}/experimenter?key=wrong")
    assert "key is missing or wrong" in page.text_content("body")


def test_an_experiment_is_watched_and_led(contexts, parts):
    folder, base, key = parts
    context = contexts("Blocked script execution")  # the report's: what subjects wrote is shown without scripts
    page = context.new_page()
    page.goto(f"{base}/experimenter?key={key}")
    at = page.get_by_test_id
    assert at("folder").text_content() == str(folder.resolve())
    page.locator("[data-testid=connection][data-online=true]").wait_for()

    with context.expect_page() as opened:
        at("dry-run").click()
    robot = opened.value
    row = page.locator("[data-testid=row-S04][data-connected=true]")
    row.wait_for()
    assert "simulated" in row.text_content()

    # The first who steers is shown, in the same windows as at the station.
    page.locator("[data-testid=live][data-steering=true]").wait_for()
    assert at("chosen").text_content() == "Subject S04"
    assert "healthy, pseudoinverse" in at("live-what").text_content()
    for window in ("arm-1", "velocity-1"):
        pixels = np.asarray(Image.open(io.BytesIO(at(window).screenshot())).convert("RGB")).reshape(-1, 3)
        assert len(np.unique(pixels, axis=0)) > 10, window
    assert page.evaluate("document.documentElement.scrollHeight <= innerHeight && document.body.scrollWidth <= innerWidth")

    # A note, and what is being typed is not overwritten by news.
    at("note").fill("A chair\nfell over.")
    at("note-save").click()
    page.locator("[data-testid=said]", has_text="saved").wait_for()
    at("note").fill("A chair fell over, tw")

    # Pause: all, then one; the station waits between trials.
    at("pause-all").click()
    at("all-paused").wait_for()
    robot.get_by_test_id("paused").wait_for()
    assert at("pause-one").is_disabled()
    at("pause-all").click()
    robot.get_by_test_id("paused").wait_for(state="hidden")
    at("pause-one").click()
    page.locator("[data-testid=row-S04][data-paused=true]").wait_for()
    robot.get_by_test_id("paused").wait_for()
    assert at("note").input_value() == "A chair fell over, tw"

    # The session has moved to another page, which is still paused.
    at("resume").click()
    at("confirm-no").click()
    assert at("resume-url").count() == 0
    at("resume").click()
    at("confirm-yes").click()
    robot.get_by_test_id("stopped").wait_for()
    robot.goto(at("resume-url").input_value())
    robot.get_by_test_id("paused").wait_for()
    at("pause-one").click()
    page.locator("[data-testid=row-S04][data-steering=true]").wait_for()

    # The end, by keyboard only.
    at("drop").focus()
    page.keyboard.press("Enter")
    at("confirm").wait_for()
    page.keyboard.press("Escape")
    at("confirm").wait_for(state="detached")
    page.keyboard.press("Enter")
    at("confirm-yes").focus()
    page.keyboard.press("Enter")
    page.locator("[data-testid=row-S04][data-state=dropped]").wait_for()
    with Records.open(folder) as records:
        subject = records.subject("S04")
        assert (subject.state, subject.note) == (SubjectState.DROPPED, "A chair\nfell over.")

    # What is there already: all tables, and the report.
    with page.expect_download(timeout=300_000) as got:
        at("export").click()
    with zipfile.ZipFile(got.value.path()) as tables:
        assert {"trials.csv", "cycles.csv", "subjects.csv", "events.csv"} <= {name.split("/")[-1] for name in tables.namelist()}
        [trials] = [name for name in tables.namelist() if name.endswith("trials.csv")]
        assert len(tables.read(trials).splitlines()) > 3 * 9
    at("report-missing").select_option("complete")
    with context.expect_page(timeout=300_000) as opened:  # it is there when the report is done
        at("report").click()
    report = opened.value
    report.locator("h1").wait_for()
    assert "subjects" in report.locator("body").inner_text()
    assert report.locator("img, svg").count() > 3
