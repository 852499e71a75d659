// Makes elements and writes numbers.

type Child = Node | string;

/** Make an element: `make("button", { class: "play", title: "Play" }, "▶")`. */
export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

export function button(label: string, title: string, onClick: () => void): HTMLButtonElement {
  const element = make("button", { type: "button", title, "aria-label": title }, label);
  element.addEventListener("click", onClick);
  return element;
}

/** "12.345678": seconds, by default so exact that frames can be told apart. */
export function timeText(timeNs: number, digits = 6): string {
  return (timeNs / 1e9).toFixed(digits);
}

/** "1:02:03" or "2:03". */
export function clockText(timeNs: number): string {
  const seconds = Math.floor(timeNs / 1e9);
  const parts = [Math.floor(seconds / 60) % 60, seconds % 60].map((part) => String(part).padStart(2, "0"));
  const hours = Math.floor(seconds / 3600);
  return hours ? `${hours}:${parts.join(":")}` : parts.join(":").replace(/^0/, "");
}

export function durationText(durationNs: number): string {
  if (durationNs < 1e6) return `${(durationNs / 1e3).toFixed(durationNs % 1e3 ? 1 : 0)} µs`;
  return durationNs < 1e9 ? `${(durationNs / 1e6).toFixed(2)} ms` : `${(durationNs / 1e9).toFixed(2)} s`;
}

export function distanceText(meters: number): string {
  if (meters >= 10_000) return `${(meters / 1000).toFixed(1)} km`;
  return `${meters.toFixed(meters < 100 ? 1 : 0)} m`;
}

export function countText(count: number): string {
  return count.toLocaleString("en-US");
}

export function shareText(share: number): string {
  return share < 0.0005 ? "< 0.1 %" : `${(100 * share).toFixed(1)} %`;
}

/** The least number of device pixels in a pixel of the page: more while a picture is taken. */
export const sharpness = { least: 1 };

export function deviceRatio(): number {
  return Math.max(window.devicePixelRatio, sharpness.least);
}

/** Draw on a canvas in pixels of the page; return its context, cleared, and its size. */
export function prepareCanvas(canvas: HTMLCanvasElement): [CanvasRenderingContext2D, number, number] {
  const { clientWidth: width, clientHeight: height } = canvas;
  const ratio = deviceRatio();
  const [wide, tall] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== wide || canvas.height !== tall) {
    canvas.width = wide;
    canvas.height = tall;
  }
  const context = canvas.getContext("2d") as CanvasRenderingContext2D;
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return [context, width, height];
}
