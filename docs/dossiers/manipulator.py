"""A remote manipulator with an undetected lock: the visible effect, and the control law to run.

Change the arm, the motions and the laws to your own: python docs/dossiers/manipulator.py --out FOLDER
"""

import numpy as np
from owners_page import links, run, span, write

import holdfast as hf
from holdfast.interface import report

ARM, TASK = "pa10-7dof", "position"  # the operator commands the position of the tool point, and its orientation is free
DISTANCE = (0.1, 0.5)  # m, of the commanded motions
PRE_FAILURE_ERROR = 0.5  # largest relative velocity error of the failure-tolerant law while the arm is healthy


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
    shown = "ends nearer" if error.high < 0 else "ends farther away" if error.low > 0 else "shows no difference in error"
    stray, late = (
        compared.cost(tolerant, "deviation", (0.5, 0.95)),
        [compared.cost(n, "time", (0.5,))[0] for n in compared.names],
    )
    answer = (
        f"After an undetected lock, {plain} reaches {span(compared.share_any(plain))} of the targets. {tolerant} {shown}, "
        f"because the mean error at the end changes by {span(error, 1000, ' mm')} and the fraction of reached targets by "
        f"{span(gain, 100, ' percentage points', 1)}. While the arm is healthy, it costs a median deviation of "
        f"{1000 * stray[0]:.0f} mm from the straight line, and {late[1]:.1f} s instead of {late[0]:.1f} s. "
        "Run it if the gain is worth this cost."
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
        f"joint locked from the start, by both laws. {about.summary}, licence {about.licence}, {about.source}. Kinematics "
        "only, without inertia, delay, or an operator who corrects. Joint limits are reported and not enforced. Each joint is "
        f"equally likely to lock. Undecided runs count as not reached ({undecided[0]:.1f} % and {undecided[1]:.1f} %). "
        "The interval of the end error is Student's t."
    )
    heads = ("locked", "within reach", f"{plain} reaches", f"{tolerant} reaches", "median error where not reached")
    evidence = {
        "Results by joint": report.Table(rows, heads, wide=True),
        "Error at the end": report.Picture(report.svg(figure, "errors", "End errors, two laws"), "All locked joints together."),
        "Complete report": links(full),
    }
    title = "A remote manipulator with an undetected lock"
    write(out, "manipulator", title, answer, evidence, figure=figure, method=method, count=count)


if __name__ == "__main__":
    run(main, 100)
