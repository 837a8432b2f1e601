/** Wakes the page at a fixed rate. Drawing would slow down a timer of the page itself. */

let timer: ReturnType<typeof setTimeout> | undefined;

function run(rate: number): void {
  const start = performance.now();
  let k = 0;
  const tick = (): void => {
    self.postMessage(k);
    // If more than one cycle behind, continue with the next due cycle; the page counts the missed ones.
    k = Math.max(k + 1, Math.floor(((performance.now() - start) / 1000) * rate));
    timer = setTimeout(tick, start + (k * 1000) / rate - performance.now());
  };
  tick();
}

self.onmessage = (message: MessageEvent<number | null>): void => {
  clearTimeout(timer);
  if (message.data !== null) run(message.data);
};
