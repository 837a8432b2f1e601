"""Which of two arms to buy for a cell: one page with the answer, from models that holdfast ships.

Change the arms, the box and what is needed to your own: python docs/dossiers/cell.py --out FOLDER
"""

import numpy as np
from matplotlib.figure import Figure
from owners_page import links, run, span, write

import holdfast as hf
from holdfast.core.probability import Difference
from holdfast.interface import report

NAMES = ("panda", "xarm7")
FINGERS = 0.1034  # m from flange to fingertips, as in the model of the panda's hand; the xarm7's model ends at its flange
NEEDED = 0.05  # relative manipulability that the work needs, whichever joint locks
BOX = {"center": [0.45, 0, 0.3], "size": 0.4, "rpy_center": [np.pi, 0, 0], "rpy_size": np.radians(20)}  # m, rad; tool down


def better(shares):
    """Which of two is better by (N,) values at the same poses; both means; their paired difference."""
    k = int(np.mean(shares[1]) > np.mean(shares[0]))
    d = Difference.of_fractions(np.asarray(shares[k], dtype=float) - shares[1 - k])
    means = f"{NAMES[k]} {np.mean(shares[k]):.1%}, {NAMES[1 - k]} {np.mean(shares[1 - k]):.1%}"
    apart = f"{NAMES[k]} by {100 * d.value:.1f} points ({100 * d.low:.1f} to {100 * d.high:.1f}, 95 %)"
    return NAMES[k] if d.low > 0 else "not shown", means, apart


def left_figure(runs):
    """Bars: what each lock leaves, the two arms beside each other."""
    with report.style():
        figure = Figure(figsize=(7.2, 2.9), layout="constrained")
        axes = figure.add_subplot()
        for k, (run, colour) in enumerate(zip(runs, (report.BLUE, report.ORANGE), strict=True)):
            left = list(run.survival().values())
            middle, ends = np.array([p.value for p in left]), np.array([(p.value - p.low, p.high - p.value) for p in left]).T
            place = np.arange(1, len(left) + 1) + 0.4 * (k - 0.5)
            axes.bar(place, 100 * middle, 0.38, yerr=100 * ends, color=colour, ecolor=report.INK, label=NAMES[k])
        axes.set(xlabel="joint that has locked", ylabel="poses still reached, %", ylim=(0, 100))
        axes.legend(ncols=2)
    return figure


def main(out, count=500):
    tool = np.eye(4)
    tool[2, 3] = FINGERS
    arms = (hf.arms.load("panda"), hf.arms.load("xarm7").with_tool(tool))
    region = hf.Region.box(**BOX, name="table of the cell")
    runs = [hf.assess(arm, region, poses=count, seed=1, optimise=True, after_lock=True) for arm in arms]
    compared = hf.compare_assessments(runs, NAMES, NEEDED)
    columns = [run.columns for run in runs]
    found, chosen = ([np.nan_to_num(c[x][:]) >= NEEDED for c in columns] for x in ("index", "optimised_index"))
    left = [(c["survives"][:] == 1).mean(axis=1) for c in columns]
    rows = [
        (f"keeps {NEEDED} after any lock, as inverse kinematics finds it", *better(found)),
        (f"keeps {NEEDED} after any lock, best configuration of each pose", *better(chosen)),
        ("still reaches the pose once a joint has locked, mean over the joints", *better(left)),
    ]
    winners = {row[1] for row in rows} - {"not shown"}
    verdict = f"Buy the {winners.pop()}" if len(winners) == 1 else "Neither arm is the better one throughout"
    gains = [f"{np.mean(a):.1%} to {np.mean(b):.1%} ({name})" for name, a, b in zip(NAMES, found, chosen, strict=True)]
    answer = (
        f"{verdict}. Poses that keep {NEEDED} after any lock, at the best configurations: {better(chosen)[2]}. "
        f"Poses still reached once a joint has locked: {better(left)[2]}. "
        f"Choosing the configurations takes the first share from {' and from '.join(gains)}."
    )
    protect = []
    for name, run_of in zip(NAMES, runs, strict=True):
        u, (joint, p) = compared.upgrades(name)[0], min(run_of.survival().items(), key=lambda x: x[1].value)
        gain = (
            f"{u.joint}, {u.before:.1%} to {u.after:.1%}: {100 * u.gain:.1f} points ({100 * u.low:.1f} to {100 * u.high:.1f})"
        )
        protect.append((name, gain, f"{joint}, {span(p, digits=1)}"))
    pages = [compared.report(out / "comparison.html")]
    pages += [one.report(out / f"{name}.html", NEEDED) for name, one in zip(NAMES, runs, strict=True)]
    figure = left_figure(runs)
    method = (
        f"{count} poses with the tool down, the same for both arms; {region.describe()}. "
        f"{'; '.join(f'{a.name}: {a.summary}, licence {a.licence}' for a in map(hf.arms.about, NAMES))}. "
        f"Both have a tool of {FINGERS} m; the panda's hand is turned by 45 degrees on its flange. {NEEDED} is relative "
        "manipulability. A lock is at the angle that the joint had at another pose. A pose that is not found again counts "
        "as lost, and the intervals take the poses as independent. Not weighed: price, payload, speed, obstacles, the place "
        "of the base, how often each joint fails."
    )
    evidence = {
        "Side by side": report.Table(rows, ("at the same poses", "better", "shares", "difference"), wide=True),
        "What a lock leaves": report.Picture(report.svg(figure, "left", "Bars"), "With 95 % intervals."),
        "Which joint to protect": report.Table(
            protect, ("arm", "joint to protect, poses kept (as found)", "lock that leaves least")
        ),
        "All of it": links(*pages),
    }
    more = [f"{name}: protect {gain}; the lock that leaves least: {least}" for name, gain, least in protect]
    write(out, "cell", "Which arm for this cell?", answer, evidence, figure=figure, method=method, count=count, more=more)


if __name__ == "__main__":
    run(main, 500)
