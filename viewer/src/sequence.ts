// The sequence chart: time across, a lane for each of some nodes. A frame is a bar on the lane of its sender, with an
// arrow to each reception. A reception is a bar below the lane of its receiver. A cross ends the arrow of a loss.

import { Picture } from "./air";
import { inkOn, isDark, outcomeColor, outcomeDash, styleColor } from "./colors";
import { Actions } from "./controls";
import { button, durationText, make, timeText } from "./dom";
import { Table } from "./format";
import { causeText, messageOf, outcomeWords, routeText, senderOf } from "./frame_text";
import { endOf, framesOf, lanesOf, MOST_FRAMES, overlap } from "./lanes";
import { Chunk, Frame, isSameFrame, Replay, startOf } from "./replay";
import { setText } from "./rows";
import { Store } from "./state";
import { countUntil } from "./tables";

const AXIS_PX = 20;
const LANE_PX = 36;
/** Of the line of a lane, from its top. */
const LINE_PX = 18;
const BAR_PX = 13;
const STRIP_PX = 4;
const STRIPS = 3;
const LETTER_PX = 6.6;

const SHORTEST_NS = 1e3;
const LONGEST_NS = 60e9;
const MOST_ARROWS = 500;
const MOST_MARKS = 300;

/** Of the bar of the chosen frame, unless the wheel was turned. */
const CHOSEN_PX = 100;
/** For prototype mode, whose frames take no time. */
const SHORT_FRAME_NS = 1e6;
const SHOWN_CHARACTERS = 60;

type Attributes = Record<string, string | number>;

export class Sequence {
  readonly element = make("section", { class: "sequence", "aria-label": "Sequence chart", hidden: "" });
  private readonly picture = svg("svg", { role: "img" });
  private readonly plot = svg("svg", { y: 0 });
  private readonly now = svg("line", { class: "now", y1: AXIS_PX - 5 });
  private readonly note = make("p", { class: "message" });
  private fromNs = NaN;
  private spanNs = NaN;
  private isZoomed = false;
  private lanes: readonly number[] = [];
  private frames: readonly Frame[] = [];
  private drawn: unknown[] = [];
  private lastNs = NaN;
  private lastFrame: Frame | null = null;
  private readonly events = new Map<Chunk, Table>();

  constructor(
    private readonly replay: Replay,
    private readonly store: Store,
    private readonly page: Actions,
    private readonly choose: (frame: Frame) => void,
  ) {
    const zoom = (factor: number) => (): void => this.zoom(factor, this.gutter + this.width * 0.5);
    this.element.append(
      make(
        "div",
        { class: "row" },
        make("h2", {}, "Sequence"),
        this.note,
        make(
          "span",
          { class: "end" },
          button("+", "Shorter time", zoom(0.5)),
          button("−", "Longer time", zoom(2)),
          button("Reset", "Show the chosen frame, or the clock (double click)", () => this.reset()),
          button("✕", "Close (s)", () => store.set({ sequence: false })),
        ),
      ),
      make("div", { class: "lanes" }),
    );
    this.element.lastElementChild?.append(this.picture);
    new ResizeObserver(() => page.redraw()).observe(this.element);
    this.listen();
  }

  draw(picture: Picture): void {
    const { state, filter, interferers } = picture;
    this.element.hidden = !state.sequence;
    if (this.element.hidden || this.picture.clientWidth === 0) return;
    this.moveWindow(picture);
    const { fromNs, spanNs, width, replay } = this;
    const frames = framesOf(replay, fromNs, fromNs + spanNs, picture, () => this.page.redraw());
    if (frames !== null) {
      const { node, frame, pinned } = state;
      const chunks = replay.chunks.length;
      const shown: unknown[] = [fromNs, spanNs, width, node, frame, pinned, filter, interferers, chunks, this.events.size];
      shown.push(isDark.matches, frames.length);
      if (shown.some((value, index) => value !== this.drawn[index])) {
        if ([3, 4, 5].some((index) => shown[index] !== this.drawn[index])) this.lanes = [];
        this.drawn = shown;
        this.frames = frames;
        const { lanes, areAll } = lanesOf(replay, frames, picture, this.lanes);
        this.lanes = lanes;
        const notes = areAll ? [] : ["Not all nodes fit: pin the ones you need (k)."];
        if (!frames.length) notes.push("No frame at this time.");
        if (frames.length >= MOST_FRAMES) notes.push(`The last ${MOST_FRAMES} frames of this time.`);
        setText(this.note, notes.join(" "));
        this.drawAll(picture);
      }
    }
    const x = this.x(picture.timeNs);
    for (const name of ["x1", "x2"]) this.now.setAttribute(name, String(x));
  }

