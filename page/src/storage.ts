/** Data that a station stores between visits: the session, unsent messages, and calibrations of joysticks. */

import type { Numbered } from "./outbox";

export interface Kept {
  session: string;
  subject: string;
  outbox: Numbered[];
}

export class Storage {
  /** @param suffix keeps stations apart that share a browser */
  constructor(private readonly suffix: string) {}

  get kept(): Kept | null {
    return this.read("session");
  }

  set kept(value: Kept | null) {
    this.write("session", value);
  }

  read<T>(name: string): T | null {
    try {
      const text = localStorage.getItem(this.name(name));
      return text === null ? null : (JSON.parse(text) as T);
    } catch {
      return null; // storage is forbidden or has invalid content, which counts as empty
    }
  }

  write(name: string, value: unknown): void {
    try {
      if (value === null) localStorage.removeItem(this.name(name));
      else localStorage.setItem(this.name(name), JSON.stringify(value));
    } catch {
      // Storage is forbidden or full: the session continues, only a closed tab cannot be resumed on its own.
    }
  }

  private name(name: string): string {
    return `holdfast.${name}${this.suffix}`;
  }
}
