"""Studies that kept counts are read as assessments; arms are written to files; large studies have fewer chunks."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from holdfast.core.sweeps import Study, ThreadRunner
from holdfast.kinematics.indices import by_name
from holdfast.studies.assessment.bins import IndexCounts
from holdfast.studies.study_files import study_file
from holdfast.studies.study_files.template import choose_chunk_size


def test_a_study_with_counts_has_the_distribution_of_the_rows(tmp_path):
    """Oracle: the assessment of the same poses, whose values are exact."""
    path = tmp_path / "s.yaml"
    path.write_text(
        "{poses: 1100, chunk: 1024, seed: 5, arms: [planar-3r], assess: {restarts: 5, keep: counts, optimise: true}}"
    )
    asked = study_file.read_study_file(path)
    study = Study.create(tmp_path / "out", asked.name, asked.seed, cells=asked.cells)
    study.run(asked.cells, ThreadRunner(1))
    counted = hf.load(tmp_path / "out")
    rows = hf.assess(counted.arm, counted.region, counted.index, poses=1100, seed=5, restarts=5, optimise=True)
    assert (counted.poses, counted.complete, counted.has_rows) == (1100, True, False)
    np.testing.assert_array_equal(counted.worst_counts, rows.worst_counts)
    np.testing.assert_array_equal(counted.optimised_worst_counts, rows.optimised_worst_counts)
    for optimised in (False, True):
        for name in ("lowest", "highest", "mean", "reached", "unreached", "singular"):
            assert getattr(counted.distribution_of(optimised), name) == pytest.approx(
                getattr(rows.distribution_of(optimised), name), rel=1e-12
            ), name
        edges = counted.distribution_of(optimised).edges[5:-2:97]
        np.testing.assert_array_equal(counted.cdf(edges, optimised), rows.cdf(edges, optimised))
    curves = counted.plot("cdf").axes[0].get_lines()[:2]
    for curve, optimised in zip(curves, (True, False), strict=True):
        x, share = curve.get_data()
        np.testing.assert_allclose(share, counted.cdf(x, optimised), atol=1e-12)
        assert np.abs(share - rows.cdf(x, optimised)).max() < 0.02


def test_a_study_with_counts_of_few_poses_has_that_many(tmp_path):
    path = tmp_path / "s.yaml"
    path.write_text("{poses: 40, chunk: 1024, arms: [planar-3r], assess: {restarts: 2, keep: counts}}")
    asked = study_file.read_study_file(path)
    Study.create(tmp_path / "out", asked.name, asked.seed, cells=asked.cells).run(asked.cells, ThreadRunner(1))
    counted = hf.load(tmp_path / "out")
    assert (counted.poses, counted.distribution.samples, counted.complete) == (40, 40, True)


@pytest.mark.parametrize("name", ["relative-manipulability", "condition-number"])
def test_counts_of_values_are_those_of_each_value(name, rng):
    """Bins without a bound go from 2^-40 to 2^40, 64 to a factor of two; those below a bound are 4,096 of the same width."""
    index = by_name(name, hf.arms.load("planar-3r"), "planar")
    values = 2.0 ** rng.uniform(0, 38, 3000) if index.bound is None else index.bound * rng.random(3000)
    counts = IndexCounts(index)
    for part in np.split(values, [500, 501, 2200]):
        counts.add(part, unreached=2, singular=1)
    found = counts.finish()
    assert (found.samples, found.reached, found.unreached, found.singular) == (3008, 3000, 8, 4)
    assert (found.lowest, found.highest) == (values.min(), values.max())
    assert found.mean == pytest.approx(values.mean(), rel=1e-12)
    edges = 2.0 ** (np.arange(-2560, 2561) / 64) if index.bound is None else np.linspace(0, index.bound, 4097)
    np.testing.assert_array_equal(found.counts[found.counts > 0], [n for n in np.histogram(values, edges)[0] if n])


@pytest.mark.parametrize(("name", "ending"), [("planar-3r", "yaml"), ("pa10-9dof", "yaml"), ("panda", "urdf")])
def test_a_saved_arm_has_the_same_fingerprint(name, ending, tmp_path):
    arm = hf.arms.load(name)
    assert hf.arms.load(str(arm.save(tmp_path / f"arm.{ending}"))).fingerprint == arm.fingerprint


def test_a_table_of_an_arm_of_a_urdf_file_keeps_its_masses(tmp_path):
    arm = hf.arms.load("panda").with_payload(hf.arms.load("panda").links[3])
    again = hf.arms.load(str(arm.save(tmp_path / "arm.yaml")))
    q = np.random.default_rng(1).uniform(-1, 1, (5, arm.n))
    np.testing.assert_allclose(again.forward_kinematics(q), arm.forward_kinematics(q), atol=1e-12)
    np.testing.assert_allclose(again.gravity_torque(q), arm.gravity_torque(q), atol=1e-11)
    with pytest.raises(hf.InputError, match=r"ends in \.urdf or \.yaml"):
        arm.save(tmp_path / "arm.txt")


def test_an_arm_describes_itself_as_the_command_does(cli):
    code, out, _ = cli("describe", "planar-3r")
    assert code == 0
    assert [line.rstrip() for line in out.splitlines()] == hf.arms.load("planar-3r").describe()


def test_a_large_study_has_at_most_a_thousand_chunks(tmp_path, cli):
    code, _, err = cli("study", "new", str(tmp_path / "s.yaml"), "--arm", "planar-3r", "--poses", "1e7")
    assert code == 0, err
    (cell,) = study_file.read_study_file(tmp_path / "s.yaml").cells
    assert (cell.rows, cell.chunk % 1024, cell.count <= 1000) == (10**7, 0, True)
    assert choose_chunk_size(2000) == 500
