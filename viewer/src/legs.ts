// Where nodes are: the legs of a chunk, by node.

import { Table } from "./format";
import { firstNot, groupRows } from "./tables";

export class Legs {
  /** Rows of node n: `rows[first[n]]` to `rows[first[n + 1] - 1]`, by time. */
  private readonly first: Uint32Array;
  private readonly rows: Uint32Array;

  constructor(
    private readonly table: Table,
    nodeCount: number,
  ) {
    ({ first: this.first, rows: this.rows } = groupRows(table.node, nodeCount));
  }

  /** Put the position of a node into `into`, from `offset` on. A node without a leg is at NaN. */
  position(node: number, timeNs: number, into: Float64Array, offset = 0): void {
    const row = this.rowAt(node, timeNs);
    if (row < 0) {
      into.fill(NaN, offset, offset + 3);
      return;
    }
    const { time_ns, duration_ns, x0, y0, z0, x1, y1, z1 } = this.table;
    const since = timeNs - time_ns[row];
    const share = since >= duration_ns[row] ? 1 : Math.max(0, since / duration_ns[row]);
    into[offset] = x0[row] + share * (x1[row] - x0[row]);
    into[offset + 1] = y0[row] + share * (y1[row] - y0[row]);
    into[offset + 2] = z0[row] + share * (z1[row] - z0[row]);
  }

  /** Return in which direction a node moves: a vector of length 1, or 0 if it stands. */
  heading(node: number, timeNs: number): [number, number, number] {
    const row = this.rowAt(node, timeNs);
    const { time_ns, duration_ns, x0, y0, z0, x1, y1, z1 } = this.table;
    if (row < 0 || timeNs > time_ns[row] + duration_ns[row]) return [0, 0, 0];
    const step = [x1[row] - x0[row], y1[row] - y0[row], z1[row] - z0[row]];
    const length = Math.hypot(...step);
    return length > 1e-9 ? [step[0] / length, step[1] / length, step[2] / length] : [0, 0, 0];
  }

  /** Give the corners of the way of a node between two times, without its ends. */
  *corners(node: number, fromNs: number, toNs: number): Generator<[number, number, number, number]> {
    const { time_ns, x0, y0, z0 } = this.table;
    for (let index = this.first[node]; index < this.first[node + 1]; index += 1) {
      const row = this.rows[index];
      if (time_ns[row] > fromNs && time_ns[row] < toNs) yield [time_ns[row], x0[row], y0[row], z0[row]];
    }
  }

  /** Give the ends of all legs. */
  *ends(): Generator<[number, number, number]> {
    const { x0, y0, z0, x1, y1, z1 } = this.table;
    for (let row = 0; row < x0.length; row += 1) {
      yield [x0[row], y0[row], z0[row]];
      yield [x1[row], y1[row], z1[row]];
    }
  }

  private rowAt(node: number, timeNs: number): number {
    const first = this.first[node];
    const end = this.first[node + 1];
    if (first === end) return -1;
    const next = firstNot((index) => this.table.time_ns[this.rows[index]] <= timeNs, end, first);
    return this.rows[Math.max(first, next - 1)];
  }
}
