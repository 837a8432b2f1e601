"""Assessments that look whether the arm collides with itself: counts, folders, and what the report and its command say."""

from __future__ import annotations

import dataclasses
import json
import shutil

import numpy as np
import pytest
import yaml

import holdfast as hf
from holdfast import Capsules, Clearance, Region, arms, assess, load
from holdfast.core.errors import InputError, StoreError
from holdfast.core.status import Status
from holdfast.interface.presentation.assessment.answer import ThresholdAnswer
from holdfast.interface.presentation.assessment.assessment import summarize_collisions
from holdfast.interface.presentation.commands import build_command_line, build_shape_file_blocks
from holdfast.interface.presentation.renderers import present
from holdfast.model.collision import LinkCapsule
from holdfast.model.collision.cover import choose_capsules
from holdfast.studies.assessment.plan import make_plan

CLOSE = Region.box([0.2, 0.1, 0], [0.5, 0.5, 0], name="close to the base")
MARGIN = 0.01


@pytest.fixture(scope="module")
def arm():
    return arms.load("planar-3r")


@pytest.fixture(scope="module")
def thick(arm):
    """First and third link in one plane."""
    return Clearance(arm, Capsules.along_links(arm, 0.13))


@pytest.fixture(scope="module")
def call(arm, thick):
    return {"region": CLOSE, "task": "planar", "poses": 600, "optimise": True, "clearance": thick, "margin": MARGIN}


@pytest.fixture(scope="module")
def run(arm, call):
    return assess(arm, **call)


def columns(a):
    return {str(name): v.values for name, v in a.dataset.data_vars.items()}


# ---- counts ----------------------------------------------------------------------------------------------------------


def test_counts_are_those_of_the_rows(run, thick):
    rows, found = columns(run), run.collisions
    reached = np.isin(rows["status"], (Status.OK, Status.SINGULAR))
    best = np.isfinite(rows["optimised_index"])
    np.testing.assert_array_equal(rows["clearance"][reached], thick(rows["q"][reached]))
    assert np.isnan(rows["clearance"][~reached]).all()
    assert (thick(rows["optimised_q"][best]) >= MARGIN).all()
    assert found.reached == run.distribution.reached == reached.sum()
    assert found.found == (thick(rows["q"][reached]) < 0).sum() > 0
    assert found.blocked == (rows["blocked"][reached] == 1).sum() > 0
    assert found.hopeless == (reached & ~best).sum() > 0
    assert found.margin == MARGIN
    np.testing.assert_array_equal(reached & ~best, rows["optimised_status"] == Status.INFEASIBLE)
    assert run.optimised.reached == best.sum()
    assert run.optimised.unreached == (~best).sum()
    assert run.optimised_worst_counts.sum() == (rows["optimised_worst"] >= 0).sum()


def test_blocked_poses_are_those_whose_best_configuration_is_not_clear(run, arm, call, thick):
    free = assess(arm, **{**call, "clearance": False})
    assert free.collisions is None
    rows, before = columns(run), columns(free)
    assert "clearance" not in before
    np.testing.assert_array_equal(rows["q"], before["q"])
    reached = np.isfinite(before["optimised_index"])
    np.testing.assert_array_equal(rows["blocked"][reached] == 1, thick(before["optimised_q"][reached]) < MARGIN)
    both = np.isfinite(rows["optimised_index"])
    assert (rows["optimised_index"][both] <= before["optimised_index"][both] + 1e-9).all()


def test_what_a_joint_that_never_fails_gains_counts_hopeless_poses_as_failed(run):
    """Of the first 500 poses; none is worse than the worst case over the others at the configuration chosen for all."""
    rows = columns(run)
    best = np.isfinite(rows["optimised_index"][:500])
    by_failure = run.index.by_joint(rows["optimised_q"][:500][best])
    found = {u.joint: u.after for u in run.upgrades(0.3, optimised=True)}
    for k, name in enumerate(run.arm.joint_names):
        d = run.if_never_fails(k, optimised=True)
        assert d.unreached == (~best).sum() > 0
        least = np.sort(np.delete(by_failure, k, axis=1).min(axis=1))
        assert (np.sort(d.values) >= least * (1 - 1e-12)).all()
        assert found[name] == pytest.approx((d.values >= 0.3).sum() / 500)