  private get gutter(): number {
    const longest = Math.max(0, ...this.lanes.map((node) => this.replay.nameOf(node).length));
    return Math.round(Math.min(this.picture.clientWidth * 0.3, 24 + Math.max(13, longest) * LETTER_PX));
  }

  private get width(): number {
    return Math.max(50, this.picture.clientWidth - this.gutter);
  }

  private x(timeNs: number): number {
    return ((timeNs - this.fromNs) / this.spanNs) * this.width;
  }

  private timeAt(x: number): number {
    return this.fromNs + ((x - this.gutter) / this.width) * this.spanNs;
  }

  /** Keep the clock and a frame that was just chosen in view. */
  private moveWindow({ timeNs, speed, state: { frame } }: Picture): void {
    const isNew = !isSameFrame(frame, this.lastFrame);
    const { fromNs, spanNs } = this;
    const has = (atNs: number): boolean => atNs >= fromNs && atNs <= fromNs + spanNs;
    if (frame !== null && isNew) {
      const [start, end] = [startOf(frame), endOf(frame)];
      const longNs = end - start || SHORT_FRAME_NS;
      const share = longNs / spanNs;
      if (!this.isZoomed && !(share > 0.03 && share < 0.7)) this.spanNs = (longNs * this.width) / CHOSEN_PX;
      if (!(has(start) && has(end)) || this.spanNs !== spanNs) this.fromNs = start - this.spanNs / 3;
    } else if (timeNs !== this.lastNs && !has(timeNs)) {
      if (!this.isZoomed && frame === null) this.spanNs = 2e9 * speed;
      this.spanNs = Math.min(this.spanNs, LONGEST_NS);
      this.fromNs = timeNs - this.spanNs / 4;
    }
    [this.lastNs, this.lastFrame] = [timeNs, frame];
  }

  private reset(): void {
    [this.isZoomed, this.lastFrame, this.lastNs, this.fromNs, this.spanNs] = [false, null, NaN, NaN, NaN];
    this.page.redraw();
  }

  private zoom(factor: number, x: number): void {
    const at = this.timeAt(x);
    const spanNs = Math.min(LONGEST_NS, Math.max(SHORTEST_NS, this.spanNs * factor));
    this.fromNs = at - ((at - this.fromNs) * spanNs) / this.spanNs;
    [this.spanNs, this.isZoomed] = [spanNs, true];
    this.page.redraw();
  }

