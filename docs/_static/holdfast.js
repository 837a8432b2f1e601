// What scrolls sideways can be scrolled with the keyboard.
addEventListener("DOMContentLoaded", () => {
  for (const box of document.querySelectorAll(".highlight pre, .table-wrapper, .live-figure, .math-block")) {
    if (box.scrollWidth > box.clientWidth) box.tabIndex = 0;
  }
});
