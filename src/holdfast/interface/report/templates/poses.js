// Poses that can be selected in the figure above: index, worst joint, configuration, and the command that opens it in the
// studio. A click pins a pose; the slider selects any pose, from the worst to the best.
extras.poses = function (box, data) {
  const figure = box.previousElementSibling.querySelector("svg"), slider = box.querySelector("input");
  const bytes = Uint8Array.from(atob(data.rows), function (c) { return c.charCodeAt(0); });
  const wide = 6 + data.joints.length, numbers = new Float32Array(bytes.buffer), count = numbers.length / wide;
  const turned = document.getElementById(data.view), copied = box.querySelector("pre");
  let pinned = true;
  function dot(a, b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  const places = data.views.map(function (view) {
    const f = view.frame;
    return Array.from({ length: count }, function (_, k) {
      const at = numbers.subarray(k * wide + 3, k * wide + 6);
      return [
        f.box[0] + (dot(at, view.right) - f.x[0]) / (f.x[1] - f.x[0]) * (f.box[2] - f.box[0]),
        f.box[3] - (dot(at, view.up) - f.y[0]) / (f.y[1] - f.y[0]) * (f.box[3] - f.box[1]),
      ];
    });
  });
  const rings = places.map(function () {
    const ring = document.createElementNS(figure.namespaceURI, "circle");
    ring.setAttribute("r", 5.5);
    ring.setAttribute("class", "picked");
    figure.append(ring);
    return ring;
  });
  function short(x) { return Number.isFinite(x) ? String(Number(x.toPrecision(3))).replace("-", "\u2212") : "\u221e"; }
  function show(k) {
    const row = numbers.subarray(k * wide, (k + 1) * wide), failure = data.failures[row[2]], q = Array.from(row.subarray(6));
    const told = data.noun + " " + row[0].toLocaleString("en") + ": index " + short(row[1]) + ", " +
      (failure ? "worst if " + failure.name + " locks" : "singular");
    box.querySelector(".told").textContent = told;
    box.querySelector(".where").textContent = "tool at " + Array.from(row.subarray(3, 6), function (x) { return x.toFixed(3); })
      .join(", ").replace(/-/g, "\u2212") + "\u00a0m";
    box.querySelectorAll(".joints dd").forEach(function (cell, j) {
      const joint = data.joints[j];
      cell.textContent = (q[j] * joint.scale).toFixed(joint.unit === "m" ? 3 : 1).replace("-", "\u2212") + "\u00a0" + joint.unit;
    });
    copied.lastChild.textContent = data.command + " --q=" + q.map(function (x) { return x.toFixed(6); }).join(",") +
      (failure ? failure.option : "");
    slider.value = k;
    slider.setAttribute("aria-valuetext", told);
    rings.forEach(function (ring, n) {
      ring.setAttribute("cx", places[n][k][0]);
      ring.setAttribute("cy", places[n][k][1]);
    });
    if (turned && turned.view3d) { turned.view3d.pose(q); }
  }
  function nearest(event) {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(figure.getScreenCTM().inverse());
    let best = -1, least = 12 * 12;
    places.forEach(function (some) {
      some.forEach(function (p, k) {
        const far = (p[0] - at.x) * (p[0] - at.x) + (p[1] - at.y) * (p[1] - at.y);
        if (far < least) { best = k; least = far; }
      });
    });
    return best;
  }
  const state = box.querySelector(".state");
  function pin(now) {
    pinned = now;
    rings.forEach(function (ring) { ring.classList.toggle("pinned", now); });
    state.textContent = now ? "Pinned: click another dot, or move the slider." : "Click the dot to pin it.";
  }
  figure.addEventListener("pointermove", function (event) {
    const k = pinned ? -1 : nearest(event);
    if (k >= 0) { show(k); }
  });
  figure.addEventListener("click", function (event) {
    const k = nearest(event), same = pinned && k === Number(slider.value);
    if (k >= 0) { show(k); }
    pin(k >= 0 && !same);
  });
  slider.addEventListener("input", function () { show(Number(slider.value)); pin(true); });
  copied.replaceChildren(copier(function () { return copied.lastChild.textContent; }, copied), document.createElement("span"));
  if (turned) { turned.addEventListener("view3d:point", function (event) { show(event.detail); pin(true); }); }
  figure.classList.add("pointed");
  show(Number(slider.value));
  pin(false);
};
