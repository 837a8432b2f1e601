"""Arms made from null spaces and Jacobians: the index of the library measures them."""

import numpy as np
import pytest
from measurements.synthesis.__main__ import main
from measurements.synthesis.arms import synthesise
from measurements.synthesis.axes import find_joint_axes, find_pose_jacobians
from measurements.synthesis.orders import compare_joint_orders, find_distinct_orders

import holdfast as hf

ROWS = {"planar": [0, 1], "position": [0, 1, 2], "pose": [0, 1, 2, 3, 4, 5]}


def left(arm, task, k):
    """The least relative manipulability at zero, by reduced Jacobians and determinants (Abdi 2012, eq. 3)."""
    from itertools import combinations

    j = arm.jacobian(np.zeros(arm.n))[ROWS[task]]
    volumes = [np.linalg.det(x @ x.T) for x in (np.delete(j, s, axis=1) for s in combinations(range(arm.n), k))]
    return np.sqrt(max(min(volumes), 0) / np.linalg.det(j @ j.T))


@pytest.mark.parametrize(
    ("task", "n", "m", "k"),
    [
        ("planar", 5, 2, 3),
        ("position", 4, 3, 1),
        ("position", 6, 3, 3),
        ("pose", 7, 6, 1),
        ("pose", 9, 6, 3),
        ("pose", 10, 6, 2),
    ],
)
def test_a_ceiling_is_realised_by_a_revolute_arm(task, n, m, k):
    c = hf.index_bounds.upper_bound(n=n, m=m, k=k)
    exact = synthesise(c, task=task, starts=4, seed=1, decimals=16)
    assert max(exact.losses) < 1e-9
    assert left(exact.arms[0], task, k) == pytest.approx(c.best_known, rel=1e-9)
    made = synthesise(c, task=task, starts=4, seed=1)
    assert min(made.losses) < 1e-4
    for arm, loss in zip(made.arms, made.losses, strict=True):
        assert left(arm, task, k) == pytest.approx(made.value - loss, abs=1e-10)
        assert sum(abs(r.a) + abs(r.d) for r in hf.arms.dh_table(arm).rows[:-1]) == pytest.approx(2, abs=1e-3)


def test_lines_of_poses_are_found_from_nearly_every_start():
    null = hf.index_bounds.upper_bound(n=7, m=6).null_space
    found, residual = find_pose_jacobians(null, starts=20, seed=0)
    assert residual < 1e-12
    assert len(found) >= 15
    for j in found:
        assert abs((j[:3] * j[3:]).sum(axis=0)).max() < 1e-9
        np.testing.assert_allclose(np.linalg.norm(j[3:], axis=0), 1, atol=1e-11)
        assert abs(j @ null).max() < 1e-9


@pytest.mark.parametrize("task", ["planar", "position", "pose"])
def test_a_jacobian_comes_back(task, rng, pa10_7):
    j = pa10_7.jacobian(rng.uniform(-1, 1, 7)) if task == "pose" else rng.normal(size=(len(ROWS[task]), 7))
    arm = synthesise(jacobian=j, task=task, failures=1, decimals=16).arms[0]
    np.testing.assert_allclose(arm.jacobian(np.zeros(7))[ROWS[task]], j, atol=1e-9)


def test_what_is_no_jacobian_of_an_arm_is_refused(pa10_7):
    j = pa10_7.jacobian(np.full(7, 0.3))
    for wrong, said in (
        (np.where(np.arange(7) == 2, 0, j), "column 3 of the Jacobian is 0"),
        (j * np.where(np.arange(7) == 4, 1.01, 1.0), "column 5 of the Jacobian is the velocity of no revolute joint"),
        (np.where(np.arange(7) == 4, np.nan, j), "not finite"),
        (j[[0, 1, 2, 3, 4, 4]], "dependent"),
    ):
        with pytest.raises(hf.InputError, match=said):
            find_joint_axes(wrong)
    with pytest.raises(hf.InputError, match="has 3 rows; task 'pose' has 6"):
        synthesise(jacobian=j[:3])
    with pytest.raises(hf.InputError, match="give one of"):
        synthesise()
    with pytest.raises(hf.InputError, match="not orthonormal"):
        synthesise(null_space=np.ones((7, 1)))
    with pytest.raises(hf.InputError, match="of task 'pose' with 6 rows"):
        synthesise(hf.index_bounds.upper_bound(n=5, m=3, k=2))


# ---- orders ------------------------------------------------------------------------------------------------------------


