"""Indices, susceptibilities and laws as functions of PyTorch, where it is installed."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.errors import HoldfastError, InputError
from holdfast.kernels.frameworks import RowFunction
from oracles import inside

torch = pytest.importorskip("torch", reason="PyTorch is not installed: CONTRIBUTING has the command that runs these tests")
pytestmark = pytest.mark.filterwarnings("ignore:.torch.jit.script. is deprecated:DeprecationWarning")  # PyTorch's own use


def tensor(array, grad=False):
    return torch.tensor(array, dtype=torch.float64, requires_grad=grad)


@pytest.fixture(scope="module")
def objectives(panda):
    rho, torque = hf.indices.relative_manipulability(panda), hf.indices.susceptibility.torque(panda)
    return [rho, torque, rho - 1e-4 * torque, hf.indices.minimum_singular_value(panda)]


@pytest.fixture(scope="module")
def laws(panda):
    return [hf.control.by_name(name, panda, task="position") for name in ("pseudoinverse", "damped:0.1")]


def test_values_and_gradients_are_those_without(objectives, panda, rng):
    q = inside(panda, rng, 50)
    for objective in objectives:
        x = tensor(q, grad=True)
        y = objective.to_torch()(x)
        np.testing.assert_array_equal(y.numpy(force=True), objective(q))
        y.sum().backward()
        np.testing.assert_array_equal(x.grad.numpy(), objective.gradient(q))


def test_gradcheck(objectives, laws, panda, rng):
    q, v = tensor(inside(panda, rng, 3), grad=True), tensor(rng.normal(size=(3, 3)), grad=True)
    for objective in objectives:
        assert torch.autograd.gradcheck(objective.to_torch(), q, atol=1e-5, check_forward_ad=True, check_batched_grad=True)
    for law in laws:
        assert torch.autograd.gradcheck(law.to_torch(), (q, v), atol=1e-5, check_forward_ad=True, check_batched_grad=True)


def test_the_failure_tolerant_law_has_the_slopes_of_its_graph(three, rng):
    law = hf.control.by_name("failure-tolerant", three.arm, task="planar")
    q, v = tensor(rng.uniform(-2, 2, (4, 3)), grad=True), tensor(rng.normal(size=(4, 2)), grad=True)
    assert torch.autograd.gradcheck(law.to_torch(), (q, v), atol=1e-4)


def test_memory_is_shared_both_ways(rng):
    seen = []

    def value(rows):
        seen.append((rows.ctypes.data, rows.shape))
        seen.append(rows.sum(axis=1))
        return seen[-1]

    f = RowFunction(name="sum", sizes=(3,), size=None, value=value, slopes=lambda rows: (np.ones_like(rows),))
    from holdfast.kernels.frameworks.torch_rows import wrap_row_function

    x = tensor(rng.normal(size=(4, 5, 3)))
    y = wrap_row_function(f)(x)
    assert seen[0] == (x.data_ptr(), (20, 3))
    assert y.shape == (4, 5)
    assert y.data_ptr() == seen[1].ctypes.data
    once = x[:, 1:3]  # a part of it has gaps between its rows: only then a copy
    np.testing.assert_allclose(wrap_row_function(f)(once).numpy(), once.sum(-1).numpy(), rtol=1e-14)


def test_transforms_of_functions(objectives, laws, panda, rng):
    q = tensor(inside(panda, rng, 6))
    f, g = objectives[0].to_torch(), objectives[0].gradient(q.numpy())
    np.testing.assert_allclose(torch.func.vmap(torch.func.grad(f))(q), g, rtol=1e-14)
    np.testing.assert_allclose(torch.func.vmap(f, in_dims=1)(q.T), f(q))
    h, v = laws[1].to_torch(), tensor(rng.normal(size=3))
    by_q, by_v = torch.func.jacrev(h, argnums=(0, 1))(q[0], v)
    np.testing.assert_allclose(torch.func.jacfwd(h, argnums=(0, 1))(q[0], v)[0], by_q, rtol=1e-12, atol=1e-14)
    np.testing.assert_allclose(by_v @ v, h(q[0], v), rtol=1e-12, atol=1e-14)  # linear in the velocity
    np.testing.assert_allclose(torch.func.vmap(h, in_dims=(0, None))(q, v), h(q, v), rtol=0)
    w = v.clone().requires_grad_()
    h(q, w).sum().backward()  # one velocity for all rows: its slopes are added up
    np.testing.assert_allclose(
        w.grad, torch.func.vmap(torch.func.jacrev(h, argnums=1), (0, None))(q, v).sum((0, 1)), rtol=1e-12
    )


def test_single_precision_stays_so(objectives, panda, rng):
    q = inside(panda, rng, 5)
    x = torch.tensor(q, dtype=torch.float32, requires_grad=True)
    y = objectives[0].to_torch()(x)
    y.sum().backward()
    assert y.dtype == x.grad.dtype == torch.float32
    np.testing.assert_allclose(y.numpy(force=True), objectives[0](q), rtol=1e-4, atol=1e-6)


def test_what_is_not_there_is_a_sentence(objectives, rng):
    f, x = objectives[0].to_torch(), tensor(rng.normal(size=7), grad=True)
    with pytest.raises(InputError, match=r"takes \(\.\.\., 7\), got \(6,\)"):
        f(x[:6])
    (g,) = torch.autograd.grad(f(x), x, create_graph=True)
    with pytest.raises(HoldfastError, match="no second derivatives"):
        g.sum().backward()


def test_a_bad_row_is_nan_alone(objectives, panda, rng):
    q = inside(panda, rng, 3)
    q[1, 2] = np.nan
    x = tensor(q, grad=True)
    y = objectives[0].to_torch()(x)
    y.nansum().backward()
    assert y.isnan().tolist() == [False, True, False]
    assert x.grad.isnan().any(dim=1).tolist() == [False, True, False]


def test_rows_that_a_kernel_on_a_gpu_marks_are_looked_at_on_the_processor(panda, rng, monkeypatch):
    """The kernels here are those of the processor: what a GPU would be given, and what is done with what it gives back."""
    from holdfast.kernels.frameworks import torch_rows

    rho = hf.indices.relative_manipulability(panda)
    function, q = rho.row_function(), inside(panda, rng, 40)
    q[3, 1::2] = 0.0  # stretched out
    q[5, 0] = np.nan
    asked = []

    def exchanged(kernel, rows):
        asked.append(kernel)
        found = kernel(*[x.numpy() for x in rows])
        return [torch.from_numpy(np.array(out)) for out in (found if isinstance(found, tuple) else (found,))]

    monkeypatch.setattr(torch_rows, "_exchange_with_kernel", exchanged)
    for what, expected in ((function.value, rho(q)), (function.slopes, rho.gradient(q))):
        (found,) = torch_rows._compute_on_gpu(function, what, (tensor(q).reshape(2, 20, 7),))
        np.testing.assert_array_equal(found.numpy().reshape(expected.shape), expected)
    assert [kernel.name for kernel in asked] == [k.name for k in function.kernels]
    assert np.isnan(exchanged(asked[0], [tensor(q)])[0].numpy()[[3, 5]]).all(), "nothing to look at again"


def test_the_notebook_learns_to_fold(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    file = Path(__file__).parents[3] / "examples/learn_elbow_angles.ipynb"
    install, *cells = ["".join(c["source"]) for c in json.loads(file.read_text())["cells"] if c["cell_type"] == "code"]
    assert install == "%pip install --quiet 'holdfast-arms[torch]'"
    made: dict[str, object] = {}
    for cell in cells:
        exec(cell.replace("STEPS, BATCH = 1500", "STEPS, BATCH = 300"), made)
    assert np.mean(made["typical"]) < np.mean(made["left"]) <= np.mean(made["best"])
