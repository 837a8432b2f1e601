"""What a notebook shows of every result and of what results are asked with."""

from __future__ import annotations

import pickle
import sys
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import numpy as np
import pytest
from matplotlib.figure import Figure

import holdfast as hf
from cards import check_card
from holdfast.core.errors import InputError
from holdfast.interface.presentation import PRESENTER_MODULES, call_presenter

X, TARGET = np.array([0.3, 0.5, 0.7]), [1.5, 1.5]


@cache
def arm():
    return hf.arms.load("planar-3r")


@cache
def law():
    return hf.control.Pseudoinverse(arm(), "planar")


@cache
def index():
    return hf.indices.relative_manipulability(arm(), "planar")


@cache
def region():
    return hf.Region.around_tool(arm(), X)


@cache
def path():
    here = arm().forward_kinematics(X)
    there = here.copy()
    there[0, 3] -= 0.05
    return hf.paths.line(here, there, name="<b>across</b>")


@cache
def timed():
    return hf.paths.TimedPath(path(), hf.paths.Constant(1.0))


def found(function, *args, **options):
    """Made when it is asked for, once."""
    return cache(lambda: function(*args, **options))


FOUR = [[-1, 1], [0.3, 0.4], [0.3, 0.4], [-1, 1]]


def four():
    return hf.Arm.from_dh([hf.DH(1.0, 0.0, 0.0)] * 4, name="planar-4r")


@cache
def proof():
    return hf.certify(hf.certificates.reach_claim(arm(), (1.5, 0.5), 0.1), halvings=1)


def recovered():
    return hf.recover(arm(), "joint2", X, goal="home", region=region(), samples=20)


MADE = {
    "Arm": arm,
    "Assessment": lambda: assessed(),
    "Basins": found(lambda: hf.basins(law(), TARGET, {1: 1.0}, starts=4)),
    "ManipulabilityBound": found(lambda: hf.certify(hf.certificates.ceiling_claim(four(), FOUR, 0.4, task="planar-pose"))),
    "CellCheck": found(lambda: hf.check_cell(hf.Cell([hf.cell.Sphere("ball", 0.1, pose=[1.0, 1.0, 0.5])]), arm())),
    "CertificateCheck": lambda: hf.check_certificate(proof().write(Path(mkdtemp()) / "a.certificate")),
    "Comparison": lambda: hf.compare_assessments([assessed(), assessed()], names=["one", "<b>two</b>"]),
    "Configurations": found(lambda: hf.all_configurations(arm(), TARGET, "planar")),
    "ConvergenceMap": lambda: mapped(),
    "RecordBook": found(hf.designs.record_designs),
    "UpperBound": found(hf.index_bounds.upper_bound, n=8, m=6, k=2),
    "UpperBoundTable": found(hf.index_bounds.bound_table, 6),
    "SingularValueBound": found(hf.index_bounds.bound_singular_value, n=7, m=3),
    "FaultBatch": found(lambda: hf.faults.FaultModel([hf.faults.weak(gain=0.3, onset=1.0)]).batch(arm(), episodes=2)),
    "ArmComparison": found(lambda: hf.designs.compare_arms(arm(), task="planar", measures=["fraction-above"], samples=200)),
    "DesignRecord": found(hf.designs.record_design, "pose-9R-k2-001"),
    "RecordCheck": found(lambda: hf.designs.record_design("pose-9R-k2-001").check()),
    "Curves": found(lambda: hf.stationary_points(law(), TARGET, "joint2")),
    "LockSurvival": found(lambda: hf.plan_motion(arm(), timed(), task="planar", samples=5, spacing=0.3)),
    "HoldCheck": found(lambda: hf.holds(arm(), X)),
    "Law": law,
    "LawChoice": found(
        lambda: hf.compare_laws([law(), hf.control.damped(arm(), 0.3, "planar")], 2, 1, best=True, configurations=1)
    ),
    "LawComparison": found(
        lambda: hf.compare_laws([law(), hf.control.damped(arm(), 0.3, "planar")], [X, X + 0.1], TARGET, restarts=2)
    ),
    "Objective": index,
    "Optima": found(lambda: hf.optimise(arm(), arm().forward_kinematics(X), index(), starts=3)),
    "Path": path,
    "PathProof": found(
        lambda: hf.certify(hf.certificates.path_claim(arm(), np.array([[0.3, 0.8, 1.1], [0.4, 0.7, 1.2]]), task="planar"))
    ),
    "PoseExplanation": found(lambda: hf.explain_ik(arm(), TARGET, task="planar", starts=5)),
    "ReachabilityMap": found(lambda: hf.reachability_map(arm(), samples=2000, lock_values=2, cell_size=0.3)),
    "PowerLoss": found(lambda: hf.power_loss(arm(), X, friction=hf.Friction(coulomb=3.0), duration=0.3)),
    "BrakeComparison": found(
        lambda: hf.compare_brakes(arm(), X, torque=[3.0, 9.0], after=[0.0, 0.1], friction=hf.Friction(coulomb=1.0))
    ),
    "DropCurve": found(lambda: hf.power_loss_along(arm(), X + np.linspace(0, 0.3, 6)[:, None], np.arange(6.0), duration=0.3)),
    "DropProbability": found(lambda: hf.power_loss_probability(arm(), 0.1, samples=100, duration=0.3)),
    "StowPose": found(lambda: hf.stow(arm(), X, friction=hf.Friction(coulomb=9.0), speeds=1.0, samples=500)),
    "StowPath": lambda: hf.plan_stow_path(MADE["StowPose"](), nodes=50, tolerance=3.0, duration=0.3),
    "PhysicalFall": lambda: MADE["PowerLoss"]().physical(),
    "Recovery": recovered,
    "Proof": lambda: proof(),
    "Refutation": found(lambda: hf.certify(hf.certificates.out_of_reach_claim(arm(), (2.9, 1.4), 0.1))),
    "Region": region,
    "Runs": found(lambda: hf.simulate(law(), X, TARGET, locked={"joint2": None})),
    "SelfMotion": found(lambda: hf.self_motion(arm(), TARGET, "planar", starts=4)),
    "StationaryPoints": found(lambda: hf.stationary_points(law(), TARGET, {1: 1.0})),
    "StructuralZero": found(lambda: hf.certify(hf.certificates.structural_zero_claim(hf.arms.load("iiwa14"), 3))),
    "Task": lambda: index().task,
    "TimedPath": timed,
    "TolerantProof": found(
        lambda: hf.certify(hf.certificates.tolerant_claim(arm(), (1.5, 0.5), 0.1, working_ranges={0: (0, 0.5)}, failures=[0]))
    ),
    "TolerantWorkspace": found(
        lambda: hf.tolerant_workspace(arm().with_limits([-2] * 3, [2] * 3), "planar", points=4, angles=2)
    ),
    "TradeOff": found(lambda: hf.control.trade_off(arm(), "planar", samples=10, allowed=[0, 0.5])),
    "Trajectory": found(lambda: hf.follow(arm(), timed(), maximise=index(), q=X, samples=5)),
    "WaypointCheck": lambda: recovered().check(),
    "WorkingRanges": found(lambda: hf.find_working_ranges(arm(), (1.5, 0.5), 0.1, targets=2, values=8)),
    "RemainingWorkspace": lambda: recovered().left,
}
INPUTS = {"Arm", "Law", "Objective", "Path", "Region", "Study", "Task", "TimedPath"}
WITHOUT_FIGURE = {
    "CellCheck",
    "HoldCheck",
    "CertificateCheck",
    "Configurations",
    "Optima",
    "PoseExplanation",
    "StationaryPoints",
}
WITHOUT_FIGURE |= {
    "RecordBook",
    "UpperBound",
    "UpperBoundTable",
    "SingularValueBound",
    "FaultBatch",
    "ArmComparison",
    "DesignRecord",
    "RecordCheck",
}
WITHOUT_FIGURE |= {"HoldCheck", "StowPose", "StructuralZero", "WaypointCheck", "WorkingRanges"}
ELSEWHERE = {
    "Examination",
    "PoseExplanation",
    "ReachabilityMap",
    "BisectionResult",
    "Analysis",
    "Bounds",
    "ConvergenceDesigns",
    "Designs",
    "Diagnosis",
    "Execution",
    "Identification",
    "Observability",
    "ProbingMotion",
    "FaultRun",
    "MergeReport",
    "Orbit",
    "PhysicalRun",
    "Study",
    "TargetMeasures",
    "TaskChoice",
    "Workspace",
}


