/** A form: its questions come from the texts. */

import { button, card, h, option } from "../dom";
import type { Station } from "../station";
import type { Form, Question } from "../experiment";

type Answer = string | number | boolean;

interface Field {
  question: Question;
  element: HTMLElement;
  /** The answer; null if there is none, or none that is valid. */
  read(): Answer | null;
  /** Answer somehow, in a dry run. */
  fill(chance: number): void;
}

/** @returns the answers; null where the person declined */
export function showForm(element: HTMLElement, station: Station, form: Form): Promise<Record<string, Answer> | null> {
  return new Promise((resolve) => {
    const fields = form.questions.map((q) => CREATORS[q.kind](q, station));
    const submit = (): void => {
      const answers = collect(fields, station);
      if (answers !== null) resolve(answers);
    };
    const decline = form.decline === undefined ? null : button("decline", form.decline, () => resolve(null), "second");
    const send = h("button", { type: "submit", class: "primary", "data-testid": "submit" }, form.submit);
    const properties = { class: "card", "data-testid": `form-${form.name}`, novalidate: true };
    const buttons = h("div", { class: "buttons" }, send, decline);
    const body = card("form", properties, form.title, form.text, ...fields.map((f) => f.element), buttons);
    body.onsubmit = (event): void => {
      event.preventDefault();
      submit();
    };
    element.replaceChildren(body);
    body.querySelector<HTMLElement>("input, select")?.focus({ preventScroll: true });
    const random = station.robot;
    if (random !== null) fields.forEach((f) => f.fill(random.uniform()));
    station.auto(submit);
  });
}

function collect(fields: Field[], station: Station): Record<string, Answer> | null {
  const answers: Record<string, Answer> = {};
  let first: HTMLElement | null = null;
  for (const { question, element, read } of fields) {
    const answer = read();
    const missing = answer === null && !question.optional;
    const complaint = element.querySelector(".complaint");
    const reason = question.kind === "check" ? "answer_tick" : "answer_missing";
    if (complaint) complaint.textContent = missing ? station.texts.get(reason) : "";
    if (missing) first ??= element;
    else if (answer !== null) answers[question.name] = answer;
  }
  first?.scrollIntoView({ block: "center" });
  first?.querySelector<HTMLElement>("input")?.focus({ preventScroll: true });
  return first === null ? answers : null;
}

const CREATORS: Record<Question["kind"], (q: Question, station: Station) => Field> = {
  choice: createChoice,
  check: createCheck,
  scale: createScale,
  number: createEntry,
  text: createEntry,
};

function createChoice(q: Question, station: Station): Field {
  const { name, options = [] } = q;
  const inputs = options.map(({ value }) => h("input", { type: "radio", name, value, "data-testid": `${name}-${value}` }));
  return {
    question: q,
    element: group(q, station, h("div", { class: "options" }, ...inputs.map((input, i) => option(input, options[i].label)))),
    read: () => inputs.find((i) => i.checked)?.value ?? null,
    fill: (chance) => void (inputs[Math.floor(chance * inputs.length)].checked = true),
  };
}

function createCheck(q: Question): Field {
  const input = h("input", { type: "checkbox", "data-testid": q.name });
  return {
    question: q,
    element: h("div", { class: "question" }, option(input, q.label), complaint()),
    read: () => input.checked || (q.optional ? false : null),
    fill: () => void (input.checked = true),
  };
}

function createScale(q: Question, station: Station): Field {
  const [from, to, step] = [q.from ?? 0, q.to ?? 100, q.step ?? 5];
  const input = h("input", {
    type: "range",
    min: from,
    max: to,
    step,
    value: from + step * Math.round((to - from) / 2 / step),
    class: "untouched",
    "data-testid": q.name,
    "aria-label": q.label,
    "aria-describedby": `${q.name}-help`,
  });
  const touch = (): void => input.classList.remove("untouched");
  // A slider has no answer before it was moved, or clicked or confirmed at its first position.
  input.addEventListener("input", touch);
  input.addEventListener("pointerup", touch);
  input.addEventListener("keydown", ({ key }) => /^( |Enter|Arrow.*)$/.test(key) && touch());
  const ends = h("div", { class: "ends" }, h("span", {}, q.low), h("span", {}, q.high));
  return {
    question: q,
    element: group(q, station, h("div", { class: "scale" }, input, ends)),
    read: () => (input.classList.contains("untouched") ? null : input.valueAsNumber),
    fill: (chance) => {
      input.valueAsNumber = from + step * Math.round((chance * (to - from)) / step);
      touch();
    },
  };
}

function createEntry(q: Question, station: Station): Field {
  const { kind, from = -Infinity, to = Infinity } = q;
  const input = h("input", { type: kind, id: q.name, "data-testid": q.name, min: q.from, max: q.to, maxlength: 200 });
  const random = (chance: number): number => Math.round((q.from ?? 0) + chance * ((q.to ?? 100) - (q.from ?? 0)));
  const read = (): Answer | null => {
    if (kind === "text") return input.value.trim() || null;
    return input.valueAsNumber >= from && input.valueAsNumber <= to ? input.valueAsNumber : null;
  };
  const fill = (chance: number): void => void (input.value = kind === "text" ? "-" : String(random(chance)));
  return { question: q, element: group(q, station, input), read, fill };
}

function group(q: Question, station: Station, content: HTMLElement): HTMLElement {
  const optional = q.optional ? h("span", { class: "optional" }, ` (${station.texts.get("optional")})`) : null;
  const help = q.help ? h("p", { class: "help", id: `${q.name}-help` }, q.help) : null;
  return h("fieldset", { class: "question" }, h("legend", {}, q.label, optional), help, content, complaint());
}

function complaint(): HTMLElement {
  return h("p", { class: "complaint", role: "alert" });
}
