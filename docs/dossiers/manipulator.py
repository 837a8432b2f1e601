"""A remote manipulator, and a lock that its operator has not noticed: what is noticed, and which law to run.

Change the arm, the motions and the laws to your own: python docs/dossiers/manipulator.py --out FOLDER
"""

import numpy as np
from owners_page import links, run, span, write

import holdfast as hf
from holdfast.interface import report

ARM, TASK = "pa10-7dof", "position"  # the operator commands where the tool point goes; nothing is asked of its orientation
DISTANCE = (0.1, 0.5)  # m, of the commanded motions
PRE_FAILURE_ERROR = 0.5  # of the failure-tolerant law: how far it may leave the commanded velocity while nothing has failed


def main(out, count=100):
    arm = hf.arms.load(ARM)
    laws = [
        hf.control.pseudoinverse(arm, TASK),
        hf.control.failure_tolerant(arm, TASK, pre_failure_error=PRE_FAILURE_ERROR),
    ]
    drawn = hf.point_to_point(arm, count, seed=1, distance=DISTANCE)
    compared = hf.compare_laws(laws, drawn.q0, drawn.target)
    plain, tolerant = compared.names
    error, gain = compared.change(tolerant, "error"), compared.gain(tolerant)
    shown = "ends nearer" if error.high < 0 else "ends farther off" if error.low > 0 else "is not shown to end nearer"
    stray, late = (
        compared.cost(tolerant, "deviation", (0.5, 0.95)),
        [compared.cost(n, "time", (0.5,))[0] for n in compared.names],
    )
    answer = (
        f"After a lock that nobody has noticed, {plain} still reaches {span(compared.share_any(plain))} of the "
        f"targets; {tolerant} {shown}: the mean end error changes by {span(error, 1000, ' mm')}, the targets reached by "
        f"{span(gain, 100, ' points', 1)}. Its price before any failure: {1000 * stray[0]:.0f} mm off the straight line in the "
        f"median, and {late[1]:.1f} s in place of {late[0]:.1f} s. "
        "Run it where the first is worth the second."
    )
    rows = []
    for joint in compared.joints:
        cases = [compared.case(name, joint) for name in compared.names]
        lost = [c.error[~c.has_outcome("converged")] for c in cases]
        astray = ", ".join(f"{1000 * np.median(e):.0f} mm" if e.size else "none" for e in lost)
        rows.append((joint, f"{cases[0].reachable.mean():.0%}", *(f"{c.share().value:.0%}" for c in cases), astray))
    figure = compared.plot("errors")
    full = compared.report(out / "laws.html")
    about, undecided = hf.arms.about(ARM), [100 * compared.share_any(name, "undecided").value for name in compared.names]
    method = (
        f"{count} motions of {DISTANCE[0]} to {DISTANCE[1]} m from random configurations, each made healthy and with each "
        f"joint locked from the start, by both laws. {about.summary}, licence {about.licence}; {about.source}. Kinematics "
        "alone: no inertia, no delay, no operator who corrects; joint limits are reported, not enforced. Each joint is as "
        f"likely to lock as any other. Undecided runs count as not reached: {undecided[0]:.1f} % and {undecided[1]:.1f} %. "
        "The interval of the end error is Student's t."
    )
    heads = ("locked", "within reach", f"{plain} reaches", f"{tolerant} reaches", "median error where not reached")
    evidence = {
        "Joint by joint": report.Table(rows, heads, wide=True),
        "How far off": report.Picture(report.svg(figure, "errors", "End errors, two laws"), "All locked joints together."),
        "All of it": links(full),
    }
    title = "What the operator notices, and which law to run"
    write(out, "manipulator", title, answer, evidence, figure=figure, method=method, count=count)


if __name__ == "__main__":
    run(main, 100)
