"""Choice between two arms for a cell, from models that holdfast ships.

Change the arms, the box and the required value to your own: python docs/dossiers/cell.py --out FOLDER
"""

import numpy as np
from matplotlib.figure import Figure
from owners_page import links, run, span, write

import holdfast as hf
from holdfast.core.probability import Difference
from holdfast.interface import report

NAMES = ("panda", "xarm7")
FINGERS = 0.1034  # m from flange to fingertips, as in the model of the panda's hand; the xarm7's model ends at its flange
NEEDED = 0.05  # required relative manipulability after any single lock
BOX = {"center": [0.45, 0, 0.3], "size": 0.4, "rpy_center": [np.pi, 0, 0], "rpy_size": np.radians(20)}  # m, rad; tool down


def better(shares):
    """Return the better of two arms by (N,) values at the same poses, both means, and their paired difference."""
    k = int(np.mean(shares[1]) > np.mean(shares[0]))
    d = Difference.of_fractions(np.asarray(shares[k], dtype=float) - shares[1 - k])
    means = f"{NAMES[k]} {np.mean(shares[k]):.1%}, {NAMES[1 - k]} {np.mean(shares[1 - k]):.1%}"
    apart = f"{NAMES[k]}, by {100 * d.value:.1f} percentage points ({100 * d.low:.1f} to {100 * d.high:.1f}, 95 %)"
    return NAMES[k] if d.low > 0 else "no difference found", means, apart


def left_figure(runs):
    """Draw the fraction of poses that each lock leaves, with the two arms next to each other."""
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
        (f"keeps {NEEDED} after any lock, first configuration found", *better(found)),
        (f"keeps {NEEDED} after any lock, best configuration of each pose", *better(chosen)),
        ("still reaches the pose after a lock, mean over the joints", *better(left)),
    ]
    winners = {row[1] for row in rows} - {"no difference found"}
    verdict = f"Buy the {winners.pop()}" if len(winners) == 1 else "Neither arm is better in every comparison"
    gains = [f"{np.mean(a):.1%} to {np.mean(b):.1%} ({name})" for name, a, b in zip(NAMES, found, chosen, strict=True)]
    answer = (
        f"{verdict}. The better arm for poses that keep {NEEDED} after any lock, in their best configurations, is "
        f"{better(chosen)[2]}. The better arm for poses that stay reachable after a lock is {better(left)[2]}. "
        f"Choosing the configurations raises the first fraction from {' and from '.join(gains)}."
    )
    protect = []
    for name, run_of in zip(NAMES, runs, strict=True):
        u, (joint, p) = compared.upgrades(name)[0], min(run_of.survival().items(), key=lambda x: x[1].value)
        change = f"{100 * u.gain:.1f} percentage points ({100 * u.low:.1f} to {100 * u.high:.1f})"
        gain = f"{u.joint}, from {u.before:.1%} to {u.after:.1%}, by {change}"
        protect.append((name, gain, f"{joint}, {span(p, digits=1)}"))
    pages = [compared.report(out / "comparison.html")]
    pages += [one.report(out / f"{name}.html", NEEDED) for name, one in zip(NAMES, runs, strict=True)]
    figure = left_figure(runs)
    method = (
        f"{count} poses with the tool pointing down, the same for both arms. {region.describe()}. "
        f"{'; '.join(f'{a.name}: {a.summary}, licence {a.licence}' for a in map(hf.arms.about, NAMES))}. "
        f"Both have a tool of {FINGERS} m; the panda's hand is rotated by 45 degrees on its flange. {NEEDED} is relative "
        "manipulability. A joint locks at its angle in another pose. A pose that is not found again counts as lost, and the "
        "intervals assume independent poses. Price, payload, speed, obstacles, the position of the base, and the failure rates "
        "of the joints are not considered."
    )
    evidence = {
        "Comparison": report.Table(rows, ("measure, at the same poses", "better arm", "fractions", "difference"), wide=True),
        "Remaining poses after a lock": report.Picture(report.svg(figure, "left", "Bars"), "With 95 % intervals."),
        "Joint to protect": report.Table(
            protect, ("arm", "joint to protect, and poses kept in the first configuration found", "worst lock")
        ),
        "Complete reports": links(*pages),
    }
    more = [f"{name}: protect {gain}. Worst lock: {least}." for name, gain, least in protect]
    title = "Choice between two arms for a cell"
    write(out, "cell", title, answer, evidence, figure=figure, method=method, count=count, more=more)


if __name__ == "__main__":
    run(main, 500)
