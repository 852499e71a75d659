// A run that a VisualizationHandler shows: its snapshots become chunks.
// gradysim.simulator.handler.visualization.messages defines the messages.

import { Run, RunEnd, StoredChunk, Table } from "./format";
import { apply, Command, copyOf, Look, plainLook } from "./look";
import { connect, FORMAT, Source } from "./source";

type Range = [number, number];

interface Greeting {
  x_range: Range;
  y_range: Range;
  z_range: Range;
  nodes: string[];
}

interface Snapshot {
  nodes: number[];
  positions: [number, number, number][];
  simulation_time: number;
  tracked_variables: Record<string, unknown>[];
}

/** Length of a chunk, in milliseconds of the wall clock. */
const CHUNK_MS = 200;

/** So that hours fit into memory, snapshots are kept less often after each million legs (72 MB). */
const LEGS_PER_STEP = 1_000_000;
const STEP_MS = 50;

const LEGS = ["time_ns", "duration_ns", "node", "x0", "y0", "z0", "x1", "y1", "z1"];
const VARIABLES = ["time_ns", "node", "name", "value", "text"];
const NO_ROWS = tableOf(["time_ns", "node", "frame", "recorded", "byte"], []);

class SnapshotSource implements Source {
  readonly isLive = true;
  readonly follows = true;
  readonly chunks: StoredChunk[] = [];
  run!: Run;
  end: RunEnd | null = null;
  isLost = false;
  onChange: (() => void) | null = null;
  private greeting: Greeting | null = null;
  private newest: Snapshot | null = null; // not kept yet
  private last: Snapshot | null = null; // kept
  private lastMs = 0;
  private isRunning = true;

  // The chunk under way.
  private startNs: number | null = null;
  private legs: number[][] = [];
  private variables: number[][] = [];
  private strings = new Map([["", 0]]);

  private legCount = 0;
  private readonly values = new Map<string, unknown>();
  private readonly look = plainLook();
  private cutLook: Look | null = null;

  constructor(
    private readonly socket: WebSocket,
    private readonly started: () => void,
  ) {
    const timer = setInterval(() => this.cut(), CHUNK_MS);
    socket.addEventListener("message", ({ data }) => this.receive(JSON.parse(data as string)));
    socket.addEventListener("close", ({ code }) => {
      clearInterval(timer);
      this.keep(0);
      this.cut();
      if (code === 1001) this.end = { time_s: this.last?.simulation_time ?? 0, complete: true };
      else this.isLost = true;
      this.onChange?.();
    });
  }

  tell(_timeNs: number, _speed: number, isPlaying: boolean): void {
    if (isPlaying === this.isRunning || this.socket.readyState !== WebSocket.OPEN) return;
    this.isRunning = isPlaying;
    this.socket.send('{"interaction": "pause/resume"}');
  }

  private receive(message: Greeting | Command | Snapshot): void {
    if (this.greeting === null) this.greeting = message as Greeting;
    else if ("command" in message) {
      apply(this.look, message);
      this.cutLook = null;
    } else {
      this.newest = message as Snapshot;
      this.run ??= runOf(this.greeting, this.newest);
      this.keep();
      if (!this.chunks.length) this.cut();
    }
  }

  /** Keep the newest snapshot if the last one was kept so long ago. */
  private keep(intervalMs = STEP_MS * (2 ** Math.floor(this.legCount / LEGS_PER_STEP) - 1)): void {
    const now = this.newest;
    const nowMs = performance.now();
    if (now === null || nowMs - this.lastMs < intervalMs) return;
    const last = this.last ?? now;
    [this.newest, this.last, this.lastMs] = [null, now, nowMs];
    const [fromNs, toNs] = [last, now].map((snapshot) => Math.round(snapshot.simulation_time * 1e9));
    const isFirst = this.startNs === null;
    this.startNs ??= fromNs;
    now.nodes.forEach((node, index) => {
      const [from, to] = [last.positions[index], now.positions[index]];
      if (isFirst || from.some((value, axis) => value !== to[axis]))
        this.legs.push([fromNs, toNs - fromNs, node, ...from, ...to]);
      for (const [name, value] of Object.entries(now.tracked_variables[index])) this.assign(toNs, node, name, value);
    });
  }

  private assign(timeNs: number, node: number, name: string, value: unknown): void {
    const plain = typeof value === "object" ? JSON.stringify(value) : value;
    const key = `${node} ${name}`;
    if (this.values.get(key) === plain) return;
    this.values.set(key, plain);
    const [number, text] = typeof plain === "number" ? [plain, ""] : [NaN, String(plain)];
    this.variables.push([timeNs, node, this.indexOf(name), number, this.indexOf(text)]);
  }

  private indexOf(text: string): number {
    let index = this.strings.get(text);
    if (index === undefined) this.strings.set(text, (index = this.strings.size));
    return index;
  }

  /** End the chunk under way. */
  private cut(): void {
    this.keep();
    if (this.startNs === null || this.last === null) return;
    const { legs, variables } = this;
    const tables: Record<string, Table> = {
      frames: NO_ROWS,
      receptions: NO_ROWS,
      legs: tableOf(LEGS, legs),
      variables: variables.length ? tableOf(VARIABLES, variables) : NO_ROWS,
      events: NO_ROWS,
      texts: NO_ROWS,
      text_bytes: NO_ROWS,
    };
    const counts = Object.entries(tables).map(([name, { time_ns }]) => [name, { rows: time_ns.length }] as const);
    const header = {
      start_ns: this.startNs,
      end_ns: Math.round(this.last.simulation_time * 1e9),
      strings: [...this.strings.keys()],
      density: { bin_ns: 1, frames: [], lost: [] },
      outcomes: { node: [], outcome: [], count: [] },
      sent: { node: [], destination: [], frames: [], receptions: [], unnoticed: [] },
      tables: Object.fromEntries(counts),
    };
    this.cutLook ??= copyOf(this.look);
    this.chunks.push({ header, look: this.cutLook, table: (name) => Promise.resolve(tables[name]) });
    this.legCount += legs.length;
    [this.startNs, this.legs, this.variables, this.strings] = [null, [], [], new Map([["", 0]])];
    this.started();
    this.onChange?.();
  }
}

function tableOf(columns: string[], rows: number[][]): Table {
  return Object.fromEntries(columns.map((name, index) => [name, Float64Array.from(rows, (row) => row[index])]));
}

function runOf({ x_range, y_range, z_range, nodes }: Greeting, first: Snapshot): Run {
  return {
    format: FORMAT,
    file: "",
    config: "",
    run: 0,
    mode: "",
    seed: 0,
    duration_s: 0,
    iterations: {},
    description: "",
    ini: "",
    recorded: null,
    nodes: first.nodes.map((id, index) => {
      const protocol = nodes[index].replace(/ \d+$/, "");
      return { id, name: nodes[index], group: protocol, protocol, range_m: null, far_loss: null };
    }),
    obstacles: [],
    outcomes: [],
    kinds: [],
    event_kinds: [],
    extent_m: x_range.flatMap((x) => y_range.flatMap((y) => z_range.flatMap((z) => [x, y, z]))),
  };
}

/** Connect to the handler that serves the page; null if none does. */
export function snapshotSource(): Promise<Source> | null {
  return connect("gradysim-snapshots", (socket, started) => new SnapshotSource(socket, started));
}
