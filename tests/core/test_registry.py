"""Everything that has a name: one list of it, labels that give the thing back, an oracle of each, both backends."""

from __future__ import annotations

import inspect
import json
import subprocess
import sys
from importlib import import_module
from typing import Annotated, get_args, get_origin

import casadi as ca
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import holdfast as hf
import oracles
from holdfast.core.errors import InputError, TaskError
from holdfast.core.registry import INDEX_REGISTRY, LAW_REGISTRY, SUSCEPTIBILITY_REGISTRY, Parameter, constructor
from holdfast.kinematics.indices import CustomIndex, Index

KINDS = {"index": INDEX_REGISTRY, "control law": LAW_REGISTRY, "susceptibility": SUSCEPTIBILITY_REGISTRY}
EVERYTHING = [(kind, name) for kind, registry in KINDS.items() for name in registry]
PANDA = hf.arms.load("panda")
TASK = "position"


def given_task(kind):
    return {} if kind == "susceptibility" else {"task": TASK}


@pytest.mark.parametrize(("kind", "name"), EVERYTHING)
def test_everything_has_an_oracle(kind, name):
    assert name in oracles.ORACLES[kind], (
        f"{kind} '{name}' has no oracle: add its value by another route to ORACLES['{kind}'] in tests/oracles.py"
    )


def test_oracles_are_of_things_that_there_are():
    assert {(kind, name) for kind, known in oracles.ORACLES.items() for name in known} == set(EVERYTHING)


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_registered_is_what_the_package_exports(kind):
    """By what the functions return: every exported one that makes a thing of the kind for an arm."""
    package, made = {
        "index": (hf.indices, Index),
        "control law": (hf.control.laws, hf.control.Law),
        "susceptibility": (hf.susceptibility, hf.susceptibility.Susceptibility),
    }[kind]
    makers = set()
    for name in package.__all__:
        value = getattr(package, name)
        if inspect.isfunction(value):
            signature = inspect.signature(value, eval_str=True)
            result = signature.return_annotation
            if next(iter(signature.parameters)) == "arm" and inspect.isclass(result) and issubclass(result, made):
                makers.add(name.replace("_", "-"))
    assert makers == set(KINDS[kind])


@pytest.mark.parametrize(("kind", "name"), EVERYTHING)
def test_what_is_read_from_the_text_is_what_python_sees(kind, name):
    entry = KINDS[kind][name]
    assert entry.make.__name__ == name.replace("-", "_")
    assert entry.help == inspect.getdoc(entry.make).partition("\n")[0]
    assert entry.help.endswith(".")
    assert entry.help.isascii()
    seen = {}
    for p in list(inspect.signature(entry.make, eval_str=True).parameters.values())[1:]:
        if get_origin(p.annotation) is Annotated:
            (about,) = (x for x in get_args(p.annotation)[1:] if isinstance(x, Parameter))
            seen[p.name] = (about.unit, about.help, about.low, about.high, about.example, p.default)
    empty = inspect.Parameter.empty
    read = {
        p.name: (p.unit, p.help, p.low, p.high, p.example, empty if p.default is ... else p.default) for p in entry.parameters
    }
    assert read == seen
    assert all(p.example is not None for p in entry.parameters), f"{name}: every parameter needs an example"
    if kind == "index":
        assert entry.formula


