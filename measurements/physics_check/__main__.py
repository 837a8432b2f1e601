"""The same motions kinematically and in MuJoCo; writes RESULTS.md and the figure."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np

from holdfast.core.probability import Interval
from holdfast.interface.report import Curve, Mark, compare_cdf_figure, save_png
from measurements.physics_check.motions import ARRIVED, LIMIT, MOTIONS, RATE, SEED, SPREAD, Row, Setting, runs

HERE = Path(__file__).parent
SWEEP_LIMIT = 25.0  # s
NEAR = 5e-3  # m: ends of the same run

READING = """\
## What this says, and where it does not hold

- **Where the end effector ends is not a matter of dynamics.** The law is given the measured configuration, so an error
that servos
  make on the way is corrected as any other, and what is still for the law is still in MuJoCo. At the end of a run the
  hands are much closer together than they ever were on the way.
- **The way is a matter of servos and speed.** The kinematic hand has its full speed at once, the real arm has to accelerate,
  and light and heavy joints do not do so alike. The distance was largest 24 ms after the start in the median of the position
  runs, and after 0.48 s at the latest (measured apart from the tables, seed 1). Three times the gain, or a third of the
  bandwidth, is about three times the distance. Starting with a ramp was not tried.
- **It does not hold where motions are fast for the motors.** At a gain of 10/s motors reach their efforts, the
  references are held back, and the paths are centimetres apart. They still end at the same place, in these runs.
- **Different ends are possible, and were not met.** Where a failed arm has several places to stop, a start close to
  the border between their basins may go either way with any disturbance; none of these few starts was so close.
- **What slow runs do is left open.** Kinematically, half of the pose runs take more than 177 s to stop; in
  MuJoCo they are stopped at the time limit, and only the distances and whether the end effector is there can be compared.
- Not looked at: joint limits, contacts, sensor noise, dry friction, backlash, flexible joints, payloads that the controller
  does not know of, and controllers that stop when a joint does not follow, as many do.
