// Frames on the air: a ring that grows around the sender, a line to each receiver, dashed if it was lost.

import { Vector3 } from "three";
import { outcomeColor, outcomeDash, rgb, styleColor } from "./colors";
import { Filter } from "./filter";
import { senderOf } from "./frame_text";
import { Instances } from "./instances";
import { Look } from "./look";
import { Reception } from "./receptions";
import { Frame, isSameFrame, Replay, startOf } from "./replay";
import * as shapes from "./shapes";
import { State } from "./state";

const MOST_FRAMES = 400;
const MOST_LINES = 9000;

/** Of one sender at once. */
const MOST_RINGS = 3;

/** How long a frame stays visible, in seconds of the wall clock. */
const SHOWN_S = 0.6;

export interface Interferer {
  node: number;
  receiver: number;
}

export interface Picture {
  timeNs: number;
  /** Simulated seconds for a second of the wall clock. */
  speed: number;
  positions: Float64Array;
  state: Readonly<State>;
  look: Look;
  filter: Filter;
  /** Those that caused the losses of the chosen frame. */
  interferers: readonly Interferer[];
}

type Color = [number, number, number];

interface FrameShape {
  sender: number;
  from: Vector3;
  receptions: { reception: Reception; to: Vector3 }[];
  /** How far the ring grows. */
  radius: number;
}

export class Air {
  private readonly delivered = shapes.lines(3);
  private readonly rings = shapes.rings(4);
  private readonly lost = shapes.lines(5);
  private readonly dashes: number[];
  private colors: Color[] = [];
  private shown = new Map<number, FrameShape>(); // in the last picture
  private drawn = new Map<number, FrameShape>(); // in this picture

  constructor(
    private readonly replay: Replay,
    private readonly place: (x: number, y: number, z: number) => Vector3,
  ) {
    this.dashes = replay.run.outcomes.map(outcomeDash);
  }

  get shapes(): Instances[] {
    return [this.delivered, this.rings, this.lost];
  }

  draw(picture: Picture): void {
    const { timeNs, speed, state, filter } = picture;
    this.colors = this.replay.run.outcomes.map((name) => rgb(outcomeColor(name)));
    for (const shape of this.shapes) shape.clear();
    const longestNs = Math.max(SHOWN_S * speed * 1e9, 0);
    const found = this.replay.framesBetween(timeNs - Math.max(longestNs, 5e7), timeNs, MOST_FRAMES * 2);
    let frames = found.filter((frame) => {
      const { duration_ns } = frame.chunk.frames.table;
      const shown = Math.max(longestNs, duration_ns[frame.row]);
      return timeNs - startOf(frame) <= shown && filter.passes(frame.chunk, frame.row);
    });
    frames = frames.slice(0, MOST_FRAMES).filter((frame) => !isSameFrame(frame, state.frame));
    const lines = frames.reduce((sum, { chunk, row }) => sum + chunk.frames.table.receptions[row], 0);
    const crowd = Math.min(1, Math.sqrt(60 / Math.max(1, lines)));
    // The first frame of a sender in each of these intervals has a ring, so that rings stay while they grow.
    const interval = longestNs / MOST_RINGS;
    const ringed = new Map(frames.map((frame) => [`${senderOf(frame)} ${Math.floor(startOf(frame) / interval)}`, frame]));
    const withRing = new Set(ringed.values());
    let left = MOST_LINES;
    for (const frame of frames) {
      const { duration_ns } = frame.chunk.frames.table;
      const age = Math.min(1, (timeNs - startOf(frame)) / Math.max(longestNs, duration_ns[frame.row]));
      if (withRing.has(frame)) this.drawRing(picture, frame, age, crowd);
      left -= this.drawFrame(picture, frame, age, crowd, left);
    }
    if (state.frame !== null) this.drawChosenFrame(picture, state.frame);
    for (const shape of this.shapes) shape.show();
    [this.shown, this.drawn] = [this.drawn, new Map()];
  }

  /** Draw a frame of an age from 0 to 1; return how many lines that took. */
  private drawFrame(picture: Picture, frame: Frame, age: number, crowd: number, most: number): number {
    const { state, filter } = picture;
    const { sender, from, receptions } = this.shapeOf(frame);
    let lines = 0;
    for (const { reception, to } of receptions) {
      const { receiver, outcome } = reception;
      if (lines === most) break;
      if (!filter.shows(reception, sender)) continue;
      lines += 1;
      const isOther = state.node !== null && receiver !== state.node && sender !== state.node;
      const alpha = (1 - age * age) * (isOther ? 0.12 : 1);
      const color = this.colors[outcome];
      if (this.replay.isLost[outcome]) this.addLine(this.lost, from, to, color, alpha, 2.2, this.dashes[outcome]);
      else {
        const calm = alpha * 0.75 * (state.node !== null && !isOther ? 1 : crowd);
        this.addLine(this.delivered, from, to, color, calm, 1.2, 0);
      }
    }
    return lines;
  }

  private drawRing({ state }: Picture, frame: Frame, age: number, crowd: number): void {
    const { sender, from, radius } = this.shapeOf(frame);
    const isOther = state.node !== null && sender !== state.node;
    const strength = (1 - age) * (isOther ? 0.25 : 0.9) * Math.max(0.35, crowd);
    this.rings.add(from.x, from.y, from.z, Math.max(age * radius, 0.01), ...this.colors[0], strength, 1.5);
  }

  private drawChosenFrame(picture: Picture, frame: Frame): void {
    const { from, receptions, radius } = this.shapeOf(frame);
    for (const { reception, to } of receptions) {
      const color = this.colors[reception.outcome];
      if (this.replay.isLost[reception.outcome]) this.addLine(this.lost, from, to, color, 1, 3, this.dashes[reception.outcome] * 1.3);
      else this.addLine(this.delivered, from, to, color, 1, 2, 0);
    }
    const ink = rgb(styleColor("--ink"));
    for (const { node, receiver } of picture.interferers)
      this.addLine(this.lost, this.placeAt(node, frame), this.placeAt(receiver, frame), ink, 0.8, 1.5, 3);
    this.rings.add(from.x, from.y, from.z, radius, ...this.colors[0], 0.9, 2);
  }

  private addLine(
    lines: Instances,
    from: Vector3,
    to: Vector3,
    color: Color,
    alpha: number,
    width: number,
    dash: number,
  ): void {
    lines.add(from.x, from.y, from.z, to.x, to.y, to.z, ...color, alpha, alpha, width, dash);
  }

  /** Where a frame and its receptions are: kept as long as the frame is drawn. */
  private shapeOf(frame: Frame): FrameShape {
    const key = frame.chunk.index * 2 ** 32 + frame.row;
    let shape = this.shown.get(key);
    if (!shape) {
      const sender = senderOf(frame);
      const from = this.placeAt(sender, frame);
      const receptions = frame.chunk.frames
        .receptions(frame.row)
        .map((reception) => ({ reception, to: this.placeAt(reception.receiver, frame) }));
      const reach = receptions.reduce((most, { to }) => Math.max(most, from.distanceTo(to)), 0);
      shape = { sender, from, receptions, radius: this.replay.nodes.get(sender)?.range_m ?? (reach || 50) };
    }
    this.drawn.set(key, shape);
    return shape;
  }

  private placeAt(node: number, frame: Frame): Vector3 {
    const [x, y, z] = this.replay.position(node, frame);
    return this.place(x, y, z);
  }
}
