"""200 random runs end as an integrator and a right-hand side that share nothing with ours say; benchmarks/ has 10,000."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from holdfast.control.simulation import simulate

LIMIT = 25.0  # 1/Ke, for both


@pytest.fixture(scope="module")
def agreement():
    folder = str(Path(__file__).parents[3] / "benchmarks")
    sys.path.insert(0, folder)
    try:
        import agreement_closed_loop
    finally:
        sys.path.remove(folder)
    return agreement_closed_loop


def test_runs_end_as_an_independent_integrator_says(agreement, generator):
    seed = int(generator("agreement").integers(2**32))
    different = compared = 0
    for index, count in ((0, 70), (5, 50)):
        family = agreement.FAMILIES[index]
        c = agreement.cases(family, seed)
        runs = simulate(agreement.law_of(family), c.q0[:count], c.target[:count], locked=c.lock[:count], time_limit=LIMIT)
        hand = agreement.rates_of(family)[1]
        for k in range(count):
            with np.errstate(all="ignore"):
                row = agreement.reference(family, c.q0[k], c.target[k], c.lock[k], LIMIT)
            compared += 1
            # The reference looks at the speed near the limit alone; that a motion never stops takes a return as well.
            known = {row["outcome"]} | ({"undecided"} if row["outcome"] == "moving" else set())
            if runs.outcome[k] not in known:
                different += 1
            elif row["outcome"] in ("converged", "stuck"):
                assert np.linalg.norm(hand(np.array(row["q"])) - runs.x_final[k]) < 1e-6
                assert row["time"] == pytest.approx(runs.time[k], abs=5)
    assert compared == 120
    assert different <= 1
