"""A studio on a free port, and a headless Chromium that looks at it."""

from __future__ import annotations

import pytest

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