def test_orders_are_judged_as_the_index_judges_their_arms(pa10_7):
    """A few orders: the same draws through the index of the arm that is made for each of them."""
    (j,), _ = find_pose_jacobians(hf.index_bounds.upper_bound(n=7, m=6).null_space, starts=1, seed=2)
    found = compare_joint_orders(j, samples=300, at_most=3, seed=5)
    assert found.at_home == pytest.approx(7**-0.5, rel=1e-9)
    draws = np.random.default_rng(5)
    draws.permutation(np.zeros((2520, 7)))  # the orders are drawn first
    q = draws.uniform(-np.pi, np.pi, (300, 7))
    for d, order in enumerate(found.orders):
        arm = synthesise(jacobian=j[:, order], decimals=16).arms[0]
        rho = np.array([least(arm.jacobian(x)) for x in q])
        assert found.mean[d] == pytest.approx(rho.mean(), rel=1e-7)
        assert found.counts[d].tolist() == [(rho >= h).sum() for h in found.thresholds]
        assert found.interval(d, 1).low <= found.fractions[d, 1] <= found.interval(d, 1).high


def least(jacobian):
    return abs(np.linalg.svd(jacobian)[2][-1]).min()


def test_a_reversed_order_is_the_same_arm_read_from_the_tool(rng):
    """At the angles of the first in reverse and the other way round both have the same value."""
    (j,), _ = find_pose_jacobians(hf.index_bounds.upper_bound(n=7, m=6).null_space, starts=1, seed=2)
    one, other = (synthesise(jacobian=x, decimals=16).arms[0] for x in (j, j[:, ::-1]))
    for q in rng.uniform(-np.pi, np.pi, (20, 7)):
        assert least(one.jacobian(q)) == pytest.approx(least(other.jacobian(-q[::-1])), abs=1e-10)


def test_orders_that_a_symmetry_makes_the_same_are_judged_once(rng, pa10_7):
    corners = np.array([[1.0, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]])
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    up = np.array([[0, 0, 1.0]] * 4) * rng.choice([-1, 1], (4, 1))
    # Paths through the corners of a square, up to its symmetries: by the sides, and with one or two diagonals.
    assert len(find_distinct_orders(up @ turn.T, corners @ turn.T + rng.normal(size=3))) == 3
    w = rng.normal(size=(5, 3))
    assert len(find_distinct_orders(w / np.linalg.norm(w, axis=1, keepdims=True), rng.normal(size=(5, 3)))) == 60


def test_the_front_of_orders_is_that_of_fresh_samples(rng, pa10_7):
    found = compare_joint_orders(pa10_7.jacobian(rng.uniform(-1, 1, 7)), samples=100, at_most=40, thresholds=(0.1, 0.2))
    assert (np.diff(found.lengths[found.front]) > 0).all()
    assert (np.diff(found.fresh) > 0).all()
    assert len(found.front) == len(found.fresh) >= 1


def test_orders_that_cannot_be_judged(pa10):
    with pytest.raises(hf.InputError, match="say how many with at_most"):
        compare_joint_orders(pa10.jacobian(np.full(9, 0.3)))
    with pytest.raises(hf.InputError, match="of 6 rows"):
        compare_joint_orders(np.eye(3))


# ---- the command -------------------------------------------------------------------------------------------------------


def test_arms_from_files_of_numbers(tmp_path, capsys):
    file = tmp_path / "null.csv"
    np.savetxt(file, hf.index_bounds.upper_bound(n=4, m=2, k=1).null_space, delimiter=",")
    words = [str(file), "--null-space", "--task", "planar"]
    assert main([*words, "--starts", "1", "--out", str(tmp_path / "a")]) == 0
    assert "no arm can beat 0.707107" in capsys.readouterr().out
    assert hf.arms.load(str(tmp_path / "a" / "arm-1.yaml")).n == 4
    for text, refused, said in (
        (None, [*words, "--orders"], "orders are compared for poses"),
        ("1, 2\n3, x\n", [str(file)], "null.csv, line 2: '3, x' is not a row of numbers"),
        ("1 2\n3\n", [str(file)], "line 2: 1 numbers; the first row has 2"),
        (None, ["--size", "7,5,2", "--task", "pointing"], "arms are made for"),
    ):
        if text is not None:
            file.write_text(text, encoding="utf-8")
        assert main(refused) == 2
        assert said in capsys.readouterr().err


def test_an_arm_of_a_ceiling_is_written_and_read(tmp_path, capsys):
    assert main(["--size", "9,6,2", "--starts", "6", "--seed", "1", "--out", str(tmp_path)]) == 0
    values = [float(line.split("|")[2]) for line in capsys.readouterr().out.splitlines() if line.startswith("| 1 |")]
    j = hf.arms.load(str(tmp_path / "arm-1.yaml")).jacobian(np.zeros(9))
    null = np.linalg.svd(j)[2][6:].T
    least = min(abs(np.linalg.det(null[[a, b]] @ null[[a, b]].T)) ** 0.5 for a in range(9) for b in range(a))
    assert least == pytest.approx(values[0], abs=1e-6)
