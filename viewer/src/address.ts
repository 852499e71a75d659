// The address holds the time, the node, the frame and the filter, so that a bug report is a link.

import { Replay, Frame } from "./replay";
import { State } from "./state";

const DELAY_MS = 300;

export interface Place {
  timeNs: number | null;
  state: Partial<State>;
  /** Number of the frame in the run. */
  frame: number | null;
}

/** A node that an address may name. */
export type Named = Readonly<{ id: number; name: string }>;

export class Address {
  private timer = 0;

  constructor(
    private readonly nodes: readonly Named[],
    private readonly replay: Replay,
  ) {}

  read(): Place {
    const values = new URLSearchParams(location.hash.slice(1));
    const time = Number.parseFloat(values.get("t") ?? "");
    const frame = Number.parseInt(values.get("frame") ?? "", 10);
    return {
      timeNs: Number.isNaN(time) ? null : time * 1e9,
      frame: Number.isNaN(frame) ? null : frame,
      state: {
        node: this.nodeCalled(values.get("node")),
        isFollowing: values.get("follow") === "1",
        sequence: values.get("sequence") === "1",
        pinned: (values.get("pins") ?? "").split(",").flatMap((pin) => this.nodeCalled(pin) ?? []),
        filter: values.get("filter") ?? "",
      },
    };
  }

  /** Write it a little later: browsers limit how often it may change. */
  write(timeNs: number, state: Readonly<State>): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => {
      const values: [string, string][] = [["t", String(Number((timeNs / 1e9).toFixed(9)))]];
      if (state.node !== null) values.push(["node", this.nameOf(state.node)]);
      if (state.isFollowing) values.push(["follow", "1"]);
      if (state.sequence) values.push(["sequence", "1"]);
      if (state.pinned.length) values.push(["pins", state.pinned.map((node) => this.nameOf(node)).join()]);
      if (state.frame !== null) values.push(["frame", String(frameNumber(this.replay, state.frame))]);
      if (state.filter) values.push(["filter", state.filter]);
      // Readable: only what would end the address or a value is escaped.
      const text = values.map(([key, value]) => `${key}=${value.replace(/[&%+# ]/g, encodeURIComponent)}`);
      history.replaceState(null, "", `#${text.join("&")}`);
    }, DELAY_MS);
  }

  private nodeCalled(name: string | null): number | null {
    return this.nodes.find((node) => node.name === name || String(node.id) === name)?.id ?? null;
  }

  private nameOf(node: number): string {
    return this.nodes.find(({ id }) => id === node)?.name ?? "";
  }
}

function frameNumber(replay: Replay, { chunk, row }: Frame): number {
  return firstFrame(replay, chunk.index) + row;
}

/** Return the frame with this number; null if the run has none. */
export async function findNumber(replay: Replay, number: number): Promise<Frame | null> {
  for (const [index, { header }] of replay.chunks.entries()) {
    const row = number - firstFrame(replay, index);
    if (row >= 0 && row < header.tables.frames.rows) return { chunk: await replay.loadChunk(index), row };
  }
  return null;
}

function firstFrame(replay: Replay, index: number): number {
  return replay.chunks.slice(0, index).reduce((sum, { header }) => sum + header.tables.frames.rows, 0);
}
