"""The guided tour of the docs can be taken, and its pictures are in the docs."""

from __future__ import annotations

import re
from pathlib import Path

import matplotlib.image
import numpy as np
import pytest
import tour

DOCS = Path(__file__).parents[3] / "docs" / "how-to"


def coloured(file):
    """Share of the pixels of a picture that are not grey."""
    picture = matplotlib.image.imread(file)[..., :3]
    return float((np.ptp(picture, axis=2) > 0.15).mean())


def test_every_picture_of_the_tour_is_there_and_shown():
    shown = re.findall(r"\]\(studio/([^)]+)\)", (DOCS / "studio.md").read_text())
    assert sorted(shown) == sorted(p.name for p in (DOCS / "studio").glob("*.png"))
    assert all(coloured(DOCS / "studio" / name) > 0.01 for name in shown)


@pytest.fixture
def closing():
    pages = []
    yield pages
    for page in pages:
        page.stop()


def test_the_first_steps_for_the_panda(browser, closing, tmp_path):
    served, page, window = tour.panda_start(browser, tmp_path)
    closing.append(served)
    assert coloured(tmp_path / "panda-start.png") > 0.01
    assert "panda_joint4 has failed" in page.inner_text("body")
    assert window.state.failed_joints == (3,)
    page.context.close()


def test_an_arm_not_made_for_holdfast_wears_its_own_shapes(browser, closing):
    served, page, window = tour.open_page(browser, tour.CRANE, (0.1, 0.5, 0.3, 1.2, 0.4, 0.7, 0.2))
    closing.append(served)
    assert "camera.stl" in page.locator("[data-message]").first.inner_text()
    assert len(window.stage.parts) > 8
    assert sorted(window.stage.figure.joints) == list(range(7))  # all can be clicked, and painted
    page.context.close()
