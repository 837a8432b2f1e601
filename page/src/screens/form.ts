/** A form: its questions come from the texts. */

import { button, h, paragraphs } from "../dom";
import type { Station } from "../station";
import type { Form, Question } from "../experiment";

type Answer = string | number | boolean;

interface Field {
  question: Question;
  element: HTMLElement;
  /** The answer; null while there is none. */
  read(): Answer | null;
  /** Answer somehow, in a dry run. */
  fill(chance: number): void;
}

/** @returns the answers; null where the person declined */
export function showForm(element: HTMLElement, station: Station, form: Form): Promise<Record<string, Answer> | null> {
  return new Promise((resolve) => {
    const fields = form.questions.map((q) => field(q, station));
    const submit = (): void => {
      const answers = collect(fields, station);
      if (answers !== null) resolve(answers);
    };
    const decline = form.decline === undefined ? null : button("decline", form.decline, () => resolve(null), "second");
    const send = h("button", { type: "submit", class: "primary", "data-testid": "submit" }, form.submit);
    const body = h(
      "form",
      { class: "card", "data-testid": `form-${form.name}`, novalidate: true },
      h("h1", {}, form.title),
      h("div", { class: "prose" }, ...paragraphs(form.text)),
      ...fields.map((f) => f.element),
      h("div", { class: "buttons" }, send, decline),
    );
    body.addEventListener("submit", (event) => {
      event.preventDefault();
      submit();
    });
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
  for (const f of fields) {
    const answer = f.read();
    const missing = (answer === null || (f.question.kind === "check" && answer === false)) && !f.question.optional;
    complain(f, missing ? station.texts.get(f.question.kind === "check" ? "answer_tick" : "answer_missing") : "");
    if (missing) first ??= f.element;
    else if (answer !== null) answers[f.question.name] = answer;
  }
  first?.scrollIntoView({ block: "center" });
  first?.querySelector<HTMLElement>("input")?.focus({ preventScroll: true });
  return first === null ? answers : null;
}

function complain(f: Field, text: string): void {
  const place = f.element.querySelector(".complaint");
  if (place) place.textContent = text;
}

function field(q: Question, station: Station): Field {
  switch (q.kind) {
    case "choice":
      return choice(q, station);
    case "check":
      return check(q);
    case "scale":
      return scale(q, station);
    case "number":
    case "text":
      return entry(q, station);
  }
}

function choice(q: Question, station: Station): Field {
  const inputs = (q.options ?? []).map((o) =>
    h("input", {
      type: "radio",
      name: q.name,
      value: o.value,
      id: `${q.name}-${o.value}`,
      "data-testid": `${q.name}-${o.value}`,
    }),
  );
  const options = (q.options ?? []).map((o, i) =>
    h("label", { class: "option", for: inputs[i].id }, inputs[i], h("span", {}, o.label)),
  );
  return {
    question: q,
    element: group(q, station, h("div", { class: "options" }, ...options)),
    read: () => inputs.find((i) => i.checked)?.value ?? null,
    fill: (chance) => void (inputs[Math.floor(chance * inputs.length)].checked = true),
  };
}

function check(q: Question): Field {
  const input = h("input", { type: "checkbox", id: q.name, "data-testid": q.name });
  const label = h("label", { class: "option", for: q.name }, input, h("span", {}, q.label));
  return {
    question: q,
    element: h("div", { class: "question" }, label, complaint()),
    read: () => input.checked,
    fill: () => void (input.checked = true),
  };
}

function scale(q: Question, station: Station): Field {
  const [from, to, step] = [q.from ?? 0, q.to ?? 100, q.step ?? 5];
  const middle = from + step * Math.round((to - from) / 2 / step);
  const input = h("input", {
    type: "range",
    min: from,
    max: to,
    step,
    value: middle,
    class: "untouched",
    "data-testid": q.name,
    "aria-label": q.label,
    "aria-describedby": `${q.name}-help`,
  });
  let touched = false;
  const touch = (): void => {
    touched = true;
    input.classList.remove("untouched");
  };
  // A slider says nothing before it was moved, or clicked where it is.
  for (const name of ["input", "pointerup", "keydown"]) {
    input.addEventListener(name, (event) => {
      if (
        !(event instanceof KeyboardEvent) ||
        event.key === " " ||
        event.key === "Enter" ||
        event.key.startsWith("Arrow")
      )
        touch();
    });
  }
  const ends = h("div", { class: "ends" }, h("span", {}, q.low), h("span", {}, q.high));
  return {
    question: q,
    element: group(q, station, h("div", { class: "scale" }, input, ends)),
    read: () => (touched ? input.valueAsNumber : null),
    fill: (chance) => {
      input.valueAsNumber = from + step * Math.round((chance * (to - from)) / step);
      touch();
    },
  };
}

function entry(q: Question, station: Station): Field {
  const number = q.kind === "number";
  const input = h("input", {
    type: number ? "number" : "text",
    id: q.name,
    "data-testid": q.name,
    min: q.from,
    max: q.to,
    maxlength: 200,
  });
  const [from, to] = [q.from ?? -Infinity, q.to ?? Infinity];
  return {
    question: q,
    element: group(q, station, input),
    read: () => {
      if (!number) return input.value.trim() || null;
      const value = input.valueAsNumber;
      return value >= from && value <= to ? value : null;
    },
    fill: (chance) =>
      void (input.value = number ? String(Math.round((q.from ?? 0) + chance * ((q.to ?? 100) - (q.from ?? 0)))) : "-"),
  };
}

function group(q: Question, station: Station, content: HTMLElement): HTMLElement {
  const optional = q.optional ? h("span", { class: "optional" }, ` (${station.texts.get("optional")})`) : null;
  const help = q.help ? h("p", { class: "help", id: `${q.name}-help` }, q.help) : null;
  return h("fieldset", { class: "question" }, h("legend", {}, q.label, optional), help, content, complaint());
}

function complaint(): HTMLElement {
  return h("p", { class: "complaint", role: "alert" });
}
