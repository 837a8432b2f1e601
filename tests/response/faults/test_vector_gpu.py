"""Many arms with faults on a GPU that is none: the numbers of the processor, and what goes to the device and comes back."""

from __future__ import annotations

import numpy as np
import pytest
from test_vector import shared

import holdfast as hf
from fake_driver import Array, Reader, read
from holdfast.core.errors import InputError
from holdfast.kernels import set_backend
from holdfast.response.faults import FaultModel, FaultVectorEnv

pytest.importorskip("gymnasium")

N, PERIOD, STEPS = 5, 0.05, 14
FAULTS = [hf.faults.locked(onset=(0.0, 0.3)), hf.faults.sensor_noise("joint2", deviation=0.1, onset=0.3, probability=0.3)]


def made(backend, count=N, faults=FAULTS, **options):
    set_backend(backend)
    arm = hf.arms.load("planar-3r").with_limits([-2.5] * 3, [2.5] * 3)
    law = hf.control.damped(arm, 0.1, task="planar", gain=1.5, speed_limit=1.0)
    return FaultVectorEnv(law, count, FaultModel(faults, seed=5), period=PERIOD, **options)


def test_it_is_that_of_the_processor(gpu, rng):
    actions = rng.uniform(-1, 1, (STEPS, N, 3))

    def told(backend, given):
        env = made(backend, horizon=0.4, tolerance=(0.3, 4.0))
        observation, info = env.reset(seed=2)
        yield np.asarray(observation), env.q, info["fault"]["active"]
        for action in given:
            *arrays, info = env.step(action)
            yield *map(np.asarray, arrays), env.q, *info["fault"].values()

    ends = 0
    for there, here in zip(told("cuda", map(Array, actions)), told("llvm", actions), strict=True):
        for a, b in zip(there, here, strict=True):
            np.testing.assert_array_equal(a, b)
        ends += len(there) > 3 and there[2].sum() + 100 * there[3].sum()
    assert ends > 100  # of both kinds
    assert ends % 100


def test_a_step_is_one_launch_and_nothing_is_copied_but_what_is_over(gpu, rng):
    options = {"goals": lambda _, count: np.tile(np.eye(4), (count, 1, 1)), "tolerance": (0.0, 0.0)}
    env = made("cuda", faults=FAULTS[:1], stream=77, horizon=0.3, **options)
    observation, _ = env.reset(seed=0)
    state, numbers = env._state.pointer, 8 * (12 + 7 * 3)
    for k in range(8):
        gpu.calls.clear()
        action = Array(rng.uniform(-1, 1, (N, 3)))
        answer = env.step(action)
        ((*_, stream, given, _),) = gpu.asked("cuLaunchKernel")
        assert stream == ("stream", 77)
        pointers = given[0][::3]
        assert (pointers[0], pointers[3]) == (state, action.values.ctypes.data)
        assert env._state.pointer == pointers[7] != state
        state = env._state.pointer
        went = [size for _, _, size, _ in gpu.asked("cuMemcpyHtoDAsync")]
        assert went == ([N * numbers] if k == 6 else [])  # the next episodes, where these were over
        assert [size for _, _, size, _ in gpu.asked("cuMemcpyDtoHAsync")] == [8 * N]
        assert {s for *_, s in gpu.asked("cuMemcpyDtoHAsync")} == {("stream", 77)}
        for array in answer[:4]:
            assert array.__dlpack_device__() == (2, 0)
            assert read(array, stream=77).shape == array.shape
    assert read(observation, stream=77).shape == env.observation_space.shape  # who has it keeps it
    some = np.array([0, 1, 4])
    env._episodes[some] = 7.0
    gpu.calls.clear()
    env._episode_table.upload_rows(some, env._episodes)
    assert [size for _, _, size, _ in gpu.asked("cuMemcpyHtoDAsync")] == [2 * numbers, numbers]  # rows side by side at once
    assert (read(env._episode_table, stream=77) == env._episodes).all()


def test_what_cannot_be_an_action_is_a_sentence_and_loses_nothing(gpu, rng):
    env, twin = made("cuda", tolerance=(0.0, 0.0)), made("cuda", tolerance=(0.0, 0.0))
    for each in (env, twin):
        each.reset(seed=1)
    good = rng.uniform(-1, 1, (N, 3))
    bad = good.copy()
    bad[3, 1] = np.nan
    single = Array(good)
    single.values = single.values.astype(np.float32)
    for given, message in [
        (good[:4], r"actions have shape \(4, 3\); they must be \(5, 3\)"),
        (bad, "the action of arm 3 is not a number; give numbers from -1 to 1"),
        (single, r"32 bits .* give doubles"),
    ]:
        with pytest.raises(InputError, match=message):
            env.step(given)
    for a, b in zip(env.step(good)[:4], twin.step(good.tolist())[:4], strict=True):
        np.testing.assert_array_equal(a, b)
    env.step(Array(bad))  # on a GPU nobody looks before the next step
    with pytest.raises(InputError, match=r"the action of arm 3 is not a number in the last step.*reset the environment"):
        env.step(good)
    env.reset(seed=1)
    for a, b in zip(env.step(good)[:4], (twin.reset(seed=1), twin.step(good))[1][:4], strict=True):
        np.testing.assert_array_equal(a, b)


@pytest.mark.parametrize("framework", ["torch", "jax"])
def test_a_policy_of_a_framework_shares_what_is_on_the_device(framework, gpu):
    """Its arrays are on the processor, as the device's memory is here; who reads and who is read is as on a GPU."""
    pytest.importorskip(framework, reason=f"{framework} is not installed: CONTRIBUTING has the command that runs this test")

    def episode(env, share, act):
        observation, _ = env.reset(seed=3)
        for _ in range(5):
            there, pointer = shared(framework, share(observation))
            assert not env._on_gpu or pointer == observation.pointer
            action = 0.5 - 0.1 * there[:, :3] * there[:, 3:4]
            observation = env.step(act(action))[0]
            if env._on_gpu:
                assert gpu.asked("cuLaunchKernel")[-1][-2][0][9] == shared(framework, action)[1]
        return np.asarray(observation)

    on, off = made("cuda", 8), made("llvm", 8)  # 8 doubles: JAX copies what does not begin at a multiple of 64 bytes
    np.testing.assert_array_equal(episode(on, Reader, Array), episode(off, lambda x: x, lambda x: x))


CONSUMERS = [
    {},
    {"stream": None},
    {"stream": 1},
    {"stream": 1, "max_version": (1, 0)},
    {"stream": 2, "dl_device": (2, 0), "copy": False},
]


def test_what_frameworks_ask_of_an_array_is_answered(gpu):
    """As PyTorch, JAX, CuPy and Warp ask: with and without a stream, a version and a device."""
    reward = made("cuda").step(np.zeros((N, 3)))[1]
    assert reward.__dlpack_device__() == (2, 0)
    for asked in CONSUMERS:
        assert "dltensor" in repr(reward.__dlpack__(**asked))