def test_a_region_of_joints_and_runs_that_are_not_optimised(arm, thick):
    direct = assess(arm, Region.joints([-3] * 3, [3] * 3), task="planar", poses=2000, clearance=thick)
    rows = columns(direct)
    assert direct.collisions.found == (thick(rows["q"]) < 0).sum() > 0
    assert (direct.collisions.blocked, direct.collisions.reached) == (0, 2000)
    plain = assess(arm, CLOSE, task="planar", poses=50, clearance=thick)
    assert "blocked" not in columns(plain)
    assert plain.collisions.found == (columns(plain)["clearance"] < 0).sum()
    assert assess(arm, CLOSE, task="planar", poses=20, optimise=True).collisions is None  # links beside each other


def test_what_does_not_fit_is_refused(arm, call):
    with pytest.raises(InputError, match="clearance belongs to 'planar-2r', not to 'planar-3r'"):
        assess(arm, **{**call, "clearance": Clearance(arms.load("planar-2r"))})
    with pytest.raises(InputError, match="margin is nan"):
        assess(arm, **{**call, "margin": np.nan})


# ---- folders ---------------------------------------------------------------------------------------------------------


def test_a_folder_goes_on_and_holds_the_same(run, arm, call, tmp_path):
    def stop(done, total):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        assess(arm, **call, store=tmp_path / "run", progress=stop)
    whole = assess(arm, **call, store=tmp_path / "run")
    back = load(tmp_path / "run")
    for other in (whole, back):
        assert other.collisions == run.collisions
        for name, values in columns(run).items():
            np.testing.assert_array_equal(columns(other)[name], values)
    assert back.plan.clearance.capsules == call["clearance"].capsules
    assert back.plan.margin == MARGIN
    with pytest.raises(StoreError, match="holds another run"):
        assess(arm, **{**call, "margin": 0.0}, store=tmp_path / "run")


def test_a_folder_from_before_there_was_a_clearance_still_loads(arm, call, tmp_path):
    """Such a plan has no entry for it and its rows no such columns."""
    old = assess(arm, **{**call, "clearance": False, "margin": 0.0}, store=tmp_path / "old")
    plan = json.loads((tmp_path / "old" / "run.json").read_text())["plan"]
    assert "clearance" not in plan
    names = {p.name for p in (tmp_path / "old" / "samples.zarr").iterdir()}
    assert names.isdisjoint({"clearance", "blocked", "optimised_status"})
    back = load(tmp_path / "old")
    assert back.collisions is None
    assert back.optimised.reached == old.optimised.reached
    assert "Self-collision was not checked" in back.report(tmp_path / "old.html").read_text()


@pytest.fixture(scope="module")
def saved(run, tmp_path_factory):
    return run.save(tmp_path_factory.mktemp("saved") / "run")[0].parent


@pytest.mark.parametrize("name", ["clearance", "blocked", "optimised_status"])
def test_a_lost_column_is_named(name, saved, tmp_path):
    folder = shutil.copytree(saved, tmp_path / "run")
    for p in (folder / "samples.zarr" / name / "c").rglob("*"):
        if p.is_file():
            p.unlink()
    with pytest.raises(StoreError, match=r"chunk 1 of .* is damaged .*; give 'holdfast study verify"):
        load(folder)


# ---- capsules in words, report, command --------------------------------------------------------------------------------


