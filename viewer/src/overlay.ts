// What is written over the 3-D picture: names of nodes and a scale bar. Finds the node under the mouse, too.

import { inkOn, styleColor } from "./colors";
import { distanceText, prepareCanvas } from "./dom";
import { drawLegend } from "./legend";
import { Look } from "./look";
import { Replay } from "./replay";
import { Scene } from "./scene";
import { State } from "./state";

const NEAR_PX = 16;

export class Overlay {
  private occurring: string[] | null = null;
  private readonly widths = new Map<string, number>(); // of names
  private readonly places = new Map<number, { x: number; y: number; depth: number }>();

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly replay: Replay,
    private readonly scene: Scene,
    private readonly legendOf: readonly Replay[] = [replay],
  ) {}

  draw(timeNs: number, positions: Float64Array, state: Readonly<State>, look: Look): void {
    const [context, width, height] = prepareCanvas(this.canvas);
    this.project(positions, width, height);
    context.font = "12px system-ui, sans-serif";
    context.textBaseline = "middle";
    context.lineJoin = "round";
    context.lineWidth = 3;
    context.strokeStyle = styleColor("--scene");
    context.fillStyle = inkOn(styleColor("--scene"));
    if (state.labels) this.drawLabels(context, width, timeNs, state.node, look.nameless);
    if (state.legend && this.legendOf.length) drawLegend(context, [...this.scene.groups.keys()], this.outcomes());
    this.drawScale(context, height);
  }

  /** Outcomes of the runs of the legend; of one that goes on, those that are possible. */
  private outcomes(): string[] {
    if (this.occurring !== null) return this.occurring;
    const names = this.legendOf.flatMap(({ whole, possible, run }) => {
      const sums = whole?.sums(null);
      return run.outcomes.filter((_, outcome) => (sums ? sums[outcome] : possible.includes(outcome)));
    });
    const found = [...new Set(names)];
    if (this.replay.whole !== null) this.occurring = found;
    return found;
  }

  /** Call `choose` with the node clicked on the 3-D picture, or null for none, and whether Shift was pressed. Dragging is not a click. */
  onClick(canvas: HTMLCanvasElement, choose: (node: number | null, isToPin: boolean) => void): void {
    const down = { x: 0, y: 0 };
    canvas.addEventListener("pointerdown", ({ offsetX, offsetY }) => Object.assign(down, { x: offsetX, y: offsetY }));
    canvas.addEventListener("click", ({ offsetX, offsetY, shiftKey }) => {
      if (Math.hypot(offsetX - down.x, offsetY - down.y) <= 4) choose(this.nodeAt(offsetX, offsetY), shiftKey);
    });
    canvas.addEventListener("pointermove", ({ offsetX, offsetY }) => {
      canvas.style.cursor = this.nodeAt(offsetX, offsetY) === null ? "" : "pointer";
    });
  }

  /** Return the node at a place of the canvas, or null. */
  private nodeAt(x: number, y: number): number | null {
    let nearest: number | null = null;
    let best = NEAR_PX;
    for (const [node, place] of this.places) {
      const distance = Math.hypot(place.x - x, place.y - y);
      if (distance < best) [nearest, best] = [node, distance];
    }
    return nearest;
  }

  private project(positions: Float64Array, width: number, height: number): void {
    this.places.clear();
    for (const node of this.replay.nodes.keys()) {
      const place = this.scene.place(positions[node * 3], positions[node * 3 + 1], positions[node * 3 + 2]);
      const { x, y, z } = place.project(this.scene.camera.camera);
      if (Math.abs(x) <= 1 && Math.abs(y) <= 1 && Math.abs(z) <= 1)
        this.places.set(node, { x: ((x + 1) / 2) * width, y: ((1 - y) / 2) * height, depth: z });
    }
  }

  /** To the right of their nodes, or to the left if the picture ends there. Near nodes first; a name that would lie on another one is left out, but for that of the chosen node. */
  private drawLabels(
    context: CanvasRenderingContext2D,
    width: number,
    timeNs: number,
    chosen: number | null,
    hidden: Set<number>,
  ): void {
    const [ink, scene] = [context.fillStyle, context.strokeStyle];
    const named = [...this.places].filter(([node]) => node === chosen || !hidden.has(node));
    const nodes = named.sort((a, b) => a[1].depth - b[1].depth);
    nodes.sort((a, b) => Number(b[0] === chosen) - Number(a[0] === chosen));
    const taken: [number, number, number, number][] = nodes.map(([, { x, y }]) => [x - 5, y - 5, x + 5, y + 5]);
    for (const [node, { x, y }] of nodes) {
      const name = this.replay.nameOf(node);
      const wide = this.widthOf(context, name);
      const gap = this.replay.heading(node, timeNs).some(Boolean) ? 15 : 10; // the mark of one that moves has a point
      const [left, middle] = [x + gap + 4 + wide <= width ? x + gap : x - gap - wide, y];
      const box: [number, number, number, number] = [left - 3, middle - 8, left + wide + 3, middle + 8];
      const overlaps = taken.some((o) => o[0] < box[2] && box[0] < o[2] && o[1] < box[3] && box[1] < o[3]);
      if (overlaps && node !== chosen) continue;
      taken.push(box);
      // Lines go on behind names, not through them.
      context.fillStyle = scene;
      context.globalAlpha = 0.8;
      context.beginPath();
      context.roundRect(box[0], box[1], wide + 6, 16, 4);
      context.fill();
      context.fillStyle = ink;
      context.globalAlpha = 1;
      context.fillText(name, left, middle);
    }
  }

  private widthOf(context: CanvasRenderingContext2D, name: string): number {
    let width = this.widths.get(name);
    if (width === undefined) this.widths.set(name, (width = context.measureText(name).width));
    return width;
  }

  /** A bar of 1, 2 or 5 times a power of ten meters, as it looks in the middle of the picture. */
  private drawScale(context: CanvasRenderingContext2D, height: number): void {
    const perMeter = this.scene.camera.pixelsPerMeter(this.scene.camera.target);
    const most = 140 / perMeter;
    const power = 10 ** Math.floor(Math.log10(most));
    const length = [5, 2, 1].map((step) => step * power).find((step) => step <= most) ?? power;
    const [x, y, wide] = [16, height - 18, length * perMeter];
    const text = length < 1 ? `${length} m` : distanceText(length).replace(".0", "");
    const scene = styleColor("--scene");
    for (const [style, lineWidth] of [[scene, 4.5], [inkOn(scene), 1.5]] as const) {
      context.strokeStyle = style;
      context.lineWidth = lineWidth;
      context.beginPath();
      context.moveTo(x, y - 5);
      context.lineTo(x, y);
      context.lineTo(x + wide, y);
      context.lineTo(x + wide, y - 5);
      context.stroke();
    }
    context.strokeStyle = scene;
    context.lineWidth = 3;
    context.strokeText(text, x + 6, y - 10);
    context.fillText(text, x + 6, y - 10);
  }
}
