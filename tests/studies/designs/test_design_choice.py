"""Which design is called the best, and what else a headline has to say."""

from __future__ import annotations

import numpy as np

from holdfast.studies.designs.designs import choose_best_design, describe_farther_design


def test_of_guarantees_that_are_alike_the_longer_reach_is_the_best():
    guaranteed, reach = np.array([0.2, 0.6310, 0.6308, 0.60]), np.array([2.0, 1.50, 1.71, 1.80])
    assert choose_best_design(guaranteed, reach) == 2  # 0.03 % less, 14 % farther
    assert choose_best_design(guaranteed[[0, 1, 3]], reach[[0, 1, 3]]) == 1  # 5 % less is not alike
    assert choose_best_design(np.array([0.5, 0.5]), np.array([1.0, 1.0005])) == 0  # what is there already
    assert choose_best_design(np.array([0.5, 0.5]), np.array([1.0, 1.1])) == 1
    assert choose_best_design(np.zeros(2), np.array([1.0, 1.1])) == 0


def test_what_a_little_less_would_buy_is_said():
    guaranteed, reach = np.array([0.2, 0.631, 0.612, 0.60]), np.array([2.0, 1.50, 1.71, 1.80])
    sentence = describe_farther_design(guaranteed, reach, 1)
    assert sentence == "For 4.9 % less, 0.600 on the poses of the search, another design reaches 1.800 m, 20.0 % farther."
    assert describe_farther_design(guaranteed, reach, 3) == ""
    assert describe_farther_design(np.zeros(3), np.array([1.0, 2.0, 3.0]), 0) == ""
    assert describe_farther_design(guaranteed[:2], reach[:2], 1) == ""  # a third of the guarantee is not a little less
