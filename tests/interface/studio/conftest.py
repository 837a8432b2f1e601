"""A studio on a free port, and a headless Chromium that looks at it."""

from __future__ import annotations

import pytest
from studio_pages import wait_for

import chromium
from holdfast import arms


# Not for the whole session: Playwright keeps an event loop running, and other tests begin their own.
@pytest.fixture(scope="module")
def browser():
    """A running headless Chromium."""
    with chromium.opened(chromium.required, scenes=True) as opened:
        yield opened


@pytest.fixture
def studio():
    """``studio(name, **state)``: a page that is served until the test ends."""
    from holdfast.interface.studio import State, serve

    open_pages = []

    def make(name, arm=None, **state):
        model = arm if arm is not None else arms.load(name)
        q = state.pop("q", None)
        home = arms.about(name).home if q is None else q
        page = serve(model, State(name, model.joint_names, tuple(float(x) for x in home), **state), port=0)
        open_pages.append(page)
        return page

    yield make
    for page in open_pages:
        page.stop()


# Scenes are drawn by the processor, whether or not anything moves: sixty times a second they keep one busy.
FEW_FRAMES = """
const whole = window.requestAnimationFrame.bind(window);
window.requestAnimationFrame = (draw) => window.setTimeout(() => whole(draw), 250);
window.cancelAnimationFrame = window.clearTimeout.bind(window);
"""


@pytest.fixture
def visit(browser):
    """``visit(studio)``: a page that has opened it, and the window behind that page."""
    contexts = []

    def go(served, width=640, height=440, **options):
        before = set(served.windows)
        context = browser.new_context(viewport={"width": width, "height": height}, accept_downloads=True, **options)
        contexts.append(context)
        context.add_init_script(FEW_FRAMES)
        page = context.new_page()
        page.set_default_timeout(60_000)
        page.hosts = set()
        page.on("request", lambda r: page.hosts.add(r.url.split("/")[2]) if "://" in r.url and r.url[:4] != "blob" else None)
        page.on("websocket", lambda w: page.hosts.add(w.url.split("/")[2]))
        page.goto(served.url)
        wait_for(page, lambda: set(served.windows) - before)
        window = served.windows[max(set(served.windows) - before)]
        assert window.wait_until_done(60)
        return page, window

    yield go
    for context in contexts:
        context.close()
