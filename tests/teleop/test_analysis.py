"""The analysis from a table of trials to a report."""

import re
import sys
from xml.etree import ElementTree

import numpy as np
import pandas as pd
import pytest

import holdfast as hf
from cards import check_card
from holdfast.core.errors import HoldfastError, InputError, StoreError
from holdfast.interface.presentation.teleop.motions import ring
from holdfast.teleop.analysis import analyse
from holdfast.teleop.analysis.groups import group_by_difficulty
from holdfast.teleop.protocol.protocol import read_protocol
from holdfast.teleop.trials.performance import compute_cpm

NAMES = [f"M{k}" for k in range(1, 13)]
SCENARIOS = (
    (1, "pseudoinverse", False),
    (2, "failure-tolerant", False),
    (3, "pseudoinverse", True),
    (4, "failure-tolerant", True),
)


def trials(rng, subjects=6, tasks=9, scenarios=SCENARIOS, kind="simulated", rated=True):
    """Measures that grow with the task's number where the arm has failed, less so in the last scenario."""
    rows = []
    for s in range(subjects):
        skill = rng.lognormal(0, 0.1)
        for t in range(1, tasks + 1):
            for number, law, failed in scenarios:
                hard = 1 + (0.5 * t if failed else 0) * (0.6 if number == 4 else 1) + (0.8 if number in (2, 4) else 0)
                m = skill * hard * rng.lognormal(0, 0.15, 12)
                rating = float(np.clip(round(hard - 1), 0, 3)) if rated else np.nan
                row = dict(zip(NAMES, [*m[:11], rating], strict=True))
                rows.append(
                    {
                        "subject": f"S{s + 1:02d}",
                        "kind": kind,
                        "number": s + 1,
                        "row": s,
                        "position": t,
                        "task": t,
                        "scenario": number,
                        "law": law,
                        "failed": failed,
                        "joint": "joint1" if failed else "",
                        "end": "arrived",
                        "cycles": int(40 * m[0]),
                        **row,
                    }
                )
    return pd.DataFrame(rows)


def lose(table, subject, tasks, scenario, end="aborted"):
    """The table with trials of a subject that did not arrive."""
    out = table.copy()
    where = (out["subject"] == subject) & out["task"].isin(tasks) & (out["scenario"] == scenario)
    assert where.sum() == len(tasks)
    out.loc[where, "end"] = end
    out.loc[where, NAMES[:11]] = np.nan
    return out


@pytest.fixture
def table(rng):
    return trials(rng)


@pytest.fixture
def computer(rng):
    return trials(rng, subjects=1, kind="computer", rated=False)


def test_cells_are_means_of_the_cpm_over_tasks(table, computer):
    a = analyse(table, computer)
    check_card(a)
    mine = table.assign(cpm=compute_cpm(table[NAMES].to_numpy()).values)
    np.testing.assert_allclose(a.observed.normalisers, table[NAMES].max())
    third = mine[mine["scenario"] == 3].groupby("task")["cpm"].median().sort_values()
    assert a.groups.names == ("easy", "medium", "difficult")
    of_cells = a.table("cells").set_index(["law", "difficulty"]).sort_index()
    for b, name in enumerate(a.groups.names):
        tasks = third.index[3 * b : 3 * b + 3]
        for c, law in ((3, "pseudoinverse"), (4, "failure-tolerant")):
            chosen = mine[mine["task"].isin(tasks) & (mine["scenario"] == c)].groupby("subject")["cpm"].mean()
            ours = of_cells.loc[[(law, name)]].sort_values("subject")
            np.testing.assert_allclose(ours["cpm"], chosen, rtol=1e-12)
            assert (ours["tasks"] == 3).all()
    wide = a.table("cells_wide")
    np.testing.assert_allclose(wide["failure_tolerant_easy"], a.cells.values[:, 1, 0])
    assert a.law_means()["pseudoinverse"] == pytest.approx(a.cells.values[:, 0].mean())
    assert a.group_means()["easy"] == pytest.approx(a.cells.values[:, :, 0].mean())
    t = a.table("comparisons").set_index("difficulty")["t"]
    difference = a.cells.values[:, 0, 2] - a.cells.values[:, 1, 2]
    assert t["difficult"] == pytest.approx(difference.mean() / difference.std(ddof=1) * np.sqrt(6))
    assert (a.table("comparisons")["p_holm"] >= a.table("comparisons")["p"]).all()


