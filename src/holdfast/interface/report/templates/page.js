// Interactive functions of every report: theme, sortable tables, current entry in the table of contents, copy buttons, and the
// extras, which other scripts add.
"use strict";
const extras = {};

function element(name, text, className) {
  const made = document.createElement(name);
  if (text) { made.textContent = text; }
  if (className) { made.className = className; }
  if (name === "button") { made.type = "button"; }
  return made;
}

// A button that copies text(); if the browser refuses, the text is selected instead.
function copier(text, shown) {
  const button = element("button", "Copy", "copy");
  button.addEventListener("click", function () {
    const fail = function () { getSelection().selectAllChildren(shown); button.textContent = "Selected"; };
    if (!navigator.clipboard) { fail(); return; }
    navigator.clipboard.writeText(text()).then(function () { button.textContent = "Copied"; }, fail);
    setTimeout(function () { button.textContent = "Copy"; }, 1500);
  });
  return button;
}

// Sort key of a cell: its leading number, or else its text; null for an empty cell.
function sortKey(text) {
  const plain = text.trim().replace(/\u2212/g, "-").replace(/[\u00a0\u202f]/g, " ");
  if (plain === "" || plain === "\u2013") { return null; }
  const found = /^([<>\u2265\u2264+]?)\s*(-?)(\u221e|\d[\d,]*\.?\d*(?:e[+-]?\d+)?)/.exec(plain);
  if (!found) { return plain; }
  const size = found[3] === "\u221e" ? Infinity : Number(found[3].replace(/,/g, ""));
  const value = found[2] ? -size : size;
  return found[1] === "<" ? value - 1e-12 : found[1] === ">" ? value + 1e-12 : value;
}

function compareKeys(a, b) {
  if (typeof a === "number" && typeof b === "number") { return a - b || 0; }
  return String(a).localeCompare(String(b), "en", { numeric: true });
}

// The first line of a cell.
function firstLine(cell) {
  const nodes = Array.from(cell.childNodes), end = nodes.findIndex(function (node) { return node.nodeName === "BR"; });
  return nodes.slice(0, end < 0 ? nodes.length : end).map(function (node) { return node.textContent; }).join("");
}

// Rows in the order of a column; empty cells come last in both directions.
function sortedRows(rows, column, direction) {
  const keyed = rows.map(function (row) { return { row: row, key: sortKey(firstLine(row.cells[column])) }; });
  return keyed.sort(function (a, b) {
    if (a.key === null || b.key === null) { return (a.key === null) - (b.key === null); }
    return direction * compareKeys(a.key, b.key);
  }).map(function (each) { return each.row; });
}

function makeSortable(table) {
  const body = table.tBodies[0], heads = Array.from(table.tHead.rows[0].cells), first = Array.from(body.rows);
  heads.forEach(function (head, column) {
    if (head.tagName !== "TH") { return; }
    const button = element("button");
    button.append(...head.childNodes);
    head.append(button);
    head.setAttribute("aria-sort", "none");
    button.addEventListener("click", function () {
      const steps = head.classList.contains("number") ? ["descending", "ascending", "none"] : ["ascending", "descending", "none"];
      const next = steps[(steps.indexOf(head.getAttribute("aria-sort")) + 1) % 3];
      heads.forEach(function (each) { if (each.tagName === "TH") { each.setAttribute("aria-sort", "none"); } });
      head.setAttribute("aria-sort", next);
      body.append(...(next === "none" ? first : sortedRows(first, column, next === "ascending" ? 1 : -1)));
    });
  });
}

(function () {
  const root = document.documentElement, wish = matchMedia("(prefers-color-scheme: dark)");
  function kept(value) {
    try {
      if (value) { localStorage.setItem("holdfast-theme", value); }
      return localStorage.getItem("holdfast-theme");
    } catch (refused) { return value; }
  }
  function dark() { return root.dataset.theme ? root.dataset.theme === "dark" : wish.matches; }
  const before = kept();
  if (before) { root.dataset.theme = before; }

  function theme() {
    const button = document.querySelector(".theme");
    function say() { button.textContent = dark() ? "Light theme" : "Dark theme"; }
    button.hidden = false;
    button.addEventListener("click", function () {
      root.dataset.theme = dark() ? "light" : "dark";
      kept(root.dataset.theme);
      say();
    });
    wish.addEventListener("change", say);
    say();
  }

  // A region that does not scroll is removed from the tab order.
  function stops() {
    const seen = new ResizeObserver(function (changed) {
      changed.forEach(function (entry) {
        const region = entry.target;
        region.tabIndex = region.scrollWidth > region.clientWidth + 1 ? 0 : -1;
      });
    });
    document.querySelectorAll(".scroll, .plate").forEach(function (region) { seen.observe(region); });
  }

  function contents() {
    const links = Array.from(document.querySelectorAll("nav a"));
    const sections = links.map(function (link) { return document.getElementById(decodeURIComponent(link.hash.slice(1))); });
    let waiting = 0;
    function mark() {
      waiting = 0;
      const end = scrollY > 0 && scrollY + innerHeight >= root.scrollHeight - 2;
      let now = -1;
      sections.forEach(function (section, k) { if (end || section.getBoundingClientRect().top < innerHeight / 3) { now = k; } });
      links.forEach(function (link, k) {
        if (k !== now) { link.removeAttribute("aria-current"); return; }
        if (link.hasAttribute("aria-current")) { return; }
        link.setAttribute("aria-current", "true");
        const list = link.closest("ol");
        list.scrollTo({ left: link.offsetLeft - list.offsetLeft - 20, top: link.offsetTop - list.offsetTop - list.clientHeight / 2 });
      });
    }
    addEventListener("scroll", function () { waiting = waiting || requestAnimationFrame(mark); }, { passive: true });
    mark();
  }

  document.addEventListener("DOMContentLoaded", function () {
    theme();
    stops();
    contents();
    document.querySelectorAll("table.sortable").forEach(makeSortable);
    document.querySelectorAll("pre").forEach(function (pre) {
      const text = pre.textContent, shown = element("span");
      text.split(/(--[a-z][a-z-]*)/).forEach(function (part, k) { // browsers break lines after hyphens
        shown.append(k % 2 ? element("span", part, "option") : part);
      });
      pre.replaceChildren(copier(function () { return text; }, shown), shown);
    });
    document.querySelectorAll(".extra").forEach(function (box) {
      box.hidden = false;
      extras[box.dataset.extra](box, JSON.parse(box.querySelector("script").textContent));
    });
  });
}());
