/** All texts that people read come from the server, in the language of the laboratory. */

export class Texts {
  constructor(private readonly texts: Record<string, string>) {}

  /** The text of a key, with `{name}` replaced. A key that is missing shows itself. */
  get(key: string, values: Record<string, string | number> = {}): string {
    const text = this.texts[key] ?? key;
    return text.replace(/\{(\w+)\}/g, (all, name: string) => (name in values ? String(values[name]) : all));
  }
}

/** The server's reason for something, which is written like an error message, as a sentence. */
export function sentence(reason: string): string {
  return `${reason.charAt(0).toUpperCase()}${reason.slice(1)}${/[.!?]$/.test(reason) ? "" : "."}`;
}
