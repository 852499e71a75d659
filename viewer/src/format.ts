// Decodes the chunks of a replay. gradysim.replay.chunk and gradysim.replay.tables define them.

import { Look } from "./look";

export interface RunNode {
  id: number;
  name: string;
  group: string;
  protocol: string;
  range_m: number | null;
  far_loss: FarLoss | null;
}

/** Path loss beyond the range of a node: `loss_at_1m_db` plus `exponent` times 10 log10 of the meters. */
export interface FarLoss {
  sensitivity_dbm: number;
  loss_at_1m_db: number;
  exponent: number;
  /** Whether the loss of a frame may differ, by fading or antennas. */
  is_mean: boolean;
}

export interface Obstacle {
  name: string;
  points: [number, number][];
  bottom_m: number;
  top_m: number;
}

/** What is known before a run. */
export interface Run {
  format: number;
  file: string;
  config: string;
  run: number;
  mode: string;
  seed: number;
  duration_s: number;
  iterations: Record<string, string | number>;
  description: string;
  ini: string;
  recorded: number[] | null;
  nodes: RunNode[];
  obstacles: Obstacle[];
  outcomes: string[];
  kinds: string[];
  event_kinds: string[];
  /** Positions (x, y, z, x, …) that the first picture shows, besides the nodes. */
  extent_m?: number[];
}

/** How a run ended. */
export interface RunEnd {
  time_s: number;
  complete: boolean;
}

type ColumnType = "u8" | "i16" | "u32" | "u64" | "f64";

export interface Header {
  start_ns: number;
  end_ns: number;
  strings: string[];
  density: { bin_ns: number; frames: number[]; lost: number[] };
  outcomes: { node: number[]; outcome: number[]; count: number[] };
  sent: Record<"node" | "destination" | "frames" | "receptions" | "unnoticed", number[]>;
  /** Two opposite corners of the box that nodes move in: x, y, z, x, y, z. Snapshots have none. */
  extent_m?: number[];
  tables: Record<string, { rows: number }>;
}

interface PackedHeader extends Header {
  tables: Record<string, { rows: number; columns: [string, ColumnType, boolean, number][] }>;
}

/** A part of a run. */
export interface StoredChunk {
  readonly header: Header;
  /** How the run wants to be drawn during this chunk. */
  readonly look?: Look;
  table(name: string): Promise<Table>;
}

export type Values = Uint8Array | Int16Array | Uint32Array | Float64Array;
export type Table = Record<string, Values>;

export const BROADCAST = 0xffffffff;
export const BELOW_SENSITIVITY = 255;
export const NO_POWER = -32768;

const BYTES: Record<ColumnType, number> = { u8: 1, i16: 2, u32: 4, u64: 8, f64: 8 };

function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  const native = Uint8Array as unknown as { fromBase64?: (text: string) => Uint8Array<ArrayBuffer> };
  if (native.fromBase64) return native.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let offset = 0; offset < binary.length; offset += 1) bytes[offset] = binary.charCodeAt(offset);
  return bytes;
}

/** A packed chunk: its header is read at once, its columns when a table is asked for. */
export class PackedChunk implements StoredChunk {
  readonly header: PackedHeader;
  private readonly columnsStart: number;

  /** `packed` is base64, as in a file, or bytes, as from a live run. */
  constructor(private readonly packed: string | Uint8Array<ArrayBuffer>) {
    const prefix = this.bytes(0, 4);
    const length = new DataView(prefix.buffer, prefix.byteOffset).getUint32(0, true);
    this.columnsStart = 4 + length;
    this.header = JSON.parse(new TextDecoder().decode(this.bytes(4, this.columnsStart)));
    const columns = Object.values(this.header.tables).flatMap((table) => table.columns);
    const end = columns.reduce((sum, column) => sum + column[3], this.columnsStart);
    const held = typeof packed === "string" ? Math.floor(packed.length / 4) * 3 : packed.length;
    if (held < end) throw new Error(`a chunk of ${held} bytes; expected ${end}`);
  }

  async table(name: string): Promise<Table> {
    let start = this.columnsStart;
    for (const [other, { rows, columns }] of Object.entries(this.header.tables)) {
      const size = columns.reduce((sum, column) => sum + column[3], 0);
      if (other !== name) {
        start += size;
        continue;
      }
      const bytes = this.bytes(start, start + size);
      let offset = 0;
      const decoded = columns.map(async ([column, type, delta, length]) => {
        const packed = bytes.subarray(offset, (offset += length));
        const values = rows === 0 ? empty(type) : unshuffle(await inflate(packed, rows * BYTES[type]), type, rows);
        if (delta) accumulate(values);
        return [column, values] as const;
      });
      return Object.fromEntries(await Promise.all(decoded));
    }
    throw new Error(`a chunk without the table ${name}`);
  }

  private bytes(start: number, end: number): Uint8Array<ArrayBuffer> {
    if (typeof this.packed !== "string") return this.packed.subarray(start, end);
    // Four characters for three bytes.
    const first = Math.floor(start / 3);
    const decoded = fromBase64(this.packed.slice(first * 4, Math.ceil(end / 3) * 4));
    return decoded.subarray(start - first * 3, end - first * 3);
  }
}

async function inflate(packed: Uint8Array<ArrayBuffer>, size: number): Promise<Uint8Array> {
  const { readable, writable } = new DecompressionStream("deflate");
  const writer = writable.getWriter();
  // What is wrong with the bytes, the reader tells.
  writer.write(packed).catch(() => {});
  writer.close().catch(() => {});
  const reader = readable.getReader();
  const bytes = new Uint8Array(size);
  let offset = 0;
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    bytes.set(part.value, offset);
    offset += part.value.length;
  }
  return bytes;
}

function empty(type: ColumnType): Values {
  return unshuffle(new Uint8Array(0), type, 0);
}

/** Join the bytes of each number. Times become floating-point numbers: exact up to 104 days of nanoseconds. */
function unshuffle(bytes: Uint8Array, type: ColumnType, rows: number): Values {
  const width = BYTES[type];
  if (type === "u8") return bytes;
  if (type === "u64") {
    const values = new Float64Array(rows);
    for (let byte = width - 1; byte >= 0; byte -= 1) {
      const plane = bytes.subarray(byte * rows, (byte + 1) * rows);
      for (let row = 0; row < rows; row += 1) values[row] = values[row] * 256 + plane[row];
    }
    return values;
  }
  const joined = new Uint8Array(rows * width);
  for (let byte = 0; byte < width; byte += 1) {
    const plane = bytes.subarray(byte * rows, (byte + 1) * rows);
    for (let row = 0, offset = byte; row < rows; row += 1, offset += width) joined[offset] = plane[row];
  }
  if (type === "i16") return new Int16Array(joined.buffer);
  return type === "u32" ? new Uint32Array(joined.buffer) : new Float64Array(joined.buffer);
}

function accumulate(values: Values): void {
  for (let row = 1; row < values.length; row += 1) values[row] += values[row - 1];
}
