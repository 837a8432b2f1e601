"""A small load: nothing is lost. ``load.py`` itself takes minutes and more stations."""

from load import load


def test_no_cycle_is_lost(tmp_path):
    figures = load(tmp_path, stations=3, rate=30.0, seconds=2.0)
    assert figures.sent > 0
    assert (figures.lost, figures.differing) == (0, 0)
