"""An own index in a file: on the command line, in a results folder, in a study."""

from __future__ import annotations

from contextlib import nullcontext
from types import SimpleNamespace

import casadi as ca
import numpy as np
import pytest

import holdfast as hf

TEXT = """
import casadi as ca
import numpy as np
import holdfast as hf

W = np.diag([4.0, 1.0, 0.5]) + 0.1


def weighted(j, q, joints):
    return ca.mmin(hf.indices.compute_symmetric_eigenvalues(j @ W[np.ix_(joints, joints)] @ j.T))


weighted.unit = "m^2/rad^2"


def other(j):
    return ca.norm_fro(j)
"""
NAME = "my_index:weighted"


@pytest.fixture
def file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "my_index.py").write_text(TEXT)
    return tmp_path / "my_index.py"


def test_the_value_is_that_of_numpy(file, ask):
    q, arm = [0.3, 0.7, -0.5], hf.arms.load("planar-3r")
    found = ask("index", "planar-3r", "--index", NAME, "--q", "0.3 0.7 -0.5")
    w, j = np.diag([4.0, 1.0, 0.5]) + 0.1, arm.jacobian(q)[:2]
    for k, name in enumerate(arm.joint_names):
        rest = [i for i in range(3) if i != k]
        least = np.linalg.eigvalsh(j[:, rest] @ w[np.ix_(rest, rest)] @ j[:, rest].T)[0]
        assert found["by_failure"][name] == pytest.approx(least, rel=1e-10)
    assert found["unit"] == "m^2/rad^2"


def test_a_folder_is_read_until_its_function_changes(file, cli):
    run = ("assess", "planar-3r", "--index", NAME, "--poses", "20", "--out", "r")
    assert cli(*run)[0] == 0
    file.write_text("# a remark\n" + TEXT.replace("norm_fro", "norm_1"))
    assert hf.load("r").index.label == NAME
    file.write_text(TEXT.replace("+ 0.1", "+ 0.2"))
    with pytest.raises(hf.StoreError, match="function of index 'my_index:weighted' has changed"):
        hf.load("r")
    code, _, err = cli(*run)
    assert (code, "has changed since" in err) == (2, True)


def test_a_study_sweeps_it(file, cli):
    file.with_name("s.yaml").write_text(f"{{poses: 20, chunk: 10, arms: [planar-3r], assess: {{indices: ['{NAME}']}}}}")
    assert cli("study", "run", "s.yaml", "--out", "s")[0] == 0
    assert hf.load("s").index.label == NAME


def least_by_numpy(arm, q):
    """Return the smallest eigenvalue of J W J' over the three locks, for each configuration (N, 3)."""
    w, j = np.diag([4.0, 1.0, 0.5]) + 0.1, arm.jacobian(q)[..., :2, :]
    rest = [[i for i in range(3) if i != k] for k in range(3)]
    products = [j[..., r] @ w[np.ix_(r, r)] @ np.swapaxes(j[..., r], -1, -2) for r in rest]
    return np.linalg.eigvalsh(np.stack(products))[..., 0].min(axis=0)


def self_motion(x, y):
    """Return configurations of three links of 1 m that hold the tool at (x, y), both elbows for each first angle."""
    first = np.linspace(-np.pi, np.pi, 100_001)
    a, b = x - np.cos(first), y - np.sin(first)
    cosine = (a**2 + b**2 - 2) / 2
    first, a, b, cosine = (values[np.abs(cosine) <= 1] for values in (first, a, b, cosine))
    bent = np.concatenate([np.arccos(cosine), -np.arccos(cosine)])
    direction = np.tile(np.arctan2(b, a), 2) - bent / 2
    return np.column_stack([np.tile(first, 2), direction - np.tile(first, 2), bent])