"""

MAIN = tuple(Setting(arm, task) for task in ("pose", "position") for arm in ("xarm7", "panda"))
SOFT = tuple(Setting("panda", "position", bandwidth=b, limit=SWEEP_LIMIT) for b in (1.0, 3.0, 10.0, 30.0))
FAST = tuple(Setting("panda", "position", speed=None, gain=k, limit=SWEEP_LIMIT / k) for k in (0.3, 1.0, 3.0, 10.0))


def outcomes(found: dict[Setting, list[Row]]) -> list[str]:
    """Do both end in the same way?"""
    lines = [
        "| arm, task | runs | decided in both | of these, the same outcome "
        "| undecided in MuJoCo at the time limit, kinematically | same answer to: is the end effector there | hand "
        "moved, median |",
        "|---|---|---|---|---|---|---|",
    ]
    for setting in sorted(MAIN, key=lambda s: (s.arm, s.task)):
        rows = found[setting]
        both = [r for r in rows if "undecided" not in (r.kinematic, r.physical)]
        same = sum(r.kinematic == r.physical for r in both)
        kinds = Counter(r.kinematic for r in both)
        share = Interval.from_counts(same, len(both)) if both else "none"
        agreed = sum(r.there[0] == r.there[1] for r in rows)
        late = Counter(f"{r.kinematic} ({r.reason})" for r in rows if r.physical == "undecided")
        cells = [
            f"{setting.arm}, {setting.task}",
            f"{len(rows)}",
            f"{len(both)}: " + ", ".join(f"{n} {kind}" for kind, n in kinds.items()),
            f"{same}, share {share}",
            ", ".join(f"{n} {kind}" for kind, n in late.items()) or "none",
            f"{agreed} (there: {sum(r.there[0] for r in rows)}), share {Interval.from_counts(agreed, len(rows))}",
            f"{np.median([r.moved for r in rows]):.2f} m",
        ]
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def distances(found: dict[Setting, list[Row]], settings: Sequence[Setting], name: str) -> list[str]:
    """How far apart: medians, 95 % quantiles and the largest."""
    lines = [
        f"| {name} | tool paths apart, mm: median / 95 % / largest | ends apart, mm: median / 95 % / largest "
        f"| ends more than {1000 * NEAR:g} mm apart | servo error, rad: median | a motor at its effort | unstable |",
        "|---|---|---|---|---|---|---|",
    ]
    for setting in settings:
        rows = found[setting]
        cells = [
            setting.label if name != "arm, task" else f"{setting.arm}, {setting.task}",
            spread([r.path for r in rows]),
            spread([r.end for r in rows]),
            f"{sum(r.end > NEAR for r in rows)} of {len(rows)}",
            f"{np.median([r.tracking for r in rows]):.4f}",
            f"{sum(r.saturated > 0 for r in rows)} runs, at most {max(r.saturated for r in rows):.1%} of the time",
            f"{sum(r.reason == 'unstable' for r in rows)}",
        ]
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def spread(values: Sequence[float]) -> str:
    """Median, 95 % quantile and largest of metres, in mm."""
    return " / ".join(f"{1000 * x:.3g}" for x in np.quantile(values, [0.5, 0.95, 1.0]))


def worst(found: dict[Setting, list[Row]]) -> list[str]:
    """The runs whose paths are farthest apart, and those that end differently."""
    every = [(s, r) for s, rows in found.items() for r in rows]
    far = sorted(every, key=lambda x: -x[1].path)[:8]
    other = [x for x in every if "undecided" not in (x[1].kinematic, x[1].physical) and x[1].kinematic != x[1].physical]
    lines = [
        "| arm, task, servos | locked joint | paths apart, mm | ends apart, mm | kinematic / in MuJoCo "
        "| largest servo error, rad | motor at its effort |",
        "|---|---|---|---|---|---|---|",
    ]
    for setting, r in [*far, *(x for x in other if x not in far)]:
        ends = f"{r.kinematic} / {r.physical}" + ("" if r.reason == "none" else f" ({r.reason})")
        lines.append(
            f"| {setting.arm}, {setting.task}, {setting.label} | {r.joint + 1} | {1000 * r.path:.3g} | {1000 * r.end:.3g} "
            f"| {ends} | {r.tracking:.3g} | {r.saturated:.1%} of the time |"
        )
    return lines


def figure(found: dict[Setting, list[Row]], settings: Sequence[Setting], title: str, file: str) -> None:
    """Cumulative distributions of the distance of the tool paths."""
    curves, grid = [], np.geomspace(0.01, 100, 400)
    for setting in settings:
        x = np.sort([1000 * r.path for r in found[setting]])
        curves.append(Curve(grid, np.searchsorted(x, grid, side="right") / len(x), setting.label))
    made = compare_cdf_figure(
        [(f"Panda, position, each joint locked: {title}", curves)],
        [Mark(1.0, "1 mm")],
        "largest distance between kinematic and MuJoCo tool path, mm",
        ylabel=f"share of {len(found[settings[0]])} runs",
        log=True,
    )
    save_png(made, HERE / file)


def main() -> None:
    """Make everything and write RESULTS.md."""
    settings = list(dict.fromkeys((*MAIN, *SOFT, *FAST)))
    with ProcessPoolExecutor(2, get_context("spawn")) as pool:
        found = dict(zip(settings, pool.map(runs, settings), strict=True))
    figure(found, SOFT, "by servo bandwidth", "by-bandwidth.png")
    figure(found, FAST, "by gain", "by-gain.png")
    lines = [
        "# Does the kinematic picture hold? The closed loop with a locked joint, in MuJoCo",
        "",
        f"Written by `python -m measurements.physics_check`, seed {SEED}. Everything is measured.",
        "",
        "A joint stands from the start and the controller does not know. `hf.simulate` lets the healthy joints do what they",
        "are told; `hf.simulate_physics` gives the arm its bodies, motors with PD servos and torque limits, and welds the",
        f"joint. Law: pseudoinverse, gain 1/s. {MOTIONS} motions for each arm (start within {SPREAD:g} rad of home in every",
        f"joint, the target's configuration within {SPREAD:g} rad of that), each joint locked once. Control at {RATE:g} Hz,",
        "physics at 1 kHz, gravity compensated, efforts and friction of the URDF files, damping ratio 1.",
        "",
        f"## Outcomes: servos of 10 Hz, at most 0.25 m/s, {LIMIT:g} s",
        "",
        "Intervals are 95 % (exact). At the time limit a slow run is undecided in MuJoCo; the kinematic loop has 3000 s.",
        f"So we also ask of both, when the run in MuJoCo ends: is the error below {ARRIVED:g} (m and rad)?",
        "",
        *outcomes(found),
        "",
        "## Distances, the same runs",
        "",
        *distances(found, sorted(MAIN, key=lambda s: (s.arm, s.task)), "arm, task"),
        "",
        f"## By servo bandwidth: panda, position, {SWEEP_LIMIT:g} s",
        "",
        *distances(found, SOFT, "servos"),
        "",
        f"## By speed: panda, position, no speed limit, {SWEEP_LIMIT:g}/gain",
        "",
        *distances(found, FAST, "gain"),
        "",
        "![Distances of the tool paths by servo bandwidth](by-bandwidth.png)",
        "![Distances of the tool paths by gain](by-gain.png)",
        "",
        "## The worst",
        "",
        *worst(found),
        "",
        *READING.splitlines(),
    ]
    (HERE / "RESULTS.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
