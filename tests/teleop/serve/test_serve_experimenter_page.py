"""The experimenter's page in a browser: a simulated operator drives the real page of a station, and is watched."""

import shutil
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from serve_program import KEY

from conftest import PROGRAM
from holdfast.teleop.entries import State
from holdfast.teleop.protocol import read
from holdfast.teleop.records import Records
from holdfast.teleop.serve.app import STATIC
from holdfast.teleop.serve.texts import ENGLISH

playwright = pytest.importorskip("playwright.sync_api")
CHROMIUM = shutil.which("chromium")
FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-background-networking"]

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="needs Chromium")


@pytest.fixture(scope="module")
def browser():
    with playwright.sync_playwright() as p:
        opened = p.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield opened
        opened.close()


@pytest.fixture(scope="module")
def served(tmp_path_factory):
    """(folder, address) of an experiment with a long training of short ways."""
    folder = tmp_path_factory.mktemp("served") / "study"
    whole = read()
    few = whole.with_tasks(whole.tasks.take(np.array([0, 9, 21])), ["a", "b", "c"])
    training = replace(whole.training, at_least=40, in_a_row=1, distance=0.4)
    Records.create(folder, replace(few, training=training)).close()
    command = [sys.executable, str(PROGRAM), str(folder), str(STATIC), str(ENGLISH)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        yield folder, f"http://127.0.0.1:{int(process.stdout.readline())}"
        process.kill()


@pytest.fixture
def context(browser):
    with browser.new_context(viewport={"width": 1280, "height": 720}) as made:
        made.set_default_timeout(120_000)
        yield made


def test_addresses_of_what_opens_in_a_tab(context, served):
    _, base = served
    page = context.new_page()
    page.goto(f"{base}/experimenter?key={KEY}")
    at = page.get_by_test_id
    assert at("export").get_attribute("href") == f"{base}/experimenter/export.zip?key={KEY}"
    at("report-missing").select_option("mixed")
    assert at("report").get_attribute("href") == f"{base}/experimenter/report?missing=mixed&key={KEY}"
    at("robot-seed").fill("7")
    assert at("dry-run").get_attribute("href") == f"{base}/?robot=7"
    for link in ("export", "report", "dry-run"):
        assert at(link).get_attribute("rel") == "noopener"
    page.goto(f"{base}/experimenter?key=wrong")
    assert "key is missing or wrong" in page.text_content("body")


def test_an_experiment_is_watched_and_led(context, served):
    folder, base = served
    asked, troubles = [], []
    context.on("request", lambda request: asked.append(request.url))
    context.on("weberror", lambda error: troubles.append(str(error.error)))
    context.on("console", lambda message: troubles.append(message.text) if message.type == "error" else None)
    page = context.new_page()
    page.goto(f"{base}/experimenter?key={KEY}")
    at = page.get_by_test_id
    assert at("folder").text_content() == str(folder.resolve())
    page.locator("[data-testid=connection][data-online=true]").wait_for()

    with context.expect_page() as opened:
        at("dry-run").click()
    robot = opened.value
    row = page.locator("[data-testid=row-S01][data-connected=true]")
    row.wait_for()
    assert "simulated" in row.text_content()

    # The first who steers is shown, in the same windows as at the station.
    page.locator("[data-testid=live][data-steering=true]").wait_for()
    assert at("chosen").text_content() == "Subject S01"
    assert "healthy, pseudoinverse" in at("live-what").text_content()
    for window in ("arm-1", "velocity-1"):
        inked = at(window).evaluate(
            "c => new Set(new Uint32Array(c.getContext('2d').getImageData(0, 0, c.width, c.height).data.buffer)).size"
        )
        assert inked > 10, window
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
    page.locator("[data-testid=row-S01][data-paused=true]").wait_for()
    robot.get_by_test_id("paused").wait_for()
    assert at("note").input_value() == "A chair fell over, tw"

    # The session goes on in another page, which still has to be let go on.
    at("resume").click()
    at("confirm-no").click()
    assert at("resume-url").count() == 0
    at("resume").click()
    at("confirm-yes").click()
    robot.get_by_test_id("stopped").wait_for()
    robot.goto(at("resume-url").input_value())
    robot.get_by_test_id("paused").wait_for()
    at("pause-one").click()
    page.locator("[data-testid=row-S01][data-steering=true]").wait_for()

    # The end, by keyboard only.
    at("drop").focus()
    page.keyboard.press("Enter")
    at("confirm").wait_for()
    page.keyboard.press("Escape")
    at("confirm").wait_for(state="detached")
    page.keyboard.press("Enter")
    at("confirm-yes").focus()
    page.keyboard.press("Enter")
    page.locator("[data-testid=row-S01][data-state=dropped]").wait_for()
    with Records.open(folder) as records:
        subject = records.subject("S01")
        assert (subject.state, subject.note) == (State.DROPPED, "A chair\nfell over.")

    assert troubles == []
    assert {url.split("/")[2] for url in asked} == {base.split("/")[2]}
