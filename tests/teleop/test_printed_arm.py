"""The arm of the page, run by Node, against the arm that Python replays."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import holdfast as hf
import javascript as browser
import oracles
from holdfast.core.errors import TaskError
from holdfast.core.registry import LAW_REGISTRY
from holdfast.model.arm.task import as_task
from holdfast.teleop.protocol import protocol
from holdfast.teleop.protocol.printed_arm import generate_arm_javascript, number_scenario_laws
from holdfast.teleop.records.tables import run_computer_trials
from holdfast.teleop.trials.plant import JoystickPlant
from holdfast.teleop.trials.scenarios import Scenario

CYCLES = """\
import {cycle,joints as n,axes as m} from "./arm.mjs";
const out=new Float64Array(n+m),wide=1+2*n+m;
for(let k=0;k<input.length/wide;k++){
const row=input.subarray(k*wide,(k+1)*wide);
cycle(row[0],row.subarray(1,1+n),row.subarray(1+n,1+n+m),row.subarray(1+n+m),out);
output.set(out,k*(n+m));
}"""
PLACES = """\
import {position,points,joints as n,axes as m,markers} from "./arm.mjs";
const x=new Float64Array(m),wire=new Float64Array(3*markers);
for(let k=0;k<input.length/n;k++){
const q=input.subarray(k*n,(k+1)*n);
position(q,x);points(q,wire);
output.set(x,k*(m+3*markers));output.set(wire,k*(m+3*markers)+m);
}"""
TRIALS = """\
import {cycle,position,joints as n,axes as m} from "./arm.mjs";
const out=new Float64Array(n+m);
let from=0,to=0;
for(const count of [COUNTS]){
const law=input[from],q=input.slice(from+1,from+1+n),healthy=input.subarray(from+1+n,from+1+2*n);
from+=1+2*n;
for(let k=0;k<count;k++){
cycle(law,q,input.subarray(from,from+m),healthy,out);
from+=m;
q.set(out.subarray(0,n));
position(q,output.subarray(to,to+m));
to+=m;
}
}"""


def every_law(arm, rows, substeps, rng):
    """The paper's experiment with another arm, and a scenario for each registered law."""
    named = [LAW_REGISTRY.read_label(label) for label in LAW_REGISTRY.labels(arm, rows)]
    scenarios = tuple(Scenario(k + 1, law.name, False, options=options) for k, (law, options) in enumerate(named))
    return dataclasses.replace(
        protocol.read_protocol(), arm=arm, rows=as_task(arm, rows), scenarios=scenarios, substeps=substeps
    )


def draws(rng, experiment, count):
    """Configurations, commands up to the stick's limit, and which joints are healthy."""
    n, m = experiment.arm.n, experiment.rows.m
    v = rng.normal(size=(count, m))
    v *= rng.uniform(0, 0.05, (count, 1)) / np.linalg.norm(v, axis=1, keepdims=True)
    v[::50] = 0
    return rng.uniform(-3, 3, (count, n)), v, (rng.random((count, n)) > 0.2).astype(float)


def in_page(module, law, q, v, healthy):
    """(N, n + m) what the page makes of cycles."""
    rows = np.hstack([np.full((len(q), 1), law), q, v, healthy])
    width = q.shape[1] + v.shape[1]
    return browser.run(CYCLES, rows, len(q) * width, arm=module).reshape(len(q), width)


def task_jacobian(experiment, q):
    return np.einsum("ij,njk->nik", experiment.rows.rows, experiment.arm.jacobian(q))


def peak_error(j, v, rates):
    """The largest velocity error over all single locked joints, per unit of command (Goel et al. 2003, eq. 8)."""
    hand = np.einsum("nij,nj->ni", j, rates)
    errors = [np.linalg.norm(v - (hand - j[:, :, i] * rates[:, i : i + 1]), axis=1) for i in range(j.shape[2])]
    return np.max(errors, axis=0) / np.linalg.norm(v, axis=1)


@pytest.mark.parametrize(
    ("which", "rows", "count"), [("planar-3r", "planar", 2_000), ("flat4", "planar", 400), ("panda", "position", 400)]
)
def test_control_steps_agree_with_python(which, rows, count, rng, flat4):
    """Every registered law; to rounding, or, where two dampings are as good as each other, in the peak velocity error."""
    arm = flat4 if which == "flat4" else hf.arms.load(which)
    experiment = every_law(arm, rows, 1, rng)
    q, v, healthy = draws(rng, experiment, count)
    cond = np.linalg.cond(task_jacobian(experiment, q))
    module = generate_arm_javascript(experiment)
    for law, scenario in zip(number_scenario_laws(experiment), experiment.scenarios, strict=True):
        mask = np.ones_like(healthy) if scenario.law == "failure-tolerant" else healthy
        found = in_page(module, law, q, v, mask)
        moved, actual = JoystickPlant(scenario.make_law(experiment.arm, experiment.rows), 1).step_batch(q, v, mask)
        off = np.abs(found - np.hstack([moved, actual])).max(axis=1)
        apart = ~(off <= 1e-12 * cond)
        if scenario.law != "failure-tolerant":
            assert not apart.any(), (scenario.law, off[apart], cond[apart])
            continue
        assert off.max() < 1e-6
        assert apart.mean() < 0.01
        j, command = task_jacobian(experiment, q[apart]), v[apart]
        here, there = (peak_error(j, command, x[apart] - q[apart]) for x in (found[:, : arm.n], moved))
        np.testing.assert_allclose(here, there, rtol=1e-9)


