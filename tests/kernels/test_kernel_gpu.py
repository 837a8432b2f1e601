"""Kernels on GPUs that are none: the device's text on the processor, launched through a driver that writes down its calls."""

from __future__ import annotations

import builtins

import casadi as ca
import numpy as np
import pytest

from fake_driver import Array, FakeDriver, Reader, read
from holdfast import kernels
from holdfast.core.errors import InputError, KernelError
from holdfast.kernels import Kernel, Loop, Program
from holdfast.kernels.gpu import driver, launch, ptx


def pair(backend):
    x, y, m = ca.SX.sym("x", 3), ca.SX.sym("y"), ca.SX.sym("m", 2, 3)
    return Kernel("pair", [x, y, m], [m @ ca.sin(x) * ca.exp(y), y * ca.sumsqr(x), x @ x.T], backend=backend)


def test_rows_are_those_of_the_processor(gpu, rng):
    on, off = pair("cuda"), pair("llvm")
    x, y, m = rng.normal(size=(1000, 3)), rng.normal(size=1000), rng.normal(size=(2, 3))
    x[7, 1] = np.nan
    for got, expected in zip(on(x, y, m), off(x, y, m), strict=True):
        np.testing.assert_array_equal(got, expected)
    np.testing.assert_array_equal(on.rows(x, y, m, first=2), off.rows(x, y, m, first=2))
    assert on(x[0], 1.0, m)[0].shape == (2,)
    _, *grid, shared, stream, arguments, extra = gpu.asked("cuLaunchKernel")[0]
    assert grid == [8, 1, 1, 128, 1, 1]  # a thread a row
    assert (shared, stream, extra) == (0, ("stream", 1), 0)
    assert arguments[0][-1] == 1000  # rows
    assert arguments[0][1::3][:3] == (3, 1, 0)  # from row to row; one matrix serves all
    assert len(arguments[0]) == len(arguments[1]) == 13
    assert not gpu.current  # every context that was pushed was popped


def test_a_gpu_takes_over_what_was_made_before_but_not_what_was_told_where_to_be(gpu, rng):
    before, told = pair(None), pair("llvm")
    given = rng.normal(size=(4, 3)), rng.normal(size=4), rng.normal(size=(2, 3))
    expected = before(*given)
    for name, launches in (("cuda:1", 1), ("llvm", 1), ("cuda", 2), (None, 2)):
        kernels.set_backend(name)
        for a, b, c in zip(before(*given), told(*given), expected, strict=True):
            np.testing.assert_array_equal(a, c)
            np.testing.assert_array_equal(b, c)
        assert len(gpu.asked("cuLaunchKernel")) == launches
        assert before.current().backend == (name if "cuda" in str(name) else "llvm")
    assert [k for ((_, k),) in gpu.asked("cuDevicePrimaryCtxRetain")] == [1, 0]


def test_large_batches_go_in_parts(gpu, rng, monkeypatch):
    monkeypatch.setattr(launch, "_MAX_BATCH_BYTES", 8 * 26 * 100)
    x, y, m = rng.normal(size=(250, 3)), rng.normal(size=250), rng.normal(size=(2, 3))
    np.testing.assert_array_equal(pair("cuda").rows(x, y, m), pair("llvm").rows(x, y, m))
    assert [call[-2][0][-1] for call in gpu.asked("cuLaunchKernel")] == [118, 118, 14]


def test_columns_and_single_rows(gpu, rng):
    on, off = pair("cuda"), pair("llvm")
    width = 2 * off.lanes
    inputs = rng.normal(size=(10, width))
    found, expected = np.empty((12, width)), np.empty((12, width))
    on.evaluate_columns(inputs, found)
    off.evaluate_columns(inputs, expected)
    np.testing.assert_array_equal(found, expected)
    np.testing.assert_array_equal(on.single_row()(inputs[:, 3]), expected[:, 3])


@pytest.mark.parametrize("ahead", [False, True])
@pytest.mark.parametrize("most", [0, 5, 40, 2500])
def test_loops_are_those_of_the_processor(ahead, most, gpu, rng):
    s, p = ca.SX.sym("s", 2), ca.SX.sym("p", 2)
    after = s - p[0] * (s - ca.vertcat(ca.cos(s[1]), p[1]))
    residual = ca.sumsqr((after if ahead else s) - ca.vertcat(ca.cos((after if ahead else s)[1]), p[1]))
    if ahead and not most:
        pytest.skip("a loop that looks ahead takes a step before it looks")
    start, parameters = rng.normal(size=(60, 2)), np.stack([10 ** rng.uniform(-3, 0, 60), rng.normal(size=60)], axis=1)
    start[3] = np.nan
    results = [
        Loop("fixed point", s, [p], next_state=after, residual=residual, ahead=ahead, backend=backend).run(
            start, parameters, 1e-20, most
        )
        for backend in ("cuda", "llvm")
    ]
    for name in ("state", "residual", "done", "steps"):
        np.testing.assert_array_equal(*[getattr(r, name) for r in results], err_msg=name)
    assert most < 40 or 0 < results[0].done.sum() < 60