def test_help_and_errors_need_nothing_that_computes():
    code = (
        "import json, sys; from holdfast.core.registry import INDEX_REGISTRY, LAW_REGISTRY, SUSCEPTIBILITY_REGISTRY\n"
        "told = [r.usage for r in (INDEX_REGISTRY, LAW_REGISTRY, SUSCEPTIBILITY_REGISTRY)]\n"
        "print(json.dumps([told, sorted({'casadi', 'scipy', 'llvmlite', 'matplotlib'} & set(sys.modules))]))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    told, heavy = json.loads(done.stdout)
    assert heavy == []
    assert "damped:DAMPING (damping factor, m for linear components, above 0)" in told[1]
    assert "directional-velocity:DIRECTION" in told[0]


# ---- labels --------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("kind", "name"), EVERYTHING)
def test_a_label_gives_the_same_thing_back(kind, name):
    """With the settings of the example, positive numbers of all sizes in their place, and without any where that may be."""
    registry, options = KINDS[kind], given_task(kind)
    entry = registry[name]
    made = entry.make(PANDA, **options, **entry.example(PANDA, TASK))
    label = registry.label(made)
    assert label == made.label
    assert registry.is_storable(made)
    again = registry.make(label, PANDA, **options)
    assert registry.label(again) == label
    assert type(again) is type(made)
    for key, value in made.settings.items():
        np.testing.assert_array_equal(again.settings[key], value)
    short = registry.make(oracles.example(registry, name, PANDA, TASK), PANDA, **options)
    assert type(short) is type(made)


@pytest.mark.parametrize(("kind", "name"), [(k, n) for k, n in EVERYTHING if KINDS[k][n].parameters])
@given(data=st.data())
def test_a_label_keeps_every_digit(kind, name, data):
    registry, options = KINDS[kind], given_task(kind)
    entry = registry[name]
    settings = {}
    for p in entry.parameters:
        if p.kind not in ("float", "ArrayLike", "WeightSpec"):  # of others not every number will do
            settings[p.name] = entry.example(PANDA, TASK)[p.name]
            continue
        example = np.asarray(entry.example(PANDA, TASK)[p.name], dtype=float)
        low, high = 1e-3 if p.low is None else p.low + 1e-3, 1e3 if p.high is None else p.high - 1e-3
        numbers = data.draw(st.lists(st.floats(low, high), min_size=example.size, max_size=example.size))
        settings[p.name] = numbers[0] if example.ndim == 0 else numbers
    made = entry.make(PANDA, **options, **settings)
    again = registry.make(registry.label(made), PANDA, **options)
    for key, value in settings.items():
        np.testing.assert_array_equal(made.settings[key], value)
        np.testing.assert_array_equal(again.settings[key], value)


def test_a_setting_is_given_once_and_a_whole_number_is_whole():
    with pytest.raises(InputError, match=r"'damped:0\.1' and an option both give damping; give it once"):
        hf.control.by_name("damped:0.1", PANDA, damping=0.2)
    with pytest.raises(InputError, match="'torque:effort' and an option both give weights; give it once"):
        hf.susceptibility.by_name("torque:effort", PANDA, [1.0] * 7)
    whole = Parameter("1", "which", name="row", kind="int")
    assert [whole.read_value(text, "x") for text in ("3", "2.0", "1.5")] == [
        3,
        2,
        1.5,
    ]  # the constructor refuses what is not whole
    assert np.isinf(whole.read_value("inf", "x"))


@pytest.mark.parametrize(("kind", "name"), [(k, n) for k, n in EVERYTHING if KINDS[k][n].parameters])
def test_a_parameter_is_refused_beyond_its_bounds(kind, name):
    registry, options = KINDS[kind], given_task(kind)
    for p in registry[name].parameters:
        for bound in (x for x in (p.low, p.high) if x is not None):
            settings = registry[name].example(PANDA, TASK)
            example = np.asarray(settings[p.name], dtype=float)
            settings[p.name] = np.full_like(example, bound) if example.ndim else type(settings[p.name])(bound)
            with pytest.raises(InputError):
                registry[name].make(PANDA, **options, **settings)


class OwnIndex(CustomIndex):
    pass


def test_what_has_no_label_says_so():
    root = np.eye(7) + 0.1
    full = hf.control.weighted(PANDA, root @ root.T, TASK)
    assert full.label == "weighted"
    with pytest.raises(InputError, match=r"an array of shape \(7, 7\) cannot be written in a label"):
        LAW_REGISTRY.label(full)
    with pytest.raises(InputError, match=r"an array of shape \(7, 7\) cannot be written in a label"):
        SUSCEPTIBILITY_REGISTRY.label(hf.susceptibility.torque(PANDA, root @ root.T))
    # A name alone is not enough: one's own function may be called as a built-in index is.
    for own in (CustomIndex, OwnIndex):
        made = own(ca.sumsqr, PANDA, TASK, name="manipulability")
        assert not INDEX_REGISTRY.is_storable(made)
        with pytest.raises(InputError, match="is user-defined, so a file cannot store it; keep the script"):
            INDEX_REGISTRY.label(made)


def test_a_law_without_a_label_is_not_stored(tmp_path):
    """Two matrices of weights are told by the same words, so that one analysis would go on with the rows of the other."""
    arm = hf.arms.load("planar-3r")
    law = hf.control.weighted(arm, np.eye(3) + 0.1, "planar")
    with pytest.raises(InputError, match="cannot be written in a label"):
        hf.workspace(law, [1.5, 1.5], 2, store=tmp_path / "run")
    with pytest.raises(InputError, match="cannot be written in a label"):
        hf.design_for_convergence(law, {"a2": (0.5, 1.0)}, targets=2, store=tmp_path / "run")
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize(
    ("label", "error", "words"),
    [
        (
            "manipulabilty",
            TaskError,
            "index 'manipulabilty' is not known; did you mean manipulability? Or use one of relative-",
        ),
        (
            "directional-velocity",
            InputError,
            "needs direction, x,y,z in the axes of the task's frame; write directional-velocity:",
        ),
        ("manipulability:1", InputError, "'manipulability:1': index 'manipulability' takes no setting; write manipulability"),
        ("directional-velocity:up=1", InputError, "has no setting 'up'; write directional-velocity:DIRECTION"),
        ("directional-velocity:0,0,x", InputError, "'x' is not a number; give x,y,z in the axes of the task's frame"),
        ("directional-velocity:0,0", InputError, "the direction is [0., 0.]; it must be three finite numbers, not all 0"),
        ("directional-velocity:0,0,0", InputError, "not all 0"),
        ("directional-velocity:0,0,inf", InputError, "three finite numbers"),
    ],
)
def test_what_is_refused(label, error, words):
    with pytest.raises(error) as told:
        hf.indices.by_name(label, PANDA, TASK)
    assert words in str(told.value)


def test_a_direction_that_the_task_leaves_free_is_refused():
    with pytest.raises(TaskError, match="task 'vx\\+vy' does not prescribe the direction 0, 0, 1; give one in which its rows"):
        hf.indices.directional_velocity(PANDA, [0, 0, 1], ["vx", "vy"])


def test_a_marked_function_is_checked():
    @constructor()
    def thing(arm: hf.Arm, size: Annotated[float, Parameter("m", "its size")] = 1.0) -> None: ...

    with pytest.raises(InputError, match="size is 'large'; it must be a number"):
        thing(PANDA, "large")
    assert import_module("holdfast.core.registry").INDEX_REGISTRY.usage.count("directional-velocity") == 1


# ---- values, whatever computes them ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", INDEX_REGISTRY)
def test_an_index_is_the_same_on_both_backends(name, mixed5, rng, monkeypatch):
    q = oracles.inside(mixed5, rng, 40)
    found = []
    for backend in ("llvm", "casadi"):
        monkeypatch.setenv("HOLDFAST_BACKEND", backend)
        index = oracles.index_of(name, mixed5, TASK)
        found.append((index.by_joint(q), index.gradient(q)))
    (fast, slopes), (slow, expected) = found
    np.testing.assert_allclose(fast, slow, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(slopes, expected, atol=1e-8 * np.abs(expected).max())


@pytest.mark.parametrize("name", LAW_REGISTRY)
def test_a_law_is_the_same_on_both_backends(name, mixed5, rng, monkeypatch):
    q, v = oracles.inside(mixed5, rng, 40), rng.normal(size=(40, 3))
    found = []
    for backend in ("llvm", "casadi"):
        monkeypatch.setenv("HOLDFAST_BACKEND", backend)
        found.append(LAW_REGISTRY.make(oracles.example(LAW_REGISTRY, name, mixed5, TASK), mixed5, task=TASK).velocity(q, v))
    # Where the peak error is flat the failure-tolerant inverse may take another damping, by rounding.
    tolerance = 1e-6 if name == "failure-tolerant" else 1e-9
    np.testing.assert_allclose(found[0], found[1], atol=tolerance * np.abs(found[1]).max())


@pytest.mark.parametrize("name", SUSCEPTIBILITY_REGISTRY)
def test_a_susceptibility_is_that_of_its_oracle(name, generator):
    draw = generator("registry-loaded")
    arm = oracles.with_bodies(oracles.random_arm(draw, types="RRPRRR", limits=2.0), draw, payload=True, armature=True)
    measure, q = hf.susceptibility.by_name(name, arm), oracles.inside(arm, draw, 20)
    expected = oracles.ORACLES["susceptibility"][name](arm, q)
    apart = measure.by_joint(q) - expected
    if measure.formula.turning == "rad":  # half a turn is the same as half a turn the other way
        apart = (apart + np.pi) % (2 * np.pi) - np.pi
    np.testing.assert_allclose(apart, 0, atol=1e-8 * max(1.0, np.abs(expected).max()))


@pytest.mark.parametrize("law", [n for n in LAW_REGISTRY if n != "failure-tolerant"])
def test_the_quadratic_form_of_a_law_gives_its_rates(law, mixed5, rng, monkeypatch):
    monkeypatch.setenv("HOLDFAST_BACKEND", "casadi")
    made = LAW_REGISTRY.make(oracles.example(LAW_REGISTRY, law, mixed5, TASK), mixed5, task=TASK)
    form = made.quadratic()
    if form is None:
        return
    a, d = form
    q, v = oracles.inside(mixed5, rng, 5), rng.normal(size=(5, 3))
    for row, u, rates in zip(oracles.jacobian(mixed5, q)[:, :3], v, made.velocity(q, v), strict=True):
        np.testing.assert_allclose(rates, a @ row.T @ np.linalg.solve(row @ a @ row.T + d * np.eye(3), u), rtol=1e-8)


def test_a_label_does_not_depend_on_what_is_put_on_a_signature(monkeypatch):
    """Sphinx does so with constructors; their annotations are text there."""
    arm = hf.arms.load("planar-3r")
    make = hf.indices.relative_manipulability
    told = inspect.signature(make).replace(return_annotation="RelativeManipulability")
    monkeypatch.setattr(make, "__signature__", told, raising=False)
    assert INDEX_REGISTRY.label(make(arm, "planar")) == "relative-manipulability"