def test_difficulties_are_medians_over_operators(table, computer):
    a = analyse(table, computer)
    of_tasks = a.table("tasks").set_index("task").sort_index()
    machine = computer[computer["scenario"] == 3].sort_values("task")
    anticipated = compute_cpm(computer[NAMES[:11]].to_numpy()).values[(computer["scenario"] == 3).to_numpy()]
    np.testing.assert_allclose(of_tasks["anticipated"], anticipated[np.argsort(machine["task"])])
    felt = table[table["scenario"] == 3].groupby("task")["M12"].median()
    np.testing.assert_allclose(of_tasks["perceived"], felt)
    found = a.correlation("actual", "anticipated")
    assert found.r == pytest.approx(np.corrcoef(of_tasks["actual"], of_tasks["anticipated"])[0, 1])
    of_trials = a.table("trials").set_index(["task", "scenario", "subject"])["cpm"].sort_index()
    for task, row in of_tasks.iterrows():
        every = of_trials.loc[task, 3]
        assert abs(every[row["median_operator"]] - row["actual"]) == pytest.approx((every - row["actual"]).abs().min())
    with pytest.raises(InputError, match=r"no correlation of 'felt' and 'actual'; there are: anticipated and actual"):
        a.correlation("felt", "actual")


def test_the_order_of_rows_and_columns_does_not_matter(rng, table):
    a = analyse(table)
    shuffled = table.sample(frac=1, random_state=int(rng.integers(2**31)))[list(reversed(table.columns))]
    b = analyse(shuffled)
    pd.testing.assert_frame_equal(a.table("anova"), b.table("anova"))
    pd.testing.assert_frame_equal(a.table("trials"), b.table("trials"))


def test_healthy_arm_is_compared_measure_by_measure(table):
    healthy = analyse(table).table("healthy").set_index("measure")
    means = table.groupby(["scenario", "subject"])["M1"].mean()
    difference = (means[1] - means[2]).to_numpy()
    assert healthy.loc["M1", "difference"] == pytest.approx(difference.mean())
    assert healthy.loc["M1", "t"] == pytest.approx(difference.mean() / difference.std(ddof=1) * np.sqrt(6))
    assert healthy.loc["M1", ["first", "second"]].tolist() == ["pseudoinverse", "failure-tolerant"]
    assert healthy.index.tolist() == ["CPM", *NAMES]


def test_rounding_is_not_a_difference(rng, table):
    noise = rng.random(len(table)) * 1e-15 + (table["scenario"] == 2) * 1e-14
    table["M7"] = table["M7"].where(table["failed"], noise)
    healthy = analyse(table).table("healthy").set_index("measure")
    assert healthy.loc["M7", "difference"] == 0
    assert np.isnan(healthy.loc["M7", "p_holm"])


# ---- missing -------------------------------------------------------------------------------------------------------------


def test_missing_trials_are_counted_and_declared(table):
    lost = lose(table, "S02", [5], 3)
    lost = lose(lost, "S04", [5, 7], 4, "time")
    lost = lost.drop(lost.query("subject == 'S01' and task == 2 and scenario == 1").index)
    lost.loc[lost.query("subject == 'S05' and task == 1 and scenario == 2").index, "M12"] = np.nan
    a = analyse(lost)
    missing = a.table("missing").set_index(["subject", "task", "scenario"])["cause"].to_dict()
    assert missing == {
        ("S02", 5, 3): "aborted",
        ("S04", 5, 4): "time",
        ("S04", 7, 4): "time",
        ("S01", 2, 1): "not recorded",
        ("S05", 1, 2): "no rating",
    }
    ends = a.table("ends").set_index("scenario")
    assert ends["with_cpm"].tolist() == [53, 53, 53, 52]
    assert ends.loc[4, "time"] == 2
    said = " ".join(a.notes)
    assert "5 trials of 216 have no CPM (1 in scenario 1, 1 in scenario 2, 1 in scenario 3, 2 in scenario 4)" in said
    assert re.search(r"[23] of 36 cell means are over fewer tasks", said)
    assert a.anova is not None
    assert not a.left_out


def easiest(table):
    """The tasks of the easiest group."""
    of_tasks = analyse(table).table("tasks")
    return of_tasks.loc[of_tasks["difficulty"] == "easy", "task"].tolist()


def test_an_empty_cell_is_refused_and_named(table):
    lost = lose(table, "S03", easiest(table), 4)
    with pytest.raises(InputError, match=r"1 is empty: S03 / failure-tolerant / easy; missing='complete' leaves"):
        analyse(lost)


