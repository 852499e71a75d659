// What a run was like at a time. Chunks are decoded when they are needed; a few are kept.

import { Run, RunNode, StoredChunk, Table } from "./format";
import { Legs } from "./legs";
import { Look, plainLook } from "./look";
import { Frames } from "./receptions";
import { Source } from "./source";
import { firstNot } from "./tables";
import { Tally } from "./tally";
import { Texts } from "./texts";

/** How much is kept decoded; what was used the longest time ago goes first. */
const KEPT_CHUNKS = 6;
const KEPT_ROWS = 200_000;

/** A frame may begin so long before the chunk in which it ends. */
const LONGEST_FRAME_NS = 2e9;

const PLAIN = plainLook();

const OF_PROTOTYPE = ["delivered", "below_sensitivity", "lost"];
const NOT_LOST = ["delivered", "in_air"];

/** A decoded chunk. */
export class Chunk {
  private readonly lazy = new Map<string, Promise<Table>>();

  constructor(
    readonly index: number,
    readonly stored: StoredChunk,
    readonly frames: Frames,
    readonly legs: Legs,
    readonly texts: Texts,
  ) {}

  /** How many rows are decoded. */
  get size(): number {
    const { frames, receptions, legs } = this.stored.header.tables;
    return frames.rows + receptions.rows + legs.rows;
  }

  get strings(): string[] {
    return this.stored.header.strings;
  }

  /** A table that is not needed to draw. */
  table(name: string): Promise<Table> {
    let table = this.lazy.get(name);
    if (table === undefined) this.lazy.set(name, (table = this.stored.table(name)));
    return table;
  }
}

export interface Frame {
  chunk: Chunk;
  row: number;
}

export function isSameFrame(a: Frame | null, b: Frame | null): boolean {
  return a === b || (a !== null && b !== null && a.chunk.index === b.chunk.index && a.row === b.row);
}

export function startOf(frame: Frame): number {
  return frame.chunk.frames.table.time_ns[frame.row];
}

export class Replay {
  readonly run: Run;
  readonly nodes: ReadonlyMap<number, RunNode>;
  /** One more than the largest id. */
  readonly nodeCount: number;
  /** Whether the run has frames and events; otherwise only positions and variables. */
  readonly hasFrames: boolean;
  /** Whether all is recorded at all nodes. */
  readonly isWhole: boolean;
  /** Whether a reception with an outcome is lost, by number. Those that were not noticed only if they are recorded. */
  readonly isLost: readonly boolean[];
  /** Outcomes that a reception of this mode can have before the run ends, by number. */
  readonly possible: readonly number[];
  /** The outcome of a reception that is not noticed. */
  readonly unnoticed: number;

  /** What became of all frames of a run that has ended, if `sumAll` was called. */
  whole: Tally | null = null;

  private readonly decoded = new Map<number, Chunk>(); // the one that was used last is the last one
  private readonly loading = new Map<number, Promise<Chunk>>();
  private earlier: { chunks: number; tally: Tally };

  constructor(readonly source: Source) {
    this.run = source.run;
    this.nodes = new Map(this.run.nodes.map((node) => [node.id, node]));
    this.nodeCount = Math.max(-1, ...this.run.nodes.map((node) => node.id)) + 1;
    this.isLost = this.run.outcomes.map((name) => !NOT_LOST.includes(name));
    this.hasFrames = this.run.outcomes.length > 0;
    const { recorded, outcomes, mode } = this.run;
    this.isWhole = recorded === null || recorded.length === this.nodes.size;
    const isOfEngine = (name: string): boolean => !["lost", "in_air"].includes(name);
    const isPossible = (name: string): boolean =>
      mode === "prototype" ? OF_PROTOTYPE.includes(name) : isOfEngine(name);
    this.possible = [...outcomes.keys()].filter((outcome) => isPossible(outcomes[outcome]));
    this.unnoticed = outcomes.indexOf("below_sensitivity");
    this.earlier = { chunks: 0, tally: this.newTally() };
  }

  get chunks(): readonly StoredChunk[] {
    return this.source.chunks;
  }

  get endNs(): number {
    return this.chunks.length ? this.chunks[this.chunks.length - 1].header.end_ns : 0;
  }

  /** The end of the time axis: of a run that goes on, that of the whole run. */
  get durationNs(): number {
    return Math.max(this.endNs, this.source.end === null ? this.run.duration_s * 1e9 : 0, 1);
  }

  nameOf(node: number): string {
    return this.nodes.get(node)?.name ?? String(node);
  }

  chunkIndexAt(timeNs: number): number {
    const next = firstNot((index) => this.chunks[index].header.start_ns <= timeNs, this.chunks.length);
    return Math.max(0, next - 1);
  }

  /** Return the chunk if it is decoded. */
  chunk(index: number): Chunk | null {
    const chunk = this.decoded.get(index) ?? null;
    if (chunk !== null) {
      this.decoded.delete(index);
      this.decoded.set(index, chunk);
    }
    return chunk;
  }