def test_whole_cycles_agree_with_python(rng):
    """Ten sub-steps: beside a singular configuration, what one rounds by the next makes larger, by the condition at most."""
    experiment = every_law(hf.arms.load("planar-3r"), "planar", 10, rng)
    q, v, healthy = draws(rng, experiment, 2000)
    module = generate_arm_javascript(experiment)
    for law, scenario in zip(number_scenario_laws(experiment), experiment.scenarios, strict=True):
        made = scenario.make_law(experiment.arm, experiment.rows)
        found = in_page(module, law, q, v, healthy)
        off = np.abs(found - np.hstack(JoystickPlant(made, 10).step_batch(q, v, healthy))).max(axis=1)
        single, at, cond = JoystickPlant(made, 1), q, np.zeros(len(q))
        for _ in range(10):
            cond = np.maximum(cond, np.linalg.cond(task_jacobian(experiment, at)))
            at, _ = single.step_batch(at, v / 10, healthy)
        assert (off <= (1e-7 if scenario.law == "failure-tolerant" else 1e-12 * cond**2)).all(), scenario.law


def test_trials_of_the_computer_take_the_same_way():
    """The paper's 24 tasks in its four scenarios: the recorded commands again, from the start to the end."""
    experiment = protocol.read_protocol()
    trials, numbers = run_computer_trials(experiment), number_scenario_laws(experiment)
    scenarios, tasks, m = len(experiment.scenarios), len(experiment.tasks), experiment.rows.m
    every = experiment.tasks.take(np.tile(np.arange(tasks), scenarios))
    healthy = every.healthy_mask(np.repeat([s.failed for s in experiment.scenarios], tasks))
    parts = []
    for i in range(len(trials)):
        commands = trials.velocity[trials.first[i] : trials.first[i + 1]]
        parts += [[numbers[i // tasks]], every.q0[i], healthy[i], commands.ravel()]
    script = TRIALS.replace("COUNTS", ",".join(map(str, trials.cycles)))
    found = browser.run(
        script, np.concatenate(parts), len(trials.velocity) * m, arm=generate_arm_javascript(experiment)
    ).reshape(-1, m)
    worst = np.zeros(len(trials))
    for i in range(len(trials)):
        cycles = slice(trials.first[i], trials.first[i + 1])
        way = np.vstack([trials.x[cycles][1:], trials.x_end[i]])
        worst[i] = np.linalg.norm(found[cycles] - way, axis=1).max()
    assert worst.max() < 1e-6, np.sort(worst)[-5:]


@pytest.mark.parametrize("which", ["planar-3r", "panda", "tilted", "mixed7"])
def test_position_and_wire_frame(which, rng, generator, mixed7):
    """Also for an arm whose base is turned and moved, and one with a sliding joint."""
    if which in ("planar-3r", "panda"):
        arm = hf.arms.load(which)
    else:
        arm = mixed7 if which == "mixed7" else oracles.planar_arm(generator("tilted"), 4)
    experiment = every_law(arm, "planar" if which in ("planar-3r", "tilted") else "position", 1, rng)
    experiment = dataclasses.replace(experiment, scenarios=experiment.scenarios[:1])
    n, m = arm.n, experiment.rows.m
    markers = n + 1 + bool(np.any(arm.joints[0].origin[:3, 3]))
    q = rng.uniform(-3, 3, (50, n))
    found = browser.run(PLACES, q, 50 * (m + 3 * markers), arm=generate_arm_javascript(experiment)).reshape(50, m + 3 * markers)
    np.testing.assert_allclose(found[:, :m], experiment.plants[0].position(q), rtol=0, atol=1e-13)
    for row, wire in zip(q, found[:, m:].reshape(50, markers, 3), strict=True):
        at = arm.base
        expected = [at[:3, 3]]
        for angle, joint in zip(row, arm.joints, strict=True):
            at = at @ joint.origin
            expected.append(at[:3, 3])
            slide = np.eye(4)
            if joint.prismatic:
                slide[:3, 3] = angle * joint.axis
            else:
                k = np.cross(np.eye(3), joint.axis)
                slide[:3, :3] += np.sin(angle) * k + (1 - np.cos(angle)) * k @ k
            at = at @ slide
        expected.append((at @ arm.tool)[:3, 3])
        np.testing.assert_allclose(wire, expected[len(expected) - markers :], rtol=0, atol=1e-12)


def test_singular_arm_stands_and_nan_stays_nan(rng):
    experiment = every_law(hf.arms.load("planar-3r"), "planar", 10, rng)
    q = np.array([[0, 0, 0], [0, 0, 0], [0.3, np.nan, 0.2], [0.3, 1, 2], [0.3, 1, 2], [np.inf, 1, 2]])
    v = np.array([[0.01, 0.02], [0, 0], [0.01, 0], [np.nan, 0], [0, 0], [0, 0]])
    healthy = np.ones((6, 3))
    healthy[4, 1] = np.nan
    module = generate_arm_javascript(experiment)
    for law, scenario in zip(number_scenario_laws(experiment), experiment.scenarios, strict=True):
        plant = JoystickPlant(scenario.make_law(experiment.arm, experiment.rows), 10)
        found, expected = in_page(module, law, q, v, healthy), np.hstack(plant.step_batch(q, v, healthy))
        np.testing.assert_array_equal(np.isnan(found), np.isnan(expected))
        assert np.isnan(found[2:]).all()
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12)
        if scenario.law == "pseudoinverse":
            np.testing.assert_array_equal(found[:2], np.zeros((2, 5)))


def test_arguments_stay_as_they_are_and_an_unknown_law_is_refused():
    script = """\
import {cycle,position,points,joints,axes,laws,markers} from "./arm.mjs";
const q=input.slice(0,3),v=input.slice(3,5),healthy=input.slice(5,8),out=new Float64Array(5),wire=new Float64Array(12);
const before=[q,v,healthy].join();
cycle(1,q,v,healthy,out);position(q,new Float64Array(2));points(q,wire);
let refused=0;
for(const law of [-1,2,NaN,undefined])try{cycle(law,q,v,healthy,out);}catch(e){refused+=e instanceof RangeError;}
output.set([joints,axes,laws,markers,before===[q,v,healthy].join()?1:0,refused]);"""
    numbers = np.array([0.1, 0.5, -0.7, 0.02, 0.01, 1, 1, 0])
    assert browser.run(script, numbers, 6, arm=generate_arm_javascript(protocol.read_protocol())).tolist() == [3, 2, 2, 4, 1, 4]


def test_laws_are_printed_once_and_the_module_stays_small(monkeypatch):
    monkeypatch.setenv("HOLDFAST_CACHE", "off")
    experiment = protocol.read_protocol()
    codes = number_scenario_laws(experiment)
    assert sorted(codes) == [0, 0, 1, 1]
    assert codes[:2] == codes[2:]
    seeds = [number_scenario_laws(dataclasses.replace(experiment, seed=k))[0] for k in range(20)]
    assert set(seeds) == {0, 1}  # a code says nothing about the law
    other = dataclasses.replace(experiment.scenarios[1], options={"pre_failure_error": 0.3}, number=5)
    assert sorted(set(number_scenario_laws(dataclasses.replace(experiment, scenarios=(*experiment.scenarios, other))))) == [
        0,
        1,
        2,
    ]
    text = generate_arm_javascript(experiment)
    assert text == generate_arm_javascript(protocol.read_protocol())
    assert len(text) < 40_000
    assert "import" not in text


def test_rows_that_no_stick_commands_are_refused(rng):
    experiment = every_law(hf.arms.load("panda"), "position", 1, rng)
    with pytest.raises(TaskError, match="planar or position"):
        generate_arm_javascript(dataclasses.replace(experiment, rows=as_task(experiment.arm, "pose")))


def test_a_second_server_builds_no_graph(rng, tmp_path, monkeypatch):
    monkeypatch.setenv("HOLDFAST_CACHE", str(tmp_path))
    experiment = protocol.read_protocol()
    q, velocity = rng.uniform(-2, 2, (5, 3)), rng.uniform(-0.05, 0.05, (5, 2))
    healthy = np.array([[1.0, 1, 0]] * 5)

    def all_of_it():
        plants = dataclasses.replace(experiment).plants
        return generate_arm_javascript(experiment), [
            np.concatenate(p.step_batch(q, velocity, healthy), axis=1).tobytes() for p in plants
        ]

    first = all_of_it()

    def never(*_):
        raise AssertionError("built again")

    monkeypatch.setattr(hf.control.Law, "rates", never)
    assert all_of_it() == first
    with pytest.raises(AssertionError, match="built again"):
        generate_arm_javascript(dataclasses.replace(experiment, substeps=7))