def test_where_capsules_come_from():
    arm = arms.load("panda")
    assumed, own = Capsules.along_links(arm), Capsules.along_links(arm, 0.05)
    other = Capsules((LinkCapsule(-1, (0, 0, 0), (0, 0, 0.3), radius=0.1), *own.parts[1:]))
    assert [c.is_assumed(arm) for c in (assumed, own, other)] == [True, False, False]
    assert [c.radius_along(arm) for c in (assumed, own, other)] == [assumed.parts[0].radius, 0.05, None]
    assert assumed.describe(arm) == "assumed radius 0.0711 m along each link"
    assert own.describe(arm) == "given radius 0.05 m along each link"
    assert other.describe(arm) == f"{len(other)} capsules, as given"
    assert Capsules.from_dict(assumed.to_dict(arm), arm).is_assumed(arm)
    assert Capsules(()).describe(arm) == "0 capsules, as given"
    assert Capsules(own.parts, ((0, 3),)).radius_along(arm) is None
    assert Clearance.by_default(arms.load("planar-3r")) is None
    assert Clearance.by_default(arm).capsules.describe(arm).startswith("cover of the collision shapes of panda.urdf: ")
    other = arms.load("xarm7")  # its file gives none
    assert Clearance.by_default(other).capsules == Capsules.along_links(other)


def test_the_report_says_what_was_counted(run, thick, tmp_path):
    text = run.report(tmp_path / "r.html").read_text().replace("\u00a0", " ")
    found = run.collisions
    for part in (
        "Collisions of the arm with itself",
        "comes closer than 0.01 m to itself",
        thick.pair_names[0],
        "given radius 0.13 m",
    ):
        assert part in text.replace("&amp;", "&"), part
    table = next(s for s in present(run).sections() if s.title.startswith("Collisions of the arm")).blocks[0]
    cells = dict(table.rows)
    for name, count in (
        ("Configurations found in which the arm collides with itself", found.found),
        ("Poses at whose best configuration the arm otherwise comes closer than 0.01 m to itself", found.blocked),
        ("… and another configuration was chosen instead", found.blocked - found.hopeless),
    ):
        assert cells[name].startswith(f"{count} ("), name
    line = summarize_collisions(ThresholdAnswer(run, None))
    assert "given radius" in line
    assert f"{found.hopeless} poses without such a configuration" in line
    assert "shape of the arm is assumed" not in text


def test_an_assumed_shape_is_called_one(arm, tmp_path):
    guess = assess(arm, CLOSE, task="planar", poses=30, clearance=True)
    text = guess.report(tmp_path / "r.html").read_text().replace("\u00a0", " ")
    assert "The shape of the arm is assumed" in text
    assert "assumed radius" in text


@pytest.mark.parametrize(
    ("optimise", "capsules", "margin", "words"),
    [
        (True, "default", 0.0, ""),
        (True, None, 0.0, "--no-clearance"),
        (True, 0.05, 0.0, "--radius 0.05"),
        (False, None, 0.0, ""),
        (False, "default", 0.0, "--clearance"),
        (True, "default", 0.125, "--margin 0.125"),
        (True, "assumed", 0.0, "--radius 0.07113"),
        (True, "own", 0.25, "--capsules capsules.yaml --margin 0.25"),
    ],
)
def test_the_command_makes_the_same_run(optimise, capsules, margin, words):
    arm = arms.load("panda")
    own = Capsules(
        (LinkCapsule(-1, (0, 0, 0), (0, 0, 0.3), radius=0.1), LinkCapsule(6, (0, 0, 0.1), (0, 0, 0.1), radius=0.07)), ((0, 2),)
    )
    usual = {"default": choose_capsules(arm), "assumed": Capsules.along_links(arm)}
    shape = {"own": own, None: None, **usual}.get(capsules) or (
        None if capsules is None else Capsules.along_links(arm, capsules)
    )
    clearance = False if shape is None else Clearance(arm, shape)
    index = hf.indices.relative_manipulability(arm)
    plan = make_plan(arm, CLOSE, index, 10, 0, "random", 100, optimise, False, None, clearance, margin)
    a = hf.Assessment(**dict.fromkeys((f.name for f in dataclasses.fields(hf.Assessment) if f.init), None) | {"plan": plan})
    command, _ = build_command_line(a)
    options = " ".join(command.replace("\\\n", " ").split()).partition("--restarts 100")[2].replace("--optimise", "").strip()
    assert options.startswith(words) if capsules == "assumed" else options == words
    files = build_shape_file_blocks(a)
    assert len(files) == (capsules == "own")
    if files:
        assert Capsules.from_dict(yaml.safe_load(files[0].text), arm) == own