def test_complete_leaves_subjects_out_and_lists_them(table):
    lost = lose(table, "S03", easiest(table), 4)
    a = analyse(lost, missing="complete")
    assert a.left_out == ("S03",)
    assert a.observed.subjects == ("S01", "S02", "S04", "S05", "S06")
    assert "1 subject left out completely because of empty cells: S03." in a.notes
    without = analyse(lost[lost["subject"] != "S03"])
    assert a.anova == without.anova
    for s in ("S01", "S02", "S04", "S05", "S06"):
        lost = lose(lost, s, list(range(1, 10)), 3)
    with pytest.raises(InputError, match=r"only 0 of the subjects"):
        analyse(lost, missing="complete")


def test_mixed_model_of_complete_data_has_the_cell_means(table):
    a = analyse(table, missing="mixed")
    assert a.anova is None
    assert a.mixed is not None
    assert a.mixed.converged
    assert a.mixed.trials == 108
    np.testing.assert_allclose(a.mixed.means, a.cells.values.mean(axis=0), rtol=1e-6)  # balanced: closed form
    assert [t.df for t in a.mixed.tests] == [1, 2, 2]
    assert a.table("mixed")["converged"].tolist() == [1, 1, 1]
    assert any("mixed model of 108 single trials" in line and "NOT converged" not in line for line in a.describe())


def test_mixed_model_fills_empty_cells(table):
    full = analyse(table, missing="mixed")
    a = analyse(lose(table, "S03", easiest(table), 4), missing="mixed")
    assert a.mixed is not None
    assert full.mixed is not None
    assert a.mixed.trials == 105
    np.testing.assert_allclose(a.mixed.means, full.mixed.means, atol=0.15)
    assert a.table("comparisons")["n"].tolist() == [5, 6, 6]
    assert np.isnan(a.cells.values).sum() == 1


def test_mixed_model_finds_the_variances_it_was_made_with(rng):
    """CPM made of subject, task and rest: their variances come back, within their sampling error."""
    table = trials(rng, subjects=20, tasks=18, rated=False)
    subject, task = rng.normal(0, 0.5, 20), rng.normal(0, 0.05, 18)
    s, t = table["number"].to_numpy() - 1, table["task"].to_numpy() - 1
    value = 10 + subject[s] + task[t] + t // 6 * 3 + rng.normal(0, 0.2, len(table))
    table[NAMES[:11]] = value[:, None] * np.ones(11)
    a = analyse(table, missing="mixed")
    assert a.mixed is not None
    scale = 11 / value.max()  # CPM is eleven times this measure over its largest value
    found = {name: np.sqrt(v) / scale for name, v in a.mixed.variances.items()}
    assert found["subject"] == pytest.approx(subject.std(ddof=1), rel=0.1)
    assert found["rest"] == pytest.approx(0.2, rel=0.15)


def test_who_never_arrives_counts_as_worst(table):
    lost = table
    for s in ("S01", "S02", "S03", "S04"):
        lost = lose(lost, s, [1], 3)
    a = analyse(lost)
    assert a.table("tasks")["task"].iloc[-1] == 1
    assert np.isinf(a.groups.difficulty[0])
    assert any("Task 1: no difficulty is known" in n for n in a.notes)
    assert a.correlation("actual", "perceived").left_out == ("task 1",)


# ---- choices -------------------------------------------------------------------------------------------------------------


def test_any_number_of_groups(table):
    found = group_by_difficulty(np.array([3.0, np.nan, 1.0, np.inf, 2.0, 0.5, 7.0]), 3, "operators")
    assert found.sizes.tolist() == [3, 2, 2]
    assert found.of_task.tolist() == [1, 2, 0, 2, 0, 0, 1]
    a = analyse(table, groups=4)
    assert a.groups.names[0] == "level 1 of 4"
    assert a.groups.sizes.tolist() == [3, 2, 2, 2]
    assert a.anova is not None
    assert a.anova.effect("law x difficulty").df == 3
    assert any("The groups have 3, 2, 2, 2 tasks" in n for n in a.notes)
    for count in (1, 10):
        with pytest.raises(InputError, match=rf"9 tasks cannot be put in {count} groups"):
            analyse(table, groups=count)


