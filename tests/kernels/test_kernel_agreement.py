"""Compiled code against the CasADi virtual machine, over the equations that holdfast is made of."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import holdfast as hf
from holdfast import arms

KERNELS = {
    "jacobian": lambda arm, q, v: arm.jacobian(q),
    "relative manipulability": lambda arm, q, v: hf.indices.relative_manipulability(arm).evaluate(q).by_failure,
    "its gradient": lambda arm, q, v: hf.indices.relative_manipulability(arm).gradient(q),
    "condition number": lambda arm, q, v: 1 / hf.indices.by_name("condition-number", arm).evaluate(q).by_failure,
    "pseudoinverse": lambda arm, q, v: hf.control.pseudoinverse(arm).velocity(q, v),
    "failure-tolerant inverse": lambda arm, q, v: hf.control.failure_tolerant(arm, pre_failure_error=0.5).velocity(q, v),
}


LARGE = ("condition number", "failure-tolerant inverse")
CASES = [(what, name) for what in KERNELS for name in ("panda", "pa10-9dof") if name == "panda" or what not in LARGE]


@pytest.mark.parametrize(("what", "name"), CASES)
def test_the_same_numbers_as_the_machine_of_casadi(what, name, rng, monkeypatch):
    """They round differently (fused products), so what is ill-conditioned may differ by the square of its condition."""
    arm = arms.load(name)
    q = rng.uniform(arm.lower, arm.upper, (400 if what == "failure-tolerant inverse" else 2_000, arm.n))
    condition = np.linalg.cond(arm.jacobian(q))
    q, condition = q[condition < 1e4], condition[condition < 1e4]
    if what == "its gradient":  # divides by the index
        clear = hf.indices.relative_manipulability(arm)(q) > 1e-3
        q, condition = q[clear], condition[clear]
    v = rng.normal(size=(len(q), 6))
    found = []
    for k, backend in enumerate(("llvm", "casadi")):
        monkeypatch.setenv("HOLDFAST_BACKEND", backend)
        fresh = dataclasses.replace(arm, name=f"{arm.name} {k}")  # no kernel of the other backend
        found.append(np.asarray(KERNELS[what](fresh, q, v)).reshape(len(q), -1))
    here, there = found
    assert np.isfinite(here).all()
    off = (np.abs(here - there) / np.abs(there).max(axis=1, keepdims=True)).max(axis=1)
    assert (off < 1e-12 * np.maximum(1, condition / 30) ** 2).all()
    assert np.median(off) < 1e-13
