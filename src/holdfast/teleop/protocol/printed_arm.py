"""The arm of a protocol as JavaScript: what moves in the page is the computation that Python replays.

Measured with Node 20 on one core of a shared machine: the paper's protocol (three links, two laws) makes 25 kB in less than a
second; a control cycle of ten sub-steps takes 2 us under the pseudoinverse and 12 us under the failure-tolerant inverse. The
seven-joint Panda, position task, makes 71 kB; 4 us and 35 to 60 us. Loading runs every law 300 times, 0.2 s (Panda
0.5 s), because code that has not run yet takes 0.5 ms (Panda 2 ms) a cycle.
"""

from __future__ import annotations

import json

import casadi as ca
import numpy as np

from holdfast.arm import kinematics
from holdfast.arm.model import Arm
from holdfast.control.law import Law
from holdfast.kernels.javascript_backend import javascript
from holdfast.kernels.program import SX, Program
from holdfast.kernels.recall import recalled_data
from holdfast.teleop.protocol.protocol import Protocol
from holdfast.teleop.trials.plant import check_rows, substep

_WARM = 300  # cycles of each law before the module is ready: engines compile what has run a while


def law_of(protocol: Protocol) -> list[int]:
    """For each scenario, the number of its law in the module: laws with their options, each once, shuffled.

    So the numbers say nothing to who reads what page and server say to each other; the protocol's seed shuffles them.
    """
    known: dict[str, int] = {}
    found = [known.setdefault(json.dumps([s.law, dict(s.options)], sort_keys=True), len(known)) for s in protocol.scenarios]
    codes = np.random.default_rng([protocol.seed, 2]).permutation(len(known)).tolist()
    return [codes[k] for k in found]


def arm_module(protocol: Protocol) -> str:
    """The arm under the protocol's laws as the text of an ES module, which needs nothing else and allocates nothing.

    .. code-block:: javascript

        export const joints, axes, laws, markers;
        export function cycle(law, q, velocity, healthy, out);
        export function position(q, out);
        export function points(q, out);

    All arguments are ``Float64Array``, apart from ``law``: its number, see :func:`law_of`. ``cycle`` writes what
    :meth:`holdfast.teleop.Plant.cycle` gives: the configuration after a whole control cycle, then the tool point's
    velocity at its beginning, m/cycle. ``position`` writes the task's rows of the tool point, m, and ``points`` the wire
    frame, three world coordinates each, m: the base (left out where the first joint sits at it), every joint, the tool point;
    so joint k, from 0, is marker ``markers - 1 - joints + k``. NaN or infinity in an argument makes everything NaN.

    Args:
        protocol: The experiment.

    Raises:
        TaskError: Rows that a stick cannot command.
    """
    numbers = law_of(protocol)
    check_rows(protocol.rows)
    scenarios = [protocol.scenarios[numbers.index(k)] for k in range(max(numbers) + 1)]
    return _module([s.make_law(protocol.arm, protocol.rows) for s in scenarios], protocol.substeps)


@recalled_data
def _module(laws: list[Law], substeps: int) -> str:
    arm, task = laws[0].arm, laws[0].task
    q = kinematics.joint_symbols(arm)
    frame = _wire_frame(arm, q)
    place = ca.DM(task.rows[:, :3]) @ frame[:, -1]
    texts = []
    for k, law in enumerate(laws):
        once = substep(law, substeps)
        symbols = once.sx_in()
        texts.append(javascript(Program(f"sub-step, {law.slug}", symbols, once(*symbols)), f"law{k}"))
    texts.append(javascript(Program("position", [q], [place]), "place"))
    texts.append(javascript(Program("points", [q], [frame.T]), "wire"))
    return _MODULE.format(
        joints=arm.n,
        axes=task.m,
        laws=len(laws),
        markers=frame.shape[1],
        programs="".join(texts),
        steps=",".join(f"law{k}" for k in range(len(laws))),
        substeps=substeps,
        warm=_WARM,
    )


def _wire_frame(arm: Arm, q: SX) -> SX:
    """(3, markers) the base, if the first joint sits elsewhere, every joint and the tool point, in the world."""
    moving, still = kinematics.frames(arm, kinematics.joint_steps(arm, q))
    tool = kinematics.compose(moving[-1], kinematics.split(arm.tool))
    at_base = not np.any(arm.joints[0].origin[:3, 3])
    chosen = [*([] if at_base else moving[:1]), *still, tool]
    return ca.densify(ca.horzcat(*[position for _, position in chosen]))


_MODULE = """\
// Printed by holdfast from the equations of its kernels: do not edit.
export const joints={joints},axes={axes},laws={laws},markers={markers};
{programs}\
const steps=[{steps}];
const x=new Float64Array(2*joints+axes),y=new Float64Array(joints+axes);
export function cycle(law,q,velocity,healthy,out){{
const step=steps[law];
if(step===undefined)throw new RangeError("law "+law+" is not known; the arm has "+laws+", from 0");
for(let i=0;i<joints;i++){{x[i]=q[i];x[joints+axes+i]=healthy[i];}}
for(let i=0;i<axes;i++)x[joints+i]=velocity[i];
step(x,y);
for(let i=0;i<axes;i++)out[joints+i]=y[joints+i];
for(let k=1;k<{substeps};k++){{
for(let i=0;i<joints;i++)x[i]=y[i];
step(x,y);
}}
for(let i=0;i<joints;i++)out[i]=y[i];
}}
export function position(q,out){{place(q,out);}}
export function points(q,out){{wire(q,out);}}
// Engines compile what has run a while, from all sides: so that no trial has to wait for it.
const q0=new Float64Array(joints),v0=new Float64Array(axes);
const all=new Float64Array(joints).fill(1),end=new Float64Array(joints+axes);
for(let law=0;law<laws;law++)for(let k=0;k<{warm};k++){{
for(let i=0;i<joints;i++)q0[i]=3*Math.sin(k*(i+1.3));
for(let i=0;i<axes;i++)v0[i]=k%7===0?0:0.05*Math.sin(k*(i+2.7));
cycle(law,q0,v0,all,end);
}}
"""