  private listen(): void {
    const { picture } = this;
    let down: { x: number; fromNs: number } | null = null;
    let isDragged = false;
    picture.addEventListener("pointerdown", ({ clientX, button: pressed }) => {
      isDragged = false;
      if (pressed === 0) down = { x: clientX, fromNs: this.fromNs };
    });
    picture.addEventListener("pointermove", ({ clientX, buttons, pointerId }) => {
      if (down === null || !(buttons & 1)) return;
      if (!isDragged && Math.abs(clientX - down.x) < 4) return;
      isDragged = true;
      picture.setPointerCapture(pointerId);
      this.fromNs = down.fromNs - ((clientX - down.x) / this.width) * this.spanNs;
      this.page.redraw();
    });
    picture.addEventListener("click", (event) => {
      down = null;
      if (isDragged) return;
      const { frame, node } = (event.target as Element).closest<SVGElement>("[data-frame], [data-node]")?.dataset ?? {};
      const x = event.clientX - picture.getBoundingClientRect().left;
      if (frame !== undefined) this.choose(this.frames[Number(frame)]);
      else if (node !== undefined) this.store.set({ node: Number(node) });
      else if (x > this.gutter) this.page.seek(this.timeAt(x));
    });
    picture.addEventListener("dblclick", () => this.reset());
    picture.addEventListener(
      "wheel",
      (event) => {
        const x = event.clientX - picture.getBoundingClientRect().left;
        if (x < this.gutter) return;
        event.preventDefault();
        if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) {
          this.fromNs += (Math.sign(event.deltaX || event.deltaY) * this.spanNs) / 10;
          this.page.redraw();
        } else this.zoom(Math.exp(Math.sign(event.deltaY) * 0.25), x);
      },
      { passive: false },
    );
  }

  private drawAll(picture: Picture): void {
    const { gutter, width, lanes, plot } = this;
    const height = AXIS_PX + lanes.length * LANE_PX;
    this.picture.setAttribute("height", String(height));
    this.picture.setAttribute("aria-label", `Frames of ${lanes.length} nodes`);
    for (const [name, value] of Object.entries({ x: gutter, width, height })) plot.setAttribute(name, String(value));
    this.now.setAttribute("y2", String(height));
    plot.replaceChildren(...this.axis(picture, height));
    const names = lanes.map((node, lane) => {
      plot.append(svg("line", { class: "lane", x1: 0, x2: width, y1: this.y(lane), y2: this.y(lane) }));
      const isChosen = node === picture.state.node || picture.state.pinned.includes(node);
      const text = shortName(this.replay.nameOf(node), Math.floor((gutter - 12) / LETTER_PX));
      const name = svg("text", { class: isChosen ? "name chosen" : "name", "data-node": node, x: 2, y: this.y(lane) + 4 });
      name.append(text, titled(`${this.replay.nameOf(node)}: choose it`));
      return name;
    });
    this.drawEvents();
    this.drawFrames(picture);
    plot.append(this.now);
    const base = svg("text", { class: "axis", x: 2, y: 13 });
    base.append(`${timeText(this.baseNs(picture))} s`);
    this.picture.replaceChildren(base, ...names, plot);
  }

  private y(lane: number): number {
    return AXIS_PX + lane * LANE_PX + LINE_PX;
  }

  /** Times are written from here on. */
  private baseNs({ state, timeNs }: Picture): number {
    return state.frame === null ? timeNs : startOf(state.frame);
  }

  private axis(picture: Picture, height: number): SVGElement[] {
    const base = this.baseNs(picture);
    const least = (this.spanNs * 64) / this.width;
    const power = 10 ** Math.floor(Math.log10(least));
    const step = [1, 2, 5, 10].map((one) => one * power).find((one) => one >= least) ?? least;
    const marks: SVGElement[] = [];
    for (let mark = Math.ceil((this.fromNs - base) / step); mark * step + base < this.fromNs + this.spanNs; mark += 1) {
      const x = this.x(base + mark * step);
      const text = svg("text", { class: "axis", x, y: 13, "text-anchor": "middle" });
      text.append(mark === 0 ? "0" : (mark > 0 ? "+" : "−") + durationText(Math.abs(mark) * step).replace(/(\.\d*?)0+ /, "$1 ").replace(". ", " "));
      marks.push(svg("line", { class: "grid", x1: x, x2: x, y1: AXIS_PX - 3, y2: height }));
      if (x > 24 && x < this.width - 24) marks.push(text);
    }
    return marks;
  }

  /** Timers as triangles, commands and log lines as dots. */
  private drawEvents(): void {
    let left = MOST_MARKS;
    const toNs = this.fromNs + this.spanNs;
    const { run } = this.replay;
    for (const { chunk, table } of this.tablesOfEvents(toNs)) {
      const last = new Map<string, number>();
      for (let row = countUntil(table.time_ns, this.fromNs); row < table.node.length && left > 0; row += 1) {
        const timeNs = table.time_ns[row];
        if (timeNs > toNs) break;
        const lane = this.lanes.indexOf(table.node[row]);
        const kind = run.event_kinds[table.kind[row]];
        const [x, key] = [this.x(timeNs), `${lane} ${kind === "timer"}`];
        if (lane < 0 || x - (last.get(key) ?? -9) < 2) continue;
        last.set(key, x);
        left -= 1;
        const y = this.y(lane);
        const shape = kind === "timer" ? `M${x - 4} ${y - 18}h8l-4 5z` : `M${x - 3} ${y - 16}a3 3 0 1 0 6 0a3 3 0 1 0 -6 0z`;
        const mark = svg("path", { class: "event", "data-kind": kind, d: shape });
        mark.append(titled(`${kind} ${chunk.strings[table.text[row]]}, ${timeText(timeNs, 9)} s`));
        this.plot.append(mark);
      }
    }
  }

  /** Those that are read; the others come with the next picture. */
  private *tablesOfEvents(toNs: number): Generator<{ chunk: Chunk; table: Table }> {
    for (const chunk of this.replay.chunksBefore(Math.min(toNs, this.replay.endNs))) {
      const table = this.events.get(chunk);
      if (table) yield { chunk, table };
      else
        void chunk.table("events").then((read) => {
          if (this.events.size > 20) this.events.clear();
          this.events.set(chunk, read);
          this.page.redraw();
        });
      if (chunk.stored.header.start_ns < this.fromNs) break;
    }
  }

  private drawFrames(picture: Picture): void {
    const { replay, lanes, frames } = this;
    const { state, filter, interferers } = picture;
    const laneOf = new Map(lanes.map((node, lane) => [node, lane]));
    const ends = lanes.map(() => Array<number>(STRIPS).fill(-Infinity)); // of the bars below each lane
    const arrows = frames.reduce((sum, frame) => sum + frame.chunk.frames.table.receptions[frame.row], 0);
    const layer = { strips: svg("g", {}), arrows: svg("g", {}), bars: svg("g", {}) };
    if (state.frame) layer.arrows.setAttribute("class", "with-chosen");
    const where = new Map<number, [x: number, y: number]>(); // receptions of the chosen frame
    const onAir = new Map<number, number>(); // senders during the chosen frame
    let chosen: SVGElement | null = null;
    for (const [number, frame] of frames.entries()) {
      const sender = senderOf(frame);
      const from = laneOf.get(sender);
      const isChosen = isSameFrame(frame, state.frame);
      const [x0, x1] = [this.x(startOf(frame)), this.x(endOf(frame))];
      const wide = Math.max(2, x1 - x0);
      const all: Attributes = { "data-frame": number, class: isChosen ? "frame chosen" : "frame" };
      const [strips, lines, bar] = [svg("g", all), svg("g", all), svg("g", all)];
      for (const reception of frame.chunk.frames.receptions(frame.row)) {
        const lane = laneOf.get(reception.receiver);
        if (lane === undefined || !filter.shows(reception, sender)) continue;
        const outcome = replay.run.outcomes[reception.outcome];
        const isLost = replay.isLost[reception.outcome];
        const slot = Math.max(0, ends[lane].findIndex((end) => end <= x0));
        ends[lane][slot] = Math.max(ends[lane][slot], x0 + wide);
        const y = this.y(lane) + 2 + slot * (STRIP_PX + 1);
        const color = outcomeColor(outcome);
        const strip = svg("rect", { class: "reception", x: x0, y, width: wide, height: STRIP_PX, fill: color });
        strip.append(titled(`${this.wordsOf(frame)}\n${replay.nameOf(reception.receiver)}: ${outcomeWords(outcome)}`));
        strips.append(strip);
        if (isChosen) where.set(reception.receiver, [x0 + wide, y]);
        const isNear = isChosen || reception.receiver === state.node || sender === state.node;
        if (from === undefined || (arrows > MOST_ARROWS && !isNear)) continue;
        const end: Point = [x0 + wide, lane > from ? this.y(lane) : y + STRIP_PX];
        lines.append(...arrow([x0, this.y(from)], end, color, isLost ? outcomeDash(outcome) : 0, isLost));
      }
      if (from !== undefined) bar.append(...this.wait(frame, x0, this.y(from)), ...this.bar(frame, x0, wide, this.y(from)));
      if (overlap(frame, state.frame)) onAir.set(sender, x0);
      layer.strips.append(strips);
      if (isChosen) chosen = lines;
      else layer.arrows.append(lines);
      layer.bars.append(bar);
    }
    if (chosen) layer.arrows.append(chosen);
    for (const { node, receiver } of interferers) {
      const [start, end, lane] = [onAir.get(node), where.get(receiver), laneOf.get(node)];
      if (start === undefined || end === undefined || lane === undefined) continue;
      const line = svg("line", { class: "interferer", x1: start, y1: this.y(lane), x2: end[0], y2: end[1] });
      line.append(titled(`${replay.nameOf(node)} interfered at ${replay.nameOf(receiver)}`));
      layer.arrows.append(line);
    }
    this.plot.append(layer.strips, layer.arrows, layer.bars);
  }

  /** A line since the timer that sent a frame has fired: until then it was in the queue or in backoff. */
  private wait(frame: Frame, x: number, y: number): SVGElement[] {
    const { chunk, row } = frame;
    const table = this.events.get(chunk);
    const cause = causeText(this.replay, frame);
    if (!table || !cause.startsWith("timer ")) return [];
    const start = startOf(frame);
    let event = countUntil(table.time_ns, start) - 1;
    const isIt = (): boolean =>
      table.node[event] === senderOf(frame) && `timer ${chunk.strings[table.text[event]]}` === cause;
    while (event >= 0 && !isIt()) event -= 1;
    const waited = start - table.time_ns[event];
    if (event < 0 || chunk.frames.table.retry[row] || waited === 0) return [];
    const line = svg("line", { class: "wait", x1: this.x(start - waited), x2: x, y1: y - 4, y2: y - 4 });
    line.append(titled(`${cause} last fired ${durationText(waited)} before`));
    return [line];
  }

  private bar(frame: Frame, x: number, wide: number, y: number): SVGElement[] {
    const color = styleColor("--curve");
    const rect = svg("rect", { class: "sent", x, y: y - BAR_PX, width: wide, height: BAR_PX, fill: color });
    rect.append(titled(this.wordsOf(frame)));
    const letters = Math.floor((Math.min(this.width, x + wide) - Math.max(0, x) - 6) / LETTER_PX);
    if (letters < 3) return [rect];
    const text = svg("text", { class: "what", x: Math.max(0, x) + 3, y: y - 3, fill: inkOn(color) });
    const words = causeText(this.replay, frame);
    text.append(words.length > letters ? `${words.slice(0, letters - 1)}…` : words);
    return [rect, text];
  }

  private wordsOf(frame: Frame): string {
    const message = messageOf(frame)?.text.slice(0, SHOWN_CHARACTERS);
    const what = [causeText(this.replay, frame), message].filter(Boolean).join(": ");
    const lasts = durationText(endOf(frame) - startOf(frame));
    return `${routeText(this.replay, frame)}, ${what}\n${timeText(startOf(frame), 9)} s for ${lasts}`;
  }
}

