/** Numbers and sentences as the page shows them; holdfast/interface/presentation/arm_page/phrases.py writes the same. */

/** Replace each {word} of a text. */
export function fillText(text: string, values: Record<string, string | number> = {}): string {
  return text.replace(/\{(\w+)\}/g, (match, key: string) => String(values[key] ?? match));
}

/** A fraction as a percentage with one decimal place below 10 %. */
export function formatPercent(fraction: number): string {
  const percent = 100 * fraction;
  if (percent >= 9.95) return `${percent.toFixed(0)}\u00a0%`;
  if (percent >= 0.05) return `${percent.toFixed(1)}\u00a0%`;
  return percent > 1e-7 ? "<\u00a00.1\u00a0%" : "0\u00a0%";
}

/** A length in metres as centimetres, or as millimetres below 10 cm. */
export function formatLength(metres: number): string {
  return metres < 0.1 ? `${(1000 * metres).toFixed(0)}\u00a0mm` : `${(100 * metres).toFixed(0)}\u00a0cm`;
}

export const formatAngle = (radians: number): string => `${((180 * radians) / Math.PI).toFixed(0)}°`;

/** "joint 2", "joint 2 and joint 4", "joint 1, joint 2 and joint 4". */
export function joinNames(names: string[]): string {
  return names.length < 2 ? names.join("") : `${names.slice(0, -1).join(", ")} and ${names[names.length - 1]}`;
}

export const capitalise = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);
