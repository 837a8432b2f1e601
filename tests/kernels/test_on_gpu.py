"""On a real GPU: ``pytest -m gpu``. Where there is none, or no driver, all of it is skipped with one line."""

from __future__ import annotations

import numpy as np
import pytest
from test_kernel_gpu import pair

import holdfast as hf
from holdfast import arms, control, indices, kernels
from holdfast.core.errors import KernelError
from oracles import inside

pytestmark = pytest.mark.gpu


@pytest.fixture(scope="module", autouse=True)
def driver():
    try:
        kernels.set_backend("cuda")
    except KernelError as error:
        pytest.skip(f"no GPU: {error}")
    kernels.set_backend(None)


@pytest.fixture
def on_gpu():
    yield lambda: kernels.set_backend("cuda")
    kernels.set_backend(None)


def test_rows_are_those_of_the_processor(rng):
    x, y, m = rng.normal(size=(100_000, 3)), rng.normal(size=100_000), rng.normal(size=(2, 3))
    for got, expected in zip(pair("cuda")(x, y, m), pair("llvm")(x, y, m), strict=True):
        np.testing.assert_array_equal(got, expected)  # both have fused multiply-add


def test_everything_by_the_backend_alone(on_gpu, rng):
    def outcome():
        arm = arms.load("panda")
        rho, law = indices.relative_manipulability(arm), control.by_name("damped:0.1", arm)
        q = inside(arm, np.random.default_rng(5), 200)
        poses = arm.forward_kinematics(q)
        runs = hf.simulate(law, q[:20], poses[20:40], locked=[1], time_limit=3)
        found = hf.solve_ik(arm, poses, seed=1)
        best = hf.optimise(arm, poses[:4], rho, seed=1)
        run = hf.assess(arm, hf.Region.joints(arm.lower, arm.upper), rho, poses=100, seed=1)
        values = [rho(q), rho.gradient(q), law.velocity(q, np.ones(6))]
        return values, [found.status, best.status, runs.code, *run.columns.values()]

    (values, outcomes), _ = outcome(), on_gpu()
    got, got_outcomes = outcome()
    for a, b in zip(got, values, strict=True):
        np.testing.assert_allclose(a, b, rtol=1e-12, atol=1e-15)
    for a, b in zip(got_outcomes, outcomes, strict=True):
        np.testing.assert_allclose(a, b, rtol=1e-9)


def test_torch_shares_its_memory(rng):
    torch = pytest.importorskip("torch", reason="PyTorch is not installed")
    if not torch.cuda.is_available():
        pytest.skip("PyTorch is installed without CUDA")
    arm = arms.load("panda")
    law, q, v = control.by_name("damped:0.1", arm), inside(arm, rng, 1000), rng.normal(size=(1000, 6))
    x = [torch.tensor(a, device="cuda", requires_grad=True) for a in (q, v)]
    h = [torch.tensor(a, requires_grad=True) for a in (q, v)]
    for side in (x, h):
        law.to_torch()(*side).square().sum().backward()
    np.testing.assert_allclose(law.to_torch()(*x).numpy(force=True), law.velocity(q, v), rtol=1e-12, atol=1e-15)
    for a, b in zip(x, h, strict=True):
        assert a.grad.device.type == "cuda"
        np.testing.assert_allclose(a.grad.cpu(), b.grad, rtol=1e-9, atol=1e-12)
    out = law._velocity_kernel.on_backend("cuda").exchange(*[t.detach() for t in x])
    assert (
        torch.from_dlpack(out if not isinstance(out, tuple) else out[0]).data_ptr()
        == (out if not isinstance(out, tuple) else out[0]).pointer
    )
