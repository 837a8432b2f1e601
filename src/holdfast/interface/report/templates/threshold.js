// A threshold on a distribution: its line in the figure above, the probability of meeting it, and the failures that prevent it.
// All numbers were computed when the report was written; this script computes nothing.
extras.threshold = function (box, data) {
  const slider = box.querySelector("input"), figure = box.previousElementSibling.querySelector("svg");
  const lines = data.frames.map(function () {
    const line = document.createElementNS(figure.namespaceURI, "path");
    line.setAttribute("class", "threshold-line");
    figure.append(line);
    return line;
  });
  const rows = Array.from(box.querySelectorAll("dt"), function (row) { return row.textContent; });
  const answers = Array.from(box.querySelectorAll("[data-row]")), bars = Array.from(box.querySelectorAll(".bars li"));
  function place(frame, value) {
    const scale = frame.log ? Math.log : Number;
    const part = (scale(value) - scale(frame.x[0])) / (scale(frame.x[1]) - scale(frame.x[0]));
    return frame.box[0] + part * (frame.box[2] - frame.box[0]);
  }
  function show() {
    const k = Number(slider.value);
    box.querySelector(".asked").textContent = data.thresholds[k];
    answers.forEach(function (answer, row) { answer.textContent = data.answers[row][k]; });
    slider.setAttribute("aria-valuetext", data.thresholds[k] + ": " + data.answers.map(function (row, n) { return rows[n] + " " + row[k]; }).join("; "));
    data.frames.forEach(function (frame, n) {
      const x = place(frame, data.values[k]);
      const inside = x >= frame.box[0] - 0.5 && x <= frame.box[2] + 0.5;
      lines[n].setAttribute("d", inside ? "M" + x + " " + frame.box[1] + "V" + frame.box[3] : "");
    });
    const order = data.missed.map(function (each, n) { return { n: n, part: each[k] }; });
    order.sort(function (a, b) { return b.part - a.part || a.n - b.n; });
    bars.forEach(function (bar, n) {
      const each = order[n];
      bar.querySelector(".name").textContent = data.failures[each.n];
      bar.querySelector(".part").textContent = (100 * each.part).toFixed(1) + "\u00a0%";
      bar.querySelector(".bar").style.width = 100 * each.part + "%";
    });
  }
  slider.addEventListener("input", show);
  show();
};
