"""What the page is told of an experiment, and its texts."""

import dataclasses
import json

import numpy as np
import pytest

import holdfast as hf
from holdfast import arms
from holdfast.core.registry import LAW_REGISTRY
from holdfast.model.arm.task import as_task
from holdfast.teleop.protocol.printed_arm import generate_arm_javascript, number_scenario_laws
from holdfast.teleop.protocol.protocol import read_protocol
from holdfast.teleop.serve import texts
from holdfast.teleop.serve.briefing import compute_planar_workspace, describe_experiment, describe_views
from holdfast.teleop.serve.messages import PlannedTrial


def test_experiment_of_the_paper(built):
    whole = read_protocol()
    told = describe_experiment(whole, texts.load_texts(None, built[1]), tlx=True)
    assert json.loads(json.dumps(told, allow_nan=False)) == told
    assert told["stick"] == {"limit": 0.05, "dead_zone": 0.005}
    assert told["training_law"] == number_scenario_laws(whole)[0]
    assert told["training"] == {"at_least": 10, "in_a_row": 5, "limit": 55.0, "most": 100}
    assert told["views"] == [{"label": "x, y", "rows": [[1, 0, 0], [0, 1, 0]]}]
    assert (told["reach"], told["centre"]) == (pytest.approx(3.0), [0.0, 0.0, 0.0])
    assert told["rating"] == ["easy", "moderate", "difficult", "very difficult"]
    assert (told["tlx"], [f["name"] for f in told["forms"]]) == (True, ["consent"])


def test_boundary_is_touched_and_never_crossed(rng):
    lengths = rng.uniform(0.2, 1.5, 4)
    rows = [hf.DH(a=float(a), alpha=0.0) for a in lengths]
    base = np.eye(4)
    base[:2, 3] = rng.normal(0, 1, 2)
    arm = hf.Arm.from_dh(rows, base=base)
    centre, reach = compute_planar_workspace(arm, as_task(arm, "planar"))
    points = arm.forward_kinematics(rng.uniform(-np.pi, np.pi, (500, 4)))[:, :3, 3]
    assert np.linalg.norm(points - centre, axis=1).max() < reach
    stretched = arm.forward_kinematics(np.zeros(4))[:3, 3]
    assert np.linalg.norm(stretched - centre) == pytest.approx(reach)


def test_spatial_arms_have_two_views_and_no_boundary():
    arm = arms.load("panda")
    task = as_task(arm, "position")
    assert compute_planar_workspace(arm, task)[1] is None

    class Whole:
        rows = task

    assert [v["label"] for v in describe_views(Whole)] == ["x, y", "x, z"]
    assert describe_views(Whole)[1]["rows"] == [[1, 0, 0], [0, 0, 1]]


def test_translations_have_the_same_keys(built, tmp_path):
    english = built[1].read_text()
    file = tmp_path / "de.yaml"
    file.write_text(english.replace("Welcome", "Willkommen").replace("I do", "Ja"))
    assert texts.load_texts(file, built[1]).strings["title"] == "Willkommen"
    assert texts.load_texts(file, built[1]).forms[0]["questions"] == [{"name": "agree", "kind": "check", "label": "Ja"}]
    for text, said in [
        (english.replace("title: W", "titel: W"), "'titel' is not known"),
        (english.replace("title: Welcome\n", ""), "'title' is missing"),
        (english.replace("Welcome", "3"), "title: 3 is not text"),
        (english.replace("{name}", "{nam}"), "subject: it has {nam} in braces; it must have {name}"),
        (english.replace("{name}", ""), "it has nothing in braces"),
        (english.replace("{name: consent", "{nam: consent"), "the key 'nam' is not known"),
        (english.replace("{name: consent", "{name: assent"), "the form 'assent' is not known"),
        (english.replace("name: agree", "name: a.b"), "name: 'a.b' is wrong"),
        (english.replace("kind: check", "kind: tick"), "'tick' is not known; use"),
        (english.replace("kind: check", "kind: choice"), "a choice needs them"),
        (english.replace("label: I do", "label: no"), "label"),
        (english + "title: again\n", "given twice"),
        (english + english.split("forms:\n")[1], "two of them have the same name"),
        ("[1, 2]", "keys and values"),
        ("a: [", "not valid YAML"),
        ("title: x\n", "forms"),
    ]:
        file.write_text(text)
        with pytest.raises(hf.InputError, match=r"^texts '.*de\.yaml': ") as raised:
            texts.load_texts(file, built[1])
        assert said in str(raised.value)
        assert "\n" not in str(raised.value)
    with pytest.raises(hf.InputError, match=r"none\.yaml.*cannot be read"):
        texts.load_texts(tmp_path / "none.yaml", built[1])


def test_the_page_is_blind(built):
    """No law is named in anything that a station gets, and the order of the laws' codes is the protocol's seed's."""
    whole = dataclasses.replace(read_protocol(), name="does the failure-tolerant inverse help?")
    order = whole.session_order(0, 0)
    laws = number_scenario_laws(whole)
    plan = [PlannedTrial(task=t, law=laws[s], q0=[0.0], target=[0.0], joint=-1).model_dump() for t, s in order.tolist()]
    words = (
        json.dumps(describe_experiment(whole, texts.load_texts()) | {"texts": ""})
        + generate_arm_javascript(whole)
        + json.dumps(plan)
    )
    for name in (*LAW_REGISTRY, "pseudo", "tolerant", "inverse", "scenario", "law_of", whole.name):
        assert name not in words.lower()
