// Colors that people with any color vision can tell apart, and the words for outcomes.

export const isDark = window.matchMedia("(prefers-color-scheme: dark)");

type Pair = readonly [light: string, dark: string];

/** `dash`: length of the dashes of a lost one, in pixels. Red and orange: other frames were in the way. */
const OUTCOMES: Record<string, { color: Pair; dash: number }> = {
  delivered: { color: ["#5f86ad", "#7fa3c7"], dash: 0 },
  below_sensitivity: { color: ["#9a9a9a", "#7a7a7a"], dash: 4 },
  in_air: { color: ["#9a9a9a", "#7a7a7a"], dash: 0 },
  interference: { color: ["#c1121f", "#ff4d5e"], dash: 8 },
  receiver_transmitting: { color: ["#d9480f", "#ff7a4d"], dash: 5 },
  receiver_locked: { color: ["#7a3fb0", "#b795f0"], dash: 5 },
  captured: { color: ["#7a4a12", "#c9975a"], dash: 5 },
  noise: { color: ["#b39200", "#f0d03c"], dash: 2.5 },
  preamble_undetected: { color: ["#007a59", "#00b386"], dash: 2.5 },
  header_error: { color: ["#1a8fd1", "#56b4e9"], dash: 2.5 },
  lost: { color: ["#b39200", "#f0d03c"], dash: 2.5 },
};

const GROUPS: Pair[] = [
  ["#0b5cad", "#5aa9f2"],
  ["#3d4a57", "#c3ced9"],
  ["#00735a", "#3fc9a4"],
  ["#7b4b94", "#c79be0"],
  ["#8a6d1d", "#dcc36a"],
];

function pick(pair: Pair): string {
  return pair[isDark.matches ? 1 : 0];
}

export function outcomeColor(name: string): string {
  return pick(OUTCOMES[name]?.color ?? ["#777777", "#aaaaaa"]);
}

export function outcomeDash(name: string): number {
  return OUTCOMES[name]?.dash ?? 4;
}

/** Give an element, and what is in it, the color and the dashes of an outcome. */
export function paintOutcome(element: HTMLElement, name: string): void {
  element.style.setProperty("--color", outcomeColor(name));
  element.style.setProperty("--dash", `${outcomeDash(name) || 100}px`);
}

export function groupColor(group: number): string {
  return pick(GROUPS[group % GROUPS.length]);
}

/** The color of a style variable of the page, such as `--ink`. */
export function styleColor(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** A color for words on a background. */
export function inkOn(background: string): string {
  const [red, green, blue] = rgb(background);
  return 0.3 * red + 0.6 * green + 0.1 * blue > 0.5 ? "#1b2229" : "#e8ecf0";
}

/** Red, green and blue of "#rrggbb", from 0 to 1. */
export function rgb(color: string): [number, number, number] {
  const value = Number.parseInt(color.slice(1), 16);
  return [(value >> 16) / 255, ((value >> 8) & 255) / 255, (value & 255) / 255];
}
