// What holds the stick in the tests: a gamepad that is not there, and somebody who steers by what is drawn on the screen.
// Knows the page only as a person does: the blue dot has to come into the orange circle. Loaded before the page itself.
(() => {
  const SAID = "operator.said.";
  const pad = {
    id: "Stick of the tests",
    index: 0,
    connected: false,
    mapping: "standard",
    timestamp: 0,
    axes: [0, 0, 0, 0],
    buttons: Array.from({ length: 17 }, () => ({ pressed: false, touched: false, value: 0 })),
  };
  const operator = (window.operator = {
    pad,
    // Which raw axis is the deflection to the right, and up; where it rests; what full deflection adds.
    right: { axis: 0, centre: 0, range: 1 },
    up: { axis: 1, centre: 0, range: -1 },
    trigger: 0,
    // Trials that may still be begun.
    trials: 0,
    // "target", or "about": moves about and never comes to rest.
    goal: "target",
    // From hand to target, in radii of the target circle; null while none is drawn.
    way: null,
    phase: null,
    // Phases of trials, one after the other.
    phases: [],
    // Cycles of this trial that were sent.
    cycles: 0,
    // What was said to the server, as text.
    said: () => Object.keys(localStorage).filter((key) => key.startsWith(SAID)).map((key) => localStorage.getItem(key)),
    push(right, up) {
      for (const [map, value] of [
        [operator.right, right],
        [operator.up, up],
      ])
        pad.axes[map.axis] = map.centre + map.range * value;
    },
  });
  navigator.getGamepads = () => (pad.connected ? [pad] : []);

  function look() {
    if (!pad.connected) return;
    const { way, phase } = operator;
    const fresh = phase === "waiting" && operator.trials > 0 && !pad.buttons[operator.trigger].pressed;
    pad.buttons[operator.trigger].pressed = fresh;
    if (phase !== "running" || way === null) return operator.push(0, 0);
    if (operator.goal === "about") {
      const angle = performance.now() / 400;
      return operator.push(0.6 * Math.cos(angle), 0.6 * Math.sin(angle));
    }
    const far = Math.hypot(...way);
    const size = far < 0.6 ? 0 : Math.min(1, far / 5) / far;
    operator.push(size * way[0], size * way[1]);
  }

  // Kept where it outlives the tab.
  const { send } = WebSocket.prototype;
  WebSocket.prototype.send = function (text) {
    const { seq, type, time } = JSON.parse(text);
    if (seq !== undefined) {
      const before = localStorage.getItem(SAID + seq);
      if (before !== null && before !== text) throw new Error(`message ${seq} was another one before`);
      localStorage.setItem(SAID + seq, text);
      if (type === "begin") operator.cycles = 0;
      if (type === "cycles") operator.cycles += time.length;
    }
    return send.call(this, text);
  };

  const NUMBERS = ["cx", "cy", "r"];
  function watch() {
    const [target, tool] = [".target", ".tool-point"].map((part) => {
      const circle = document.querySelector(`[data-testid=arm-1] ${part}`);
      return circle && NUMBERS.map((name) => Number(circle.getAttribute(name)));
    });
    if (target && tool) {
      operator.way = [(target[0] - tool[0]) / target[2], (tool[1] - target[1]) / target[2]];
      look();
    }
    requestAnimationFrame(watch);
  }
  requestAnimationFrame(watch);

  new MutationObserver((changes) => {
    for (const { target } of changes) {
      if (target.dataset?.testid !== "trial") continue;
      const { phase } = target.dataset;
      operator.phase = phase;
      operator.phases.push(phase);
      if (phase === "running") operator.trials -= 1;
    }
  }).observe(document, { subtree: true, attributeFilter: ["data-phase"] });
})();