type Point = readonly [x: number, y: number];

/** A line that ends in an arrowhead, or in a cross. */
function arrow([x0, y0]: Point, [x1, y1]: Point, color: string, dash: number, isLost: boolean): SVGElement[] {
  const line = svg("line", { class: "arrow", x1: x0, y1: y0, x2: x1, y2: y1, stroke: color });
  if (dash) line.setAttribute("stroke-dasharray", `${dash} ${dash * 0.7}`);
  const length = Math.hypot(x1 - x0, y1 - y0) || 1;
  const [dx, dy] = [(x1 - x0) / length, (y1 - y0) / length];
  const head = isLost
    ? `M${x1 - 3} ${y1 - 3}l6 6m0 -6l-6 6`
    : `M${x1} ${y1}L${x1 - 6 * dx - 3 * dy} ${y1 - 6 * dy + 3 * dx}L${x1 - 6 * dx + 3 * dy} ${y1 - 6 * dy - 3 * dx}z`;
  return [line, svg("path", { class: isLost ? "cross" : "head", d: head, stroke: color, fill: isLost ? "none" : color })];
}

/** A name of at most this length: what differs is mostly at its end. */
function shortName(name: string, letters: number): string {
  return name.length <= letters ? name : `${name.slice(0, letters - 5)}…${name.slice(-4)}`;
}

function titled(text: string): SVGElement {
  const title = svg("title", {});
  title.append(text);
  return title;
}

function svg<K extends keyof SVGElementTagNameMap>(tag: K, attributes: Attributes): SVGElementTagNameMap[K] {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  return element;
}
