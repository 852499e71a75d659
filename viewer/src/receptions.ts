// The frames of a chunk and what became of them. The file has only the outcomes that differ from those of the
// last frame of the same sender and interface: each change holds from one of its frames until another one.

import { BELOW_SENSITIVITY, Table } from "./format";
import { countUntil, firstNot, groupRows } from "./tables";

export interface Reception {
  receiver: number;
  outcome: number;
}

const FOREVER = 0xffffffff;

export class Frames {
  readonly count: number;
  /** Bit o of `outcomes[row]`: whether a receiver had outcome o. */
  readonly outcomes: Uint16Array;
  /** How many receptions of a frame were lost. */
  readonly lost: Uint32Array;
  /** How many receptions of a frame that were noticed are known. */
  readonly known: Uint32Array;

  private readonly sender: Uint32Array; // of a row
  private readonly ordinal: Uint32Array; // of a row among the frames of its sender
  private readonly rows: { first: Uint32Array; rows: Uint32Array }; // by sender
  private readonly changes: { first: Uint32Array; rows: Uint32Array }; // by sender
  private readonly since: Uint32Array; // of a change: an ordinal
  private readonly until: Uint32Array;

  constructor(
    readonly table: Table,
    private readonly changed: Table,
    nodeCount: number,
    private readonly isLost: readonly boolean[],
    private readonly unnoticed: number,
  ) {
    this.count = table.node.length;
    this.outcomes = new Uint16Array(this.count);
    this.lost = new Uint32Array(this.count);
    this.known = new Uint32Array(this.count);
    this.sender = new Uint32Array(this.count);
    this.ordinal = new Uint32Array(this.count);
    this.since = new Uint32Array(changed.frame.length);
    this.until = new Uint32Array(changed.frame.length).fill(FOREVER);

    const senders = new Map<number, number>();
    for (let row = 0; row < this.count; row += 1) {
      const key = table.node[row] * 256 + table.interface[row];
      let sender = senders.get(key);
      if (sender === undefined) senders.set(key, (sender = senders.size));
      this.sender[row] = sender;
    }
    this.rows = groupRows(this.sender, senders.size);
    this.changes = groupRows(
      Uint32Array.from(changed.frame, (row) => this.sender[row]),
      senders.size,
    );
    const last = new Uint32Array(nodeCount);
    for (let sender = 0; sender < senders.size; sender += 1) this.walk(sender, last);
  }

  /** Return how many frames began until a time, this instant included. */
  rowsUntil(timeNs: number): number {
    return countUntil(this.table.time_ns, timeNs);
  }

  /** Return what became of a frame at each receiver that noticed or lost it, by receiver. */
  receptions(row: number): Reception[] {
    const found: Reception[] = [];
    const sender = this.sender[row];
    const ordinal = this.ordinal[row];
    const { first, rows } = this.changes;
    for (let index = first[sender]; index < first[sender + 1]; index += 1) {
      const change = rows[index];
      if (this.since[change] > ordinal) break;
      const outcome = this.changed.outcome[change];
      if (ordinal < this.until[change] && outcome !== BELOW_SENSITIVITY)
        found.push({ receiver: this.changed.receiver[change], outcome });
    }
    return found.sort((a, b) => a.receiver - b.receiver);
  }

  /** Add the outcomes of the first `rows` frames to `counts`: outcome o at node n is at n * outcomes + o. */
  addOutcomes(rows: number, counts: Float64Array, outcomes: number): void {
    for (let sender = 0; sender + 1 < this.changes.first.length; sender += 1) {
      const first = this.rows.first[sender];
      // Of this sender, among the first rows.
      const frames = firstNot((index) => this.rows.rows[first + index] < rows, this.rows.first[sender + 1] - first);
      for (let index = this.changes.first[sender]; index < this.changes.first[sender + 1]; index += 1) {
        const change = this.changes.rows[index];
        if (this.since[change] >= frames) break;
        const outcome = this.changed.outcome[change];
        if (outcome === BELOW_SENSITIVITY) continue;
        counts[this.changed.receiver[change] * outcomes + outcome] +=
          Math.min(this.until[change], frames) - this.since[change];
      }
    }
  }

  private isNoticed(outcome: number): boolean {
    return outcome !== BELOW_SENSITIVITY && outcome !== this.unnoticed;
  }

  /** Go through the frames of a sender and the changes between them. `last` is all 0 before and after. */
  private walk(sender: number, last: Uint32Array): void {
    const { receiver, outcome, frame } = this.changed;
    const counts = new Uint32Array(256);
    let mask = 0;
    let lost = 0;
    let known = 0;
    let index = this.changes.first[sender];
    const end = this.changes.first[sender + 1];
    for (let ordinal = 0; ordinal < this.rows.first[sender + 1] - this.rows.first[sender]; ordinal += 1) {
      const row = this.rows.rows[this.rows.first[sender] + ordinal];
      this.ordinal[row] = ordinal;
      for (; index < end && frame[this.changes.rows[index]] === row; index += 1) {
        const change = this.changes.rows[index];
        this.since[change] = ordinal;
        const before = last[receiver[change]];
        if (before !== 0) {
          this.until[before - 1] = ordinal;
          const old = outcome[before - 1];
          counts[old] -= 1;
          if (counts[old] === 0 && old < 16) mask &= ~(1 << old);
          if (this.isLost[old]) lost -= 1;
          if (this.isNoticed(old)) known -= 1;
        }
        last[receiver[change]] = change + 1;
        const now = outcome[change];
        counts[now] += 1;
        if (now < 16) mask |= 1 << now;
        if (this.isLost[now]) lost += 1;
        if (this.isNoticed(now)) known += 1;
      }
      this.outcomes[row] = mask;
      this.lost[row] = lost;
      this.known[row] = known;
    }
    for (let change = this.changes.first[sender]; change < end; change += 1)
      last[receiver[this.changes.rows[change]]] = 0;
  }
}