  loadChunk(index: number): Promise<Chunk> {
    const chunk = this.chunk(index);
    if (chunk !== null) return Promise.resolve(chunk);
    let loading = this.loading.get(index);
    if (loading === undefined) {
      loading = this.decode(index).finally(() => this.loading.delete(index));
      this.loading.set(index, loading);
    }
    return loading;
  }

  /** Whether all that is needed to show a time is decoded. */
  isReady(timeNs: number): boolean {
    return this.neededAt(timeNs).every((index) => this.decoded.has(index));
  }

  async load(timeNs: number): Promise<void> {
    await Promise.all(this.neededAt(timeNs).map((index) => this.loadChunk(index)));
  }

  /** Give the decoded chunks from a time back, without a gap. */
  *chunksBefore(timeNs: number): Generator<Chunk> {
    for (let index = Math.max(0, ...this.neededAt(timeNs)); index >= 0; index -= 1) {
      const chunk = this.chunk(index);
      if (chunk === null) return;
      yield chunk;
    }
  }

  /** Give the decoded chunks from a time on, without a gap. */
  *chunksAfter(timeNs: number): Generator<Chunk> {
    for (let index = this.chunkIndexAt(timeNs); ; index += 1) {
      const chunk = this.chunk(index);
      if (chunk === null) return;
      yield chunk;
    }
  }

  /** Return the position of each node: x, y and z of node n are at 3 n. Needs `load`. */
  positions(timeNs: number): Float64Array {
    const positions = new Float64Array(this.nodeCount * 3);
    const chunk = this.chunk(this.chunkIndexAt(timeNs));
    for (const node of this.nodes.keys())
      if (chunk) chunk.legs.position(node, timeNs, positions, node * 3);
      else positions.fill(NaN, node * 3, node * 3 + 3);
    return positions;
  }

  /** Return in which direction a node moves: a vector of length 1, or 0 if it stands. Needs `load`. */
  heading(node: number, timeNs: number): [number, number, number] {
    return this.chunk(this.chunkIndexAt(timeNs))?.legs.heading(node, timeNs) ?? [0, 0, 0];
  }

  /** Return positions between which all nodes are during the whole run, as far as it is known: x, y, z, x, … */
  extent(): number[] {
    const boxes = this.chunks.flatMap(({ header: { extent_m: box = [] } }) => {
      const axis = (first: number): number[] => (box.length ? [box[first], box[first + 3]] : []);
      return axis(0).flatMap((x) => axis(1).flatMap((y) => axis(2).flatMap((z) => [x, y, z])));
    });
    const nodes = boxes.length ? boxes : [...(this.chunk(0)?.legs.ends() ?? [])].flat();
    return [...nodes, ...(this.run.extent_m ?? [])];
  }

  /** Return how the run wants to be drawn. */
  look(timeNs: number): Look {
    return this.chunks[this.chunkIndexAt(timeNs)]?.look ?? PLAIN;
  }

  /** Return the last chunk before a time that trails from `fromNs` on need and that is not decoded; null if none. */
  missingBefore(timeNs: number, fromNs: number): number | null {
    let rows = 0;
    const now = this.chunkIndexAt(timeNs);
    for (let index = now - 1; index >= 0 && this.chunks[index].header.end_ns > fromNs; index -= 1) {
      const chunk = this.decoded.get(index);
      if (chunk === undefined) return this.hasFrames && this.chunkIndexAt(fromNs) < now - 1 ? null : index;
      rows += chunk.size;
      if (rows > KEPT_ROWS / 2) return null;
    }
    return null;
  }

  /** Return where a node was when a frame began. */
  position(node: number, frame: Frame): Float64Array {
    const position = new Float64Array(3);
    const chunk = this.chunk(this.chunkIndexAt(startOf(frame))) ?? frame.chunk;
    chunk.legs.position(node, startOf(frame), position);
    return position;
  }

  /** Return the last frames that began after `fromNs` and until `toNs`, latest first. Needs `load`. */
  framesBetween(fromNs: number, toNs: number, most: number): Frame[] {
    const found: Frame[] = [];
    for (const chunk of this.chunksBefore(toNs)) {
      const first = chunk.frames.rowsUntil(fromNs);
      for (let row = chunk.frames.rowsUntil(toNs) - 1; row >= first && found.length < most; row -= 1)
        found.push({ chunk, row });
      if (chunk.stored.header.start_ns <= fromNs || found.length >= most) break;
    }
    return found;
  }

  /** Return what became of the frames that began until a time. Needs `load`. */
  tally(timeNs: number): Tally {
    const needed = this.neededAt(timeNs);
    this.sumEarlier(needed[0]);
    const tally = this.earlier.tally.copy();
    for (const index of needed) {
      const chunk = this.chunk(index);
      if (chunk !== null) tally.addFrames(chunk.frames, chunk.frames.rowsUntil(timeNs));
    }
    return tally;
  }

  async sumAll(): Promise<void> {
    await this.load(this.endNs);
    this.whole = this.tally(this.endNs);
  }