def test_three_laws(rng):
    table = trials(rng, scenarios=(*SCENARIOS, (5, "weighted", True), (6, "weighted", False)))
    a = analyse(table, trials(rng, 1, scenarios=(*SCENARIOS, (5, "weighted", True), (6, "weighted", False)), kind="computer"))
    assert a.cells.laws == ("pseudoinverse", "failure-tolerant", "weighted")
    assert len(a.table("comparisons")) == 9
    assert len(a.table("healthy")) == 3 * 13
    b = analyse(table, reference=5)
    assert b.cells.laws[0] == "weighted"
    assert b.table("comparisons")["first"].iloc[0] == "weighted"
    with pytest.raises(InputError, match=r"reference is scenario 2, with the healthy arm"):
        analyse(table, reference=2)
    with pytest.raises(InputError, match=r"no scenario 9; there are 1, 2, 3, 4, 5, 6"):
        analyse(table, reference=9)


def test_the_same_law_with_other_options_is_told_apart(rng):
    table = trials(rng, scenarios=(*SCENARIOS, (5, "failure-tolerant", True)))
    assert analyse(table).cells.laws == ("pseudoinverse", "failure-tolerant (4)", "failure-tolerant (5)")


def test_computer_sorts_the_tasks(table, computer):
    a = analyse(table, computer, difficulty="computer")
    anticipated = a.table("tasks").set_index("task")["anticipated"].sort_index()
    assert a.groups.of_task.tolist() == (anticipated.rank().to_numpy() - 1).astype(int).__floordiv__(3).tolist()
    with pytest.raises(InputError, match=r"without its trials"):
        analyse(table, difficulty="computer")
    lost = lose(computer.assign(subject="S01"), "S01", [1], 3, "still")
    worst = analyse(table, lost, difficulty="computer")
    assert worst.groups.of_task[0] == 2
    assert any("not completed by the computer" in n for n in worst.notes)


def test_normalisers_apart_and_together(table, computer):
    computer[NAMES[:11]] *= 3
    apart, together = analyse(table, computer), analyse(table, computer, normalise="together")
    assert apart.computer is not None
    assert together.computer is not None
    np.testing.assert_allclose(apart.observed.normalisers, table[NAMES].max())
    largest = np.maximum(table[NAMES[:11]].max(), computer[NAMES[:11]].max())
    np.testing.assert_allclose(together.observed.normalisers[:11], largest)
    np.testing.assert_allclose(together.computer.normalisers, largest)
    assert together.observed.normalisers[11] == table["M12"].max()


def test_without_ratings_cpm_has_eleven_measures(rng):
    table = trials(rng, rated=False)
    a = analyse(table)
    assert len(a.observed.normalisers) == 11
    assert any("No trial was rated" in n for n in a.notes)
    assert len(a.table("failed")) == 12
    assert not a.correlations


# ---- bad input -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda t: t.drop(columns="M3"), r"no column 'M3'"),
        (lambda t: t.iloc[:0], r"no trials"),
        (lambda t: t.assign(kind=["person"] * 100 + ["simulated"] * 116), r"kind person and simulated; analyse one"),
        (lambda t: t.assign(end="done"), r"ended 'done'; the end must be one of arrived, still"),
        (lambda t: pd.concat([t, t.iloc[:1]]), r"subject S01, task 1, scenario 1 twice"),
        (lambda t: t.assign(M2=-1.0), r"M2 = -1 for subject S01, task 1, scenario 1"),
        (lambda t: t.assign(M2=np.nan), r"M2 = nan"),
        (lambda t: t.assign(law=["x", *t["law"][1:]]), r"scenario 1 with different laws"),
        (lambda t: t[t["scenario"] != 4], r"has 1 scenarios with the failed arm; comparing laws needs 2"),
        (lambda t: t[t["subject"] == "S01"], r"one subject"),
    ],
)
def test_bad_tables_are_refused(table, change, message):
    with pytest.raises(InputError, match=message):
        analyse(change(table))


def test_bad_options_are_refused(table, computer):
    for name, value in (("missing", "drop"), ("difficulty", "mine"), ("normalise", "no")):
        with pytest.raises(InputError, match=rf"{name} is '{value}'; it is one of"):
            analyse(table, **{name: value})
    with pytest.raises(InputError, match=r"0 < limit < power < 1"):
        analyse(table, limit=5)
    with pytest.raises(InputError, match=r"computer's table has no task 9"):
        analyse(table, computer[computer["task"] < 9])
    with pytest.raises(InputError, match=r"computer's table has no scenario 4: failed, failure-tolerant"):
        analyse(table, computer[computer["scenario"] < 4])
    with pytest.raises(InputError, match=r"has 6 subjects; it must have one"):
        analyse(table, table)
    with pytest.raises(InputError, match=r"no table 'x'; there are trials, "):
        analyse(table).table("x")


# ---- output --------------------------------------------------------------------------------------------------------------