def test_the_best_configuration_is_that_of_a_search_over_the_self_motion(file, ask):
    arm = hf.arms.load("planar-3r")
    found = ask("optimise", "planar-3r", "--at", "0.3 0.7 -0.5", "--maximise", NAME)["poses"][0]
    others = self_motion(*arm.forward_kinematics([0.3, 0.7, -0.5])[:2, 3])
    assert found["value"] == pytest.approx(least_by_numpy(arm, others).max(), rel=1e-4)
    assert least_by_numpy(arm, np.array(list(found["q"].values()))) == pytest.approx(found["value"], rel=1e-9)


def test_a_sum_with_a_module_in_a_package(file, ask):
    (file.parent / "indices").mkdir()
    (file.parent / "indices" / "mine.py").write_text(TEXT)
    one, two = (
        ask("optimise", "planar-3r", "--at", "0.3 0.7 -0.5", "--maximise", text)["poses"][0]
        for text in (NAME, "0.5*indices.mine:weighted + 0.5*my_index:weighted")
    )
    assert one["value"] == pytest.approx(two["value"], rel=1e-8)


def test_a_sweep_of_designs_resumes_until_the_function_changes(file, cli):
    swept = "{arm: planar-3r, vary: {a1: 0.9..1.1}, designs: 4, chunk: 2}"
    file.with_name("s.yaml").write_text(f"{{poses: 16, chunk: 2, arms: [{swept}], assess: {{indices: ['{NAME}']}}}}")
    assert cli("study", "run", "s.yaml", "--out", "s", "--part", "1/2")[0] == 0
    file.write_text(TEXT.replace("+ 0.1", "+ 0.2"))
    code, _, err = cli("study", "run", "s.yaml", "--out", "s")
    assert (code, "a file that it reads has changed" in err) == (2, True), err
    file.write_text(TEXT)
    assert cli("study", "run", "s.yaml", "--out", "s")[0] == 0
    assert cli("study", "report", "s")[0] == 0


def test_the_studio_offers_it(file, monkeypatch, cli):
    from holdfast.interface.studio import server
    from holdfast.interface.studio.machine import CompiledArm
    from holdfast.model.arm.task import as_task

    asked = {}

    def serve(model, state, *_, **__):
        asked.update(model=model, state=state)
        return nullcontext(SimpleNamespace(url="", wait=lambda: None))

    monkeypatch.setattr(server, "serve", serve)
    assert cli("studio", "planar-3r", "--index", NAME, "--objective", NAME)[0] == 0
    machine, q = CompiledArm(asked["model"], as_task(asked["model"], "planar")), [0.3, 0.7, -0.5]
    index = machine.get_index(asked["state"].objective)
    assert index.evaluate(q).value == pytest.approx(least_by_numpy(asked["model"], np.array(q)), rel=1e-9)


def test_what_is_missing_is_named(file, refused):
    for label, reason in (
        ("my_index", "as module:function"),
        ("my_index.py:weighted", "without .py: my_index:weighted"),
        ("my_index:none", "has no function 'none'"),
        ("absent:f", "no 'absent.py' in the current folder"),
    ):
        assert reason in refused("index", "planar-3r", "--index", label, "--q", "0 1 1")


@pytest.mark.parametrize("m", [1, 2, 3, 4, 6])
def test_eigenvalues_and_their_derivatives_are_those_of_numpy(m):
    a = ca.SX.sym("a", m, m)
    values = hf.indices.compute_symmetric_eigenvalues(a)
    evaluate = ca.Function("f", [a], [values, ca.jacobian(values, ca.vec(a))])
    draws = np.random.default_rng(m)
    for _ in range(20):
        matrix = draws.normal(size=(m, m))
        matrix = matrix + matrix.T
        got, slopes = (np.array(x) for x in evaluate(matrix))
        order = np.argsort(got[:, 0])
        exact, vectors = np.linalg.eigh(matrix)
        np.testing.assert_allclose(got[order, 0], exact, atol=1e-13 * np.linalg.norm(matrix))
        for k in range(m):
            symmetric = slopes[order[k]].reshape(m, m)
            symmetric = (symmetric + symmetric.T) / 2
            np.testing.assert_allclose(symmetric, np.outer(vectors[:, k], vectors[:, k]), atol=1e-7)
