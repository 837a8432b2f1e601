/** Elements, built without markup: nothing that comes from a file is ever read as HTML. */

type Child = Node | string | null | undefined;

interface Properties {
  id?: string;
  class?: string;
  /** Called on a click, or on the keyboard's equivalent. */
  onclick?: (event: MouseEvent) => void;
  /** Any other attribute. */
  [name: string]: unknown;
}

/** An element with properties and children. `true` sets an empty attribute, `false` and null set none. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  properties: Properties = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name === "onclick") element.addEventListener("click", value as EventListener);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, String(value));
  }
  for (const child of children) if (child !== null && child !== undefined) element.append(child);
  return element;
}

/** An SVG element with attributes and text. */
export function createSvg(tag: string, attributes: Record<string, string | number> = {}, text = ""): SVGElement {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  if (text) element.textContent = text;
  return element;
}

/** Paragraphs of a text, separated by empty lines. */
export function paragraphs(text: string): HTMLParagraphElement[] {
  return text
    .trim()
    .split(/\n\s*\n/)
    .filter((part) => part.length)
    .map((part) => h("p", {}, part.trim()));
}

/** A menu with a label; `choose` is called with the index of the selected option. */
export function createMenu(
  label: string,
  options: string[],
  selected: number,
  choose: (index: number) => void,
): HTMLLabelElement {
  const menu = h("select", {}, ...options.map((name, k) => h("option", { selected: k === selected }, name)));
  menu.addEventListener("change", () => choose(menu.selectedIndex));
  return h("label", {}, h("span", {}, label), menu);
}

/** A labelled button that opens a file; one that is dropped anywhere on the page is opened as well. */
export function createFilePicker(label: string, accept: string, open: (file: File) => void): HTMLLabelElement {
  const picker = h("input", { type: "file", accept });
  const openFirst = (files?: FileList | null): void => void (files?.[0] && open(files[0]));
  picker.addEventListener("change", () => {
    openFirst(picker.files);
    picker.value = "";
  });
  document.addEventListener("dragover", (event) => event.preventDefault());
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    openFirst(event.dataTransfer?.files);
  });
  return h("label", {}, h("span", {}, label), picker);
}

/** A button with an id that tests and experimenters can rely on. */
export function button(id: string, label: string, onclick: () => void, kind = "primary"): HTMLButtonElement {
  return h("button", { type: "button", class: kind, "data-testid": id, onclick }, label);
}

/** A screen's card: a heading and paragraphs above its content. */
export function card<K extends "section" | "form">(
  tag: K,
  properties: Properties,
  title: string,
  text: string,
  ...content: Child[]
): HTMLElementTagNameMap[K] {
  return h(tag, properties, h("h1", {}, title), h("div", { class: "prose" }, ...paragraphs(text)), ...content);
}

/** A radio button or checkbox with its label next to it. */
export function option(input: HTMLInputElement, ...label: Child[]): HTMLLabelElement {
  return h("label", { class: "option" }, input, h("span", {}, ...label));
}

/** Change a text only if it differs, so that a screen reader does not repeat it. */
export function setText(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}
