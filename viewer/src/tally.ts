// How many frames there were until a time, and what became of them at each node.

import { BROADCAST, Header } from "./format";
import { Frames } from "./receptions";

export class Tally {
  frames = 0;

  /** Of receptions that were noticed: outcome o at node n is at n * outcomes + o. */
  readonly counts: Float64Array;

  /** How many receptions were not noticed, because they were too weak. */
  private unnoticed = 0;

  /** How many frames have an outcome at node n: `sent` + `more[n]`. */
  private sent = 0;
  private readonly more: Float64Array;

  /** Whether it is known at which nodes frames have outcomes: not with several channels or interfaces. */
  private isEachKnown = true;

  /** `isWhole`: whether all receptions of the run are recorded. */
  constructor(
    private readonly nodes: number,
    private readonly nodeCount: number,
    private readonly outcomes: number,
    private readonly unnoticedOutcome: number,
    private readonly isWhole: boolean,
  ) {
    this.counts = new Float64Array(nodeCount * outcomes);
    this.more = new Float64Array(nodeCount);
  }

  copy(): Tally {
    const copy = new Tally(this.nodes, this.nodeCount, this.outcomes, this.unnoticedOutcome, this.isWhole);
    const { frames, unnoticed, sent, isEachKnown } = this;
    Object.assign(copy, { frames, unnoticed, sent, isEachKnown });
    copy.counts.set(this.counts);
    copy.more.set(this.more);
    return copy;
  }

  /** Add a chunk from its header alone. Only the last chunk has frames in the air at the end. */
  addChunk({ outcomes, sent }: Header): void {
    outcomes.node.forEach((node, row) => {
      this.counts[node * this.outcomes + outcomes.outcome[row]] += outcomes.count[row];
    });
    sent.node.forEach((node, row) => {
      this.frames += sent.frames[row];
      this.unnoticed += sent.unnoticed[row];
      this.addSent(node, sent.destination[row], sent.frames[row], sent.receptions[row]);
    });
  }

  /** Add the first rows of a chunk. */
  addFrames(frames: Frames, rows: number): void {
    const { node, destination, receptions, unnoticed } = frames.table;
    frames.addOutcomes(rows, this.counts, this.outcomes);
    this.frames += rows;
    for (let row = 0; row < rows; row += 1) {
      this.unnoticed += unnoticed[row];
      if (frames.known[row] === receptions[row])
        this.addSent(node[row], destination[row], 1, receptions[row] + unnoticed[row]);
      else if (this.isWhole) for (const { receiver } of frames.receptions(row)) this.more[receiver] += 1;
    }
  }

  /** Return how many receptions have each outcome, of all or of a node; those not noticed if that can be told. */
  sums(node: number | null): number[] {
    const sums = new Array<number>(this.outcomes).fill(0);
    const first = (node ?? 0) * this.outcomes;
    const counts = node === null ? this.counts : this.counts.subarray(first, first + this.outcomes);
    for (const [index, count] of counts.entries()) sums[index % this.outcomes] += count;
    const unnoticed = this.unnoticedAt(node);
    if (unnoticed !== null && this.unnoticedOutcome >= 0) sums[this.unnoticedOutcome] = unnoticed;
    return sums;
  }

  /** Return how many receptions were not noticed, of all or of a node; null if that cannot be told. */
  unnoticedAt(node: number | null): number | null {
    if (!this.isWhole) return null;
    if (node === null) return this.unnoticed;
    if (!this.isEachKnown) return null;
    const first = node * this.outcomes;
    const counts = this.counts.subarray(first, first + this.outcomes);
    const noticed = counts.reduce((sum, count, outcome) => sum + (outcome === this.unnoticedOutcome ? 0 : count), 0);
    return this.sent + this.more[node] - noticed;
  }

  private addSent(node: number, destination: number, frames: number, receptions: number): void {
    if (receptions === frames * (this.nodes - 1)) {
      this.sent += frames;
      this.more[node] -= frames;
    } else if (destination !== BROADCAST && receptions === frames) this.more[destination] += frames;
    else this.isEachKnown = false;
  }
}