@cache
def assessed():
    return hf.assess(arm(), region(), index(), poses=8)


@cache
def mapped():
    return hf.convergence_map(law(), 1, 2, configurations=1)


def test_every_class_that_a_notebook_shows_is_shown_here():
    """A new one is to be made above; what is dear to make has a card where it is tested."""
    assert set(MADE) | ELSEWHERE == {name.rpartition(".")[2] for name in PRESENTER_MODULES}


@pytest.mark.parametrize("name", sorted(MADE))
def test_a_card_has_a_table_and_the_main_figure(name):
    check_card(MADE[name](), name not in {*INPUTS, *WITHOUT_FIGURE} - {"Arm"})


@pytest.mark.parametrize("name", sorted(MADE))
def test_what_was_computed_goes_to_another_process(name):
    """As joblib and multiprocessing send it; after its card was drawn, with all that was compiled for it."""
    result = MADE[name]()
    again = pickle.loads(pickle.dumps(result))
    assert type(again) is type(result)
    assert again._repr_html_().split("<svg")[0] == result._repr_html_().split("<svg")[0]


def test_a_figure_is_plotted_by_its_name():
    choice = MADE["TradeOff"]()
    figure = choice.plot()
    assert isinstance(figure, Figure)
    data, size = figure._repr_png_()
    assert data.startswith(b"\x89PNG")
    assert size == {"width": 960.0, "height": pytest.approx(96 * 3.9)}
    assert plt_knows_nothing()
    assert isinstance(choice.plot("trade-off"), Figure)
    with pytest.raises(InputError, match="TradeOff has no figure 'x'; it has trade-off"):
        choice.plot("x")
    with pytest.raises(InputError, match=r"WaypointCheck has no figure; use result.describe\(\) instead"):
        MADE["WaypointCheck"]().plot()


@pytest.mark.parametrize("name", ["ConvergenceMap", "LawComparison"])
def test_a_figure_that_nobody_asks_for_is_not_drawn(name, monkeypatch):
    result, made = MADE[name](), []
    make = Figure.__init__
    monkeypatch.setattr(Figure, "__init__", lambda self, *args, **options: made.append(self) or make(self, *args, **options))
    names = list(call_presenter(result, "present").figures)
    assert len(names) > 1
    assert made == []
    assert result.plot(names[-1]) in made
    assert len(made) == 1
    assert list(result.figures()) == names


def plt_knows_nothing():
    pyplot = sys.modules.get("matplotlib.pyplot")
    return pyplot is None or pyplot.get_fignums() == []


def test_what_ipython_prints_is_what_people_read():
    said = []

    class Printer:
        text = staticmethod(said.append)

    MADE["TradeOff"]()._repr_pretty_(Printer, False)
    assert said == ["\n".join(MADE["TradeOff"]().describe())]
