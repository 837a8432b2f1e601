const sendColorScheme = () => {
  const [r, g, b] = getComputedStyle(this).color.match(/[\d.]+/g).map(Number);
  this.contentWindow?.postMessage({ dark: r + g + b > 384 }, '*');
};
const observer = new MutationObserver(sendColorScheme);
for (const node of [document.documentElement, document.body]) observer.observe(node, { attributes: true });
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', sendColorScheme);
sendColorScheme();
