"""The steps of the tour: what each does, and what it says of what is to be seen."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from holdfast.interface.studio.page.guide import TOUR_STEPS, TourGuide
from holdfast.interface.studio.scene.machine import CompiledArm
from holdfast.model.arm.task import as_task


@pytest.mark.parametrize(("name", "task", "steps"), [("planar-3r", "planar", 6), ("ur5", "pose", 4), ("iiwa14", "pose", 4)])
def test_the_tour_shows_what_there_is_to_show(name, task, steps):
    """The elbow of an iiwa and every joint of a UR5 lose a direction in any configuration: nothing is there to optimise."""
    arm = hf.arms.load(name)
    machine, q = CompiledArm(arm, as_task(arm, task)), np.array(hf.model.arm.generic_configuration(arm))
    asked, shown = [], []
    guide = TourGuide(lambda *what: asked.append(what), lambda *given: shown.append(given))
    reading = machine.evaluate_live_reading(q, (), "relative-manipulability", "torque")
    guide.begin_tour(reading)
    worst = 0 if isinstance(reading.bars, str) else reading.bars.worst
    for number in range(1, steps + 1):
        failed = (worst,) if ("fail", (worst, "locked")) in asked else ()
        guide.show_step(
            machine.evaluate_live_reading(q, failed, "relative-manipulability", "torque"), arm.joint_names, busy=False
        )
        text, after = shown[-1]
        assert f"{number} of {steps}: " in text
        assert after == ("Done" if number == steps else after)
        guide.show_next()
    assert shown[-1] == ("", "")
    assert ("fail", (worst, "locked")) in asked
    assert (("best-worst", None) in asked) == (steps == len(TOUR_STEPS))
    assert asked[-3:] == [("clear", None), ("heal", None), ("home", None)]
    assert arm.joint_names[worst] in shown[0][0]


def test_names_are_escaped_and_a_tour_that_was_ended_is_silent():
    shown = []
    guide = TourGuide(lambda *_: None, lambda *given: shown.append(given))
    arm = hf.arms.load("planar-3r")
    reading = CompiledArm(arm, as_task(arm, "planar")).evaluate_live_reading(
        np.array([0.3, 0.8, 0.9]), (), "relative-manipulability", "torque"
    )
    guide.show_step(reading, ("<b>", "<i>", "<u>"), busy=False)
    assert shown == []
    guide.begin_tour(reading)
    guide.show_step(reading, ("<b>", "<i>", "<u>"), busy=False)
    assert not any(tag in shown[-1][0].replace("<b>1 of 6", "") for tag in ("<b>", "<i>", "<u>"))
    guide.end_tour()
    guide.show_step(reading, ("<b>", "<i>", "<u>"), busy=False)
    guide.show_next()
    assert shown[-1] == ("", "")
