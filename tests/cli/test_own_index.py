"""An own index in a file: on the command line, in a results folder, in a study."""

from __future__ import annotations

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


def test_what_is_missing_is_named(file, refused):
    for label, reason in (("my_index:none", "has no function 'none'"), ("absent:f", "no 'absent.py' in the current folder")):
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