def test_report_and_tables(rng, tmp_path):
    """All of it: every table opens again with the same numbers, every figure says what it is."""
    table, machine = trials(rng), trials(rng, 1, kind="computer", rated=False)
    a = analyse(lose(table, "S02", [5], 3), lose(machine.assign(subject="S01"), "S01", [9], 3, "still"))
    protocol = read_protocol()

    def paths(subject, task, scenario):
        start, target = protocol.arm.forward_kinematics(protocol.tasks.q0[task - 1])[:2, 3], protocol.tasks.target[task - 1]
        return None if subject is None and task == 2 else np.linspace(start, target, 30)

    page = a.save(tmp_path / "new" / "experiment", protocol, paths, show=[2])[0].read_text(encoding="utf-8")
    assert "Teleoperation with a failed joint: 6 simulated subjects" in page
    assert page.count("<svg") == 7
    assert len(re.findall(r"<figcaption>Simulated operators", page)) == 7
    for caption in re.findall(r"<caption>\s*(.*?)</caption>", page)[:-1]:
        assert "simulated" in caption
    assert "task 9" in page
    assert not re.search(r"https?://(?!www\.w3\.org)", page)
    for text in re.findall(r"<svg.*?</svg>", page, flags=re.DOTALL):
        ElementTree.fromstring(text)
    folder = tmp_path / "new" / "experiment"
    known = pd.read_csv(folder / "data_dictionary.csv", keep_default_na=False)
    assert {f.stem for f in folder.glob("*.csv")} == {*a.tables, "data_dictionary"}
    for name, mine in a.tables.items():
        again = pd.read_csv(folder / f"{name}.csv", na_values=["NA"], keep_default_na=False)
        assert list(again.columns) == list(mine.columns)
        assert all(re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", c) for c in again.columns)
        assert (again["data"] == "simulated").all()
        for c in mine.select_dtypes("number"):
            np.testing.assert_allclose(again[c].to_numpy(float), mine[c].to_numpy(float), rtol=1e-14)
        listed = known[(known["table"] == name) & (known["column"] != "")]
        assert listed["column"].tolist() == list(mine.columns)
        assert (listed["meaning"] != "").all()


def test_people_three_laws_and_a_mixed_model(rng, tmp_path):
    table = trials(rng, tasks=6, scenarios=(*SCENARIOS[2:], (5, "weighted", True)), kind="person")
    lost = lose(table, "S03", [1, 2, 3], 4)
    a = analyse(lost, missing="mixed")
    page = a.save(tmp_path, show=[])[0].read_text(encoding="utf-8")
    assert "simulated" not in page.lower()
    assert "simulated" not in " ".join(a.describe())
    assert a.subject_phrase == "6 subjects"
    assert "Mixed model: Wald tests" in page
    assert "restricted maximum likelihood" in page
    assert not (tmp_path / "anova.csv").exists()
    assert "healthy" not in a.tables


def test_unwritable_folders_and_unknown_tasks(table, tmp_path):
    a = analyse(table)
    (tmp_path / "file").write_text("")
    with pytest.raises(StoreError, match=r"choose another folder"):
        a.save(tmp_path / "file")
    with pytest.raises(InputError, match=r"no task 99; the tasks are 1 to 9"):
        a.save(tmp_path, show=[99])


# ---- workspaces ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("locked", [None, 0, 1, 2])
def test_ring_is_what_random_configurations_reach(rng, locked):
    arm = hf.arms.load("planar-3r")
    q = rng.uniform(-np.pi, np.pi, (40_000, 3))
    start = q[0].copy()
    if locked is not None:
        q[:, locked] = start[locked]
    found = ring(arm, start, locked)
    assert found is not None
    distance = np.linalg.norm(arm.forward_kinematics(q)[:, :2, 3] - found.centre, axis=1)
    assert distance.max() <= found.outer + 1e-9
    assert distance.min() >= found.inner - 1e-9
    assert distance.max() == pytest.approx(found.outer, abs=0.02)
    assert distance.min() == pytest.approx(found.inner, abs=0.05)


def test_only_planar_arms_have_a_ring():
    assert ring(hf.arms.load("pa10-7dof"), np.zeros(7)) is None


def test_without_statsmodels_it_is_said_what_to_install(table, monkeypatch):
    monkeypatch.setattr(sys.modules["holdfast.teleop.analysis.computation"], "find_spec", lambda name: None)
    with pytest.raises(HoldfastError, match=r"pip install 'holdfast-arms\[stats\]'"):
        analyse(table)
