/** Colours after Okabe and Ito, darkened for thin lines as in holdfast's figures, which colour-blind people can distinguish. */

export const INK = "#1b1f24";
export const SOFT = "#59636e";
export const FAINT = "#d4d9de";
export const PALE = "#f1f4f6";
export const BLUE = "#0a5c9e";
export const SKY = "#a9cbe6";
export const ORANGE = "#c8500a";
export const GREEN = "#007a5e";
