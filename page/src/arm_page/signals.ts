/** Residuals of a monitor over time, each divided by its threshold, as small plots. */

import { createSvg, h } from "../dom";
import type { Watch } from "./answers";
import { fillText } from "./phrases";

const [WIDTH, HEIGHT] = [360, 84];
/** Drawn range of a residual, in units of its threshold, on a logarithmic scale. */
const [LOWEST, HIGHEST] = [0.1, 30];

const heightOf = (value: number): number => {
  const restricted = Math.min(HIGHEST, Math.max(LOWEST, value));
  return HEIGHT * (1 - Math.log(restricted / LOWEST) / Math.log(HIGHEST / LOWEST));
};

/** Draw each signal until a time, s, with the threshold, the onset of the fault, and the alarm. */
export function drawSignals(watch: Watch, now: number, joints: string[], texts: Record<string, string>): HTMLElement[] {
  const { time, onset, alarm, isolated } = watch;
  const end = time[time.length - 1] || 1;
  const shown = time.filter((t) => t <= now + 1e-9).length;
  const mark = (name: string, at: number | null): SVGElement[] =>
    at === null || at > now ? [] : [createSvg("path", { class: `signal-${name}`, d: `M${(WIDTH * at) / end} 0V${HEIGHT}` })];
  return watch.signals.map(({ label, values }) => {
    const columns = values[0]?.map((_, joint) => values.slice(0, shown).map((row) => row[joint])) ?? [];
    const lines = columns.map((column, joint) => {
      const points = column.flatMap((value, k) =>
        value === null ? [] : [`${((WIDTH * time[k]) / end).toFixed(1)},${heightOf(value).toFixed(1)}`]);
      const named = columns.length > 1 && isolated?.joint === joint && now >= isolated.from;
      return createSvg("polyline", { class: named ? "signal-line signal-named" : "signal-line", points: points.join(" ") });
    });
    const above = joints.filter((_, joint) => columns.length > 1 && columns[joint].some((value) => value !== null && value > 1));
    const alternative = fillText(texts.studio_signal, { label, time: now.toFixed(2), joints: above.join(", ") || "none" });
    const svg = createSvg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: "signal", role: "img", "aria-label": alternative });
    svg.append(
      ...lines.sort((a, b) => a.classList.length - b.classList.length),
      createSvg("path", { class: "signal-limit", d: `M0 ${heightOf(1)}H${WIDTH}` }),
      ...mark("onset", onset),
      ...mark("alarm", alarm),
      createSvg("text", { x: 2, y: heightOf(1) - 3 }, "1"),
    );
    return h("figure", {}, h("figcaption", {}, fillText(texts.studio_signal_title, { label })), svg);
  });
}
