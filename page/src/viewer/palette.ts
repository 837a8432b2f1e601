/** Colours of a picture, after Okabe and Ito: dark on a light page, bright on a dark one. */

import type { Vector } from "./scene";

const RGB = (text: string): Vector => [1, 3, 5].map((k) => parseInt(text.slice(k, k + 2), 16) / 255) as Vector;
const LIGHT = {
  dark: false, ink: RGB("#1b1f24"), soft: RGB("#59636e"), faint: RGB("#d9dee3"), paper: RGB("#ffffff"), outline: RGB("#1b1f24"),
  blue: RGB("#0a5c9e"), orange: RGB("#c8500a"), green: RGB("#007a5e"), purple: RGB("#a8497f"),
};
const DARK: Palette = {
  dark: true, ink: RGB("#f2f4f6"), soft: RGB("#a9b3bd"), faint: RGB("#3a434c"), paper: RGB("#14181c"), outline: RGB("#59636e"),
  blue: RGB("#6cb4ee"), orange: RGB("#ff9a4d"), green: RGB("#3fcb9d"), purple: RGB("#e48fc0"),
};
export type Palette = typeof LIGHT;

/** The palette that suits the colour of an element's text. */
export function choosePalette(element: Element): Palette {
  const text = getComputedStyle(element).color.match(/[\d.]+/g)?.map(Number) ?? [0, 0, 0];
  return text[0] + text[1] + text[2] > 384 ? DARK : LIGHT;
}

export const css = (color: Vector, opacity = 1): string => `rgba(${color.map((x) => Math.round(255 * x)).join(",")},${opacity})`;
