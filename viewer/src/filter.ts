// The filter of frames: `node:3 outcome:interference timer:beacon`. All terms have to fit.

import { BROADCAST } from "./format";
import { Chunk, Frame, Replay } from "./replay";
import { Reception } from "./receptions";

export const KEYS: Record<string, string> = {
  node: "sent or noticed by this node (id or name)",
  from: "sent by this node",
  at: "noticed by this node",
  to: "sent to this node, or to all: `to:all`",
  outcome: "what became of it at a receiver, or `lost`",
  kind: "broadcast, unicast, ack, rts, cts",
  timer: "sent by the handler of this timer",
  cause: "sent by this callback",
};

export interface Filter {
  passes(chunk: Chunk, row: number): boolean;
  /** Whether to show what became of a frame at this receiver. */
  shows(reception: Reception, sender: number): boolean;
  isEmpty: boolean;
}

type Test = (chunk: Chunk, row: number) => boolean;

/** Throws an Error whose message is for the person who wrote the filter. */
export function parseFilter(text: string, replay: Replay): Filter {
  const tests: Test[] = [];
  let outcomes = 0xffff; // bits
  let at: number | null = null;
  let either: number | null = null;
  for (const term of text.trim().split(/\s+/).filter(Boolean)) {
    const colon = term.indexOf(":");
    const key = colon < 0 ? "cause" : term.slice(0, colon);
    const value = term.slice(colon + 1);
    if (!(key in KEYS)) throw new Error(`"${key}" is not a key; expected ${Object.keys(KEYS).join(", ")}`);
    if (!value) continue;
    if (key === "outcome") outcomes = outcomeBits(value, replay);
    else if (key === "at") at = nodeOf(value, replay);
    else if (key === "node") either = nodeOf(value, replay);
    else tests.push(testOf(key, value, replay));
  }
  const shows = (reception: Reception, sender: number): boolean =>
    ((outcomes >> reception.outcome) & 1) === 1 &&
    (at === null || reception.receiver === at) &&
    (either === null || sender === either || reception.receiver === either);
  if (outcomes !== 0xffff) tests.push((chunk, row) => (chunk.frames.outcomes[row] & outcomes) !== 0);
  if (at !== null || either !== null)
    tests.push((chunk, row) => {
      const sender = chunk.frames.table.node[row];
      if (sender === either && at === null && outcomes === 0xffff) return true;
      return chunk.frames.receptions(row).some((reception) => shows(reception, sender));
    });
  return { passes: (chunk, row) => tests.every((test) => test(chunk, row)), shows, isEmpty: !tests.length };
}

function testOf(key: string, value: string, replay: Replay): Test {
  if (key === "from") {
    const node = nodeOf(value, replay);
    return (chunk, row) => chunk.frames.table.node[row] === node;
  }
  if (key === "to") {
    const node = value === "all" ? BROADCAST : nodeOf(value, replay);
    return (chunk, row) => chunk.frames.table.destination[row] === node;
  }
  if (key === "kind") {
    const kind = replay.run.kinds.indexOf(value);
    if (kind < 0) throw new Error(`"${value}" is not a kind; expected ${replay.run.kinds.join(", ")}`);
    return (chunk, row) => chunk.frames.table.kind[row] === kind;
  }
  const wanted = (key === "timer" ? `timer ${value}` : value).toLowerCase();
  return (chunk, row) => {
    const cause = chunk.strings[chunk.frames.table.cause[row]].toLowerCase();
    return key === "timer" ? cause.startsWith(wanted) : cause.includes(wanted);
  };
}

function nodeOf(value: string, replay: Replay): number {
  for (const node of replay.nodes.values()) if (node.name === value) return node.id;
  const id = Number(value);
  if (!replay.nodes.has(id)) throw new Error(`"${value}" is not a node; expected an id or a name`);
  return id;
}

function outcomeBits(value: string, replay: Replay): number {
  const { outcomes } = replay.run;
  let bits = 0;
  outcomes.forEach((name, outcome) => {
    if (value === "lost" ? replay.isLost[outcome] : name.startsWith(value)) bits |= 1 << outcome;
  });
  if (!bits) throw new Error(`"${value}" is not an outcome; expected lost, ${outcomes.join(", ")}`);
  return bits;
}

export function senderOf(frame: Frame): number {
  return frame.chunk.frames.table.node[frame.row];
}
