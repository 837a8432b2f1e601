/** Wakes the page up at a fixed rate. A timer of the page itself would be slowed down by its drawing. */

let timer: ReturnType<typeof setTimeout> | undefined;

function run(rate: number): void {
  const start = performance.now();
  let k = 0;
  const tick = (): void => {
    self.postMessage(k);
    // Behind by more than one cycle: continue with the next that is due, the page counts what was missed.
    k = Math.max(k + 1, Math.floor(((performance.now() - start) / 1000) * rate));
    timer = setTimeout(tick, start + (k * 1000) / rate - performance.now());
  };
  tick();
}

self.onmessage = (message: MessageEvent<number | null>): void => {
  clearTimeout(timer);
  if (message.data !== null) run(message.data);
};
