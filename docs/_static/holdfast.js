// What scrolls sideways can be scrolled with the keyboard.
addEventListener("DOMContentLoaded", () => {
  for (const box of document.querySelectorAll(".highlight pre, .table-wrapper, .live-figure, .math-block")) {
    if (box.scrollWidth > box.clientWidth) box.tabIndex = 0;
  }
});

// Loops stand still, in their first picture, for those who asked for less motion; a click opens the file.
if (matchMedia("(prefers-reduced-motion: reduce)").matches) {
  addEventListener("load", () => {
    for (const loop of document.querySelectorAll('img[src*="loops/"]')) {
      const still = document.createElement("canvas");
      [still.width, still.height] = [loop.naturalWidth, loop.naturalHeight];
      still.getContext("2d").drawImage(loop, 0, 0);
      loop.src = still.toDataURL();
    }
  });
}