def test_arrays_of_the_device_are_not_copied(gpu, rng):
    on, off = pair("cuda"), pair("llvm")
    x, y, m = Array(rng.normal(size=(3, 50)).T), Array(rng.normal(size=50)), Array(rng.normal(size=(2, 3)))
    before = len(gpu.live)
    a, b, c = on.exchange(x, y, m, stream=77)
    assert len(gpu.live) == before + 1  # the results
    assert not gpu.asked("cuMemcpyHtoDAsync")
    assert not gpu.asked("cuMemcpyDtoHAsync")
    assert not gpu.asked("cuStreamSynchronize")
    given = gpu.asked("cuLaunchKernel")[0][-2][0]
    assert given[0] == x.values.ctypes.data
    assert given[1:3] == (1, 50)  # column by column, as it lay there
    assert gpu.asked("cuLaunchKernel")[0][-3] == ("stream", 77)
    assert x.streams == y.streams == [77]
    for got, expected in zip((a, b, c), off(x.values, y.values, m.values), strict=True):
        assert got.__dlpack_device__() == (2, 0)
        np.testing.assert_array_equal(read(got, stream=77), expected)
    assert not gpu.asked("cuStreamSynchronize")
    read(a, stream=5)  # another stream must wait
    assert gpu.asked("cuStreamSynchronize") == [(("stream", 77),)]
    again = on.exchange(x, b, m)[1]  # results are inputs too
    np.testing.assert_array_equal(read(again), off(x.values, off(x.values, y.values, m.values)[1], m.values)[1])


def test_capsules_give_the_memory_back_whatever_becomes_of_them(gpu, rng):
    out = pair("cuda").exchange(Array(rng.normal(size=(4, 3))), Array(rng.normal(size=4)), Array(rng.normal(size=(2, 3))))
    view, capsules = np.from_dlpack(Reader(out[1])), [out[0].__dlpack__()]
    del out
    assert view.sum() == view.sum()
    del view
    assert len(gpu.live) == 1  # nobody has taken the capsule yet
    with pytest.raises(ZeroDivisionError):
        [capsules.pop(), 1 / 0]  # it ends while an exception is on its way
    assert not gpu.live


def test_what_cannot_be_exchanged_is_a_sentence(gpu, rng):
    on, good = pair("cuda"), [Array(rng.normal(size=s)) for s in ((4, 3), 4, (2, 3))]
    with pytest.raises(KernelError, match="is on the processor"):
        pair("llvm").exchange(*good)
    for k, bad, message in [
        (0, np.zeros((4, 3)), r"not an array on GPU 0: ndarray, DLPack device \(1, 0\)"),
        (0, Array(np.zeros((4, 3)), device=1), r"not an array on GPU 0: Array, DLPack device \(2, 1\)"),
        (0, 3.0, "not an array on GPU 0: float, DLPack device None"),
        (0, Array(np.zeros((4, 2))), r"has shape \(4, 2\); it must be \(N, 3\) or \(3,\)"),
        (2, Array(np.zeros((2, 6))[:, ::2]), None),
        (2, Array(np.zeros((4, 3))[::2]), "rows have gaps"),
        (1, Array(np.zeros(5)), "have 4 and 5 rows|have 5 and 4 rows"),
    ]:
        given = [bad if j == k else x for j, x in enumerate(good)]
        if message is None:
            on.exchange(*given)
            continue
        with pytest.raises(InputError, match=message):
            on.exchange(*given)
    with pytest.raises(InputError, match="takes 3 inputs, got 2"):
        on.exchange(*good[:2])
    single = Array(np.zeros((4, 3)))
    single.values = single.values.astype(np.float32)
    with pytest.raises(InputError, match=r"32 bits .* give doubles"):
        on.exchange(single, *good[1:])


def test_devices_and_what_is_wrong_with_them(gpu):
    assert pair("cuda:1")._on_device.device.ordinal == 1
    with pytest.raises(KernelError, match="there is no GPU 2: the driver has 2"):
        pair("cuda:2")
    for name in ("cuda:x", "llvm:1", "opencl"):
        with pytest.raises(KernelError, match=f"backend '{name}' is not known"):
            pair(name)
    gpu.fails["cuMemAlloc"] = 2
    with pytest.raises(KernelError, match=r"could not give 0 MB: CUDA_ERROR_OUT_OF_MEMORY"):
        pair("cuda")(np.zeros(3), 0.0, np.zeros((2, 3)))
    assert not gpu.current


def test_an_old_device_is_a_sentence():
    with pytest.raises(KernelError, match=r"compute capability 6\.1; holdfast needs 7\.0"):
        ptx.make_ptx(Program("x", [x := ca.SX.sym("x")], [x]), 61)


@pytest.mark.parametrize("missing", ["bindings", "driver", "device"])
def test_a_machine_without_gpu_is_a_sentence(missing, monkeypatch):
    fake = FakeDriver()

    def fails(_):
        raise RuntimeError("libcuda.so.1 not found")

    class Broken:
        driver = fake

        def __getattr__(self, name):
            raise AttributeError(name)

    if missing == "driver":
        fake.cuInit = fails
    if missing == "device":
        fake.fails["cuInit"] = 100
    real = builtins.__import__

    def imported(name, *rest):
        if name == "cuda.bindings":
            if missing == "bindings":
                raise ImportError(name)
            return Broken()
        return real(name, *rest)

    monkeypatch.setattr(builtins, "__import__", imported)
    driver._driver_functions.cache_clear()
    driver.get_device.cache_clear()
    said = {"bindings": r"holdfast-arms\[gpu\]", "driver": "no NVIDIA driver .*: libcuda", "device": "NO_DEVICE.*no GPU here"}
    for ask in (lambda: kernels.set_backend("cuda"), lambda: pair("cuda")):
        with pytest.raises(KernelError, match=said[missing]):
            ask()
    driver._driver_functions.cache_clear()
    assert kernels.default_backend() in ("llvm", "casadi")