  /** Whether the run ended before the frame did. */
  isInAir({ chunk, row }: Frame): boolean {
    const { node, receptions } = chunk.frames.table;
    const { recorded } = this.run;
    return chunk.frames.known[row] < receptions[row] && (recorded === null || recorded.includes(node[row]));
  }

  /** Return the nearest nodes that did not notice a frame and have no loss of it, as far as that can be told. */
  unnoticedBy(frame: Frame, most: number): number[] {
    const { chunk, row } = frame;
    const { node: sender, destination, receptions, unnoticed } = chunk.frames.table;
    const all = receptions[row] + unnoticed[row];
    if (chunk.frames.known[row] !== receptions[row]) return [];
    if (all !== this.nodes.size - 1) return this.isUnnoticedAt(destination[row], frame) ? [destination[row]] : [];
    const others = new Set(chunk.frames.receptions(row).map(({ receiver }) => receiver)).add(sender[row]);
    const from = this.position(sender[row], frame);
    return [...this.nodes.keys()]
      .filter((node) => !others.has(node))
      .map((node) => ({ node, position: this.position(node, frame) }))
      .map(({ node, position }) => ({ node, meters: Math.hypot(...position.map((value, axis) => value - from[axis])) }))
      .sort((a, b) => a.meters - b.meters)
      .slice(0, most)
      .map(({ node }) => node);
  }

  /** Whether a node did not notice a frame, as far as that can be told. */
  isUnnoticedAt(node: number, { chunk, row }: Frame): boolean {
    const { frames } = chunk;
    const { node: sender, destination, receptions, unnoticed } = frames.table;
    if (node === sender[row] || frames.known[row] !== receptions[row]) return false;
    const all = receptions[row] + unnoticed[row];
    const has = all === this.nodes.size - 1 || (all === 1 && destination[row] === node);
    return has && frames.receptions(row).every((one) => one.receiver !== node || one.outcome === this.unnoticed);
  }

  /**
   * Return the next frame that passes, after (or before, by `step` -1) a frame or a time; null if there is none.
   * `mayHave` spares decoding chunks that have no such frame.
   */
  async findFrame(
    from: Frame | number,
    step: 1 | -1,
    passes: (chunk: Chunk, row: number) => boolean,
    mayHave: (chunk: StoredChunk) => boolean = () => true,
  ): Promise<Frame | null> {
    const isFrame = typeof from !== "number";
    let index = isFrame ? from.chunk.index : this.chunkIndexAt(from);
    if (!isFrame && step < 0) index = Math.max(0, ...this.neededAt(from));
    for (; index >= 0 && index < this.chunks.length; index += step) {
      if (!mayHave(this.chunks[index])) continue;
      const chunk = await this.loadChunk(index);
      let row = step > 0 ? 0 : chunk.frames.count - 1;
      if (isFrame && index === from.chunk.index) row = from.row + step;
      else if (!isFrame && step > 0) row = chunk.frames.rowsUntil(from);
      else if (!isFrame) row = chunk.frames.rowsUntil(Math.ceil(from) - 1) - 1;
      for (; row >= 0 && row < chunk.frames.count; row += step)
        if (passes(chunk, row)) return { chunk, row };
    }
    return null;
  }

  private newTally(): Tally {
    return new Tally(this.nodes.size, this.nodeCount, this.run.outcomes.length, this.unnoticed, this.isWhole);
  }

  private neededAt(timeNs: number): number[] {
    if (!this.chunks.length) return [];
    const index = this.chunkIndexAt(timeNs);
    const needed = [index];
    if (!this.hasFrames) return needed;
    for (let next = index + 1; next < this.chunks.length; next += 1) {
      if (this.chunks[next].header.start_ns > timeNs + LONGEST_FRAME_NS) break;
      needed.push(next);
    }
    return needed;
  }

  /** Sum what the headers of the first `chunks` chunks say. */
  private sumEarlier(chunks: number): void {
    if (chunks < this.earlier.chunks) this.earlier = { chunks: 0, tally: this.newTally() };
    for (; this.earlier.chunks < chunks; this.earlier.chunks += 1)
      this.earlier.tally.addChunk(this.chunks[this.earlier.chunks].header);
  }

  private async decode(index: number): Promise<Chunk> {
    const stored = this.chunks[index];
    const names = ["frames", "receptions", "legs", "texts", "text_bytes"];
    const [frames, receptions, legs, texts, bytes] = await Promise.all(names.map((name) => stored.table(name)));
    const chunk = new Chunk(
      index,
      stored,
      new Frames(frames, receptions, this.nodeCount, this.isLost, this.unnoticed),
      new Legs(legs, this.nodeCount),
      new Texts(texts, bytes),
    );
    this.decoded.set(index, chunk);
    let rows = 0;
    for (const { size } of this.decoded.values()) rows += size;
    for (const [old, { size }] of this.decoded) {
      if (this.decoded.size <= KEPT_CHUNKS || rows <= KEPT_ROWS) break;
      this.decoded.delete(old);
      rows -= size;
    }
    return chunk;
  }
}
