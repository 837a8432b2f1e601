// Additions to viser's page: the dark theme of the system, a legend, dropped files, and pressed buttons.
"use strict";
(() => {
  const LARGEST = 4 << 20; // bytes; the server also rejects larger files
  const STATES = ["healthy", "locked", "free"];
  const search = new URLSearchParams(location.search);
  if (matchMedia("(prefers-color-scheme: dark)").matches && !search.has("darkMode")) {
    search.set("darkMode", "");
    history.replaceState(null, "", `?${search}`); // viser reads it when it starts
  }

  function alarm(text) {
    document.querySelector(".hf-alert")?.remove();
    const box = document.createElement("div");
    box.className = "hf-alert";
    box.setAttribute("role", "alert");
    box.textContent = text;
    document.body.append(box);
    setTimeout(() => box.remove(), 8000);
  }

  // ---- files -------------------------------------------------------------------------------------------------------

  const input = () => document.querySelector("input[type=file]");
  const tab = (name) => [...document.querySelectorAll("[role=tab]")].find((x) => x.textContent === name);
  const files = (event) => event.dataTransfer !== null && event.dataTransfer.types.includes("Files");

  function open(file, tries = 500) {
    if (input() === null && tries > 0) {
      if (tries % 50 === 0) { // the page may not be ready for the first press
        tab("File")?.click(); // on a phone; elsewhere tabs react to keys
        tab("File")?.dispatchEvent(new KeyboardEvent("keydown", { key: "Enter", bubbles: true }));
      }
      setTimeout(() => open(file, tries - 1), 30);
      return;
    }
    const one = new DataTransfer();
    one.items.add(file);
    input().files = one.files;
    input().dispatchEvent(new Event("change", { bubbles: true }));
  }

  addEventListener("dragover", (event) => {
    if (!files(event)) return;
    event.preventDefault();
    document.body.classList.add("hf-over");
  });
  for (const end of ["dragleave", "drop"]) addEventListener(end, () => document.body.classList.remove("hf-over"));
  addEventListener("drop", (event) => {
    if (!files(event)) return;
    event.preventDefault();
    if (event.dataTransfer.files.length === 1) open(event.dataTransfer.files[0]);
    else alarm("Drop one file at a time.");
  });
  let sent = 0, before; // time of an upload without an error so far, and the error message before it
  const bad = () => document.querySelector(".hf-line[data-bad]")?.textContent;

  addEventListener("change", (event) => {
    const file = event.target.type === "file" ? event.target.files[0] : undefined;
    if (file === undefined) return;
    if (file.size <= LARGEST) {
      [sent, before] = [Date.now(), bad()];
      return;
    }
    event.stopImmediatePropagation();
    event.target.value = "";
    alarm(`'${file.name}' is too large; at most 4 MiB can be opened here.`);
  }, true);

  function answer() { // viser reports every upload as successful, even if the file cannot be opened
    for (const part of document.querySelectorAll("[role=alert] *"))
      if (part.childElementCount === 0 && part.textContent === "File uploaded successfully.")
        part.textContent = "File received. The line above the controls shows whether it could be opened.";
    const now = bad();
    if (now !== undefined && now !== before && Date.now() - sent < 20000) {
      sent = 0;
      alarm(now);
    }
    before = now;
  }

  // ---- pressed buttons, and names for screen readers --------------------------------------------------------

  function mark() {
    for (const button of document.querySelectorAll("button")) {
      const text = button.textContent, state = text.replace(/^✓ /, "");
      if (text === "" && !button.getAttribute("aria-label"))
        button.setAttribute("aria-label", button.closest("[role=alert]") ? "Close" : "Connection and settings");
      if (!STATES.includes(state)) continue;
      button.setAttribute("aria-pressed", String(text !== state));
      button.classList.add(`hf-${state}`);
    }
    for (const label of document.querySelectorAll("label[for]")) {
      const control = document.getElementById(label.htmlFor);
      for (const part of control?.parentElement?.querySelectorAll("[role=slider], input") ?? [])
        if (part !== control && !part.getAttribute("aria-label")) part.setAttribute("aria-label", label.textContent);
    }
  }

  function fold() { // on a phone, viser folds the controls when their head is pressed, but does not mark the head as a button
    const head = document.querySelector(".mantine-Paper-root[style*='bottom: 0'] div[style*='cursor: pointer']");
    if (head === null) return;
    let button = head.querySelector(".hf-fold");
    if (button === null) {
      button = document.createElement("button");
      button.className = "hf-fold";
      head.append(button);
    }
    const open = head.nextElementSibling?.getAttribute("aria-hidden") !== "true", text = open ? "Hide controls" : "Show controls";
    if (button.textContent !== text) button.textContent = text;
    button.setAttribute("aria-expanded", String(open));
  }

  let waiting = false;
  function changed() {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => { waiting = false; mark(); fold(); answer(); });
  }

  addEventListener("DOMContentLoaded", () => {
    document.body.append(document.getElementById("holdfast-legend").content);
    document.getElementById("holdfast-legend-box").open = innerWidth > 768;
    const what = { subtree: true, childList: true, characterData: true, attributeFilter: ["aria-hidden"] };
    new MutationObserver(changed).observe(document.body, what);
  });
})();
