// The filter of frames: `node:3 outcome:interference timer:beacon`. All terms have to fit.

import { BROADCAST } from "./format";
import { causeText, messageOf, outcomeWords, senderOf } from "./frame_text";
import { Reception } from "./receptions";
import { Chunk, Frame, Replay } from "./replay";

export const KEYS: Record<string, string> = {
  node: "sent or noticed by this node, or by a node of this group (id or name)",
  from: "sent by this node",
  at: "noticed by this node",
  to: "sent to this node, or to all: `to:all`",
  outcome: "what became of it at a receiver, or `lost`",
  kind: "broadcast, unicast, ack, rts, cts",
  timer: "sent by the handler of this timer",
  cause: "sent by this callback",
  text: "whose message has this word",
};

export interface Filter {
  passes(chunk: Chunk, row: number): boolean;
  /** Whether to show what became of a frame at this receiver. */
  shows(reception: Reception, sender: number): boolean;
  isEmpty: boolean;
}

type Nodes = ReadonlySet<number>;
type Test = (chunk: Chunk, row: number) => boolean;

const ALL_OUTCOMES = 0xffff; // bits

/** Throws an Error whose message is for the person who wrote the filter. */
export function parseFilter(text: string, replay: Replay): Filter {
  const tests: Test[] = [];
  let outcomes = ALL_OUTCOMES;
  let isUnnoticed = true; // whether frames that a node did not notice fit, too
  let at: Nodes | null = null;
  let either: Nodes | null = null;
  for (const term of termsOf(text, replay)) {
    const colon = term.indexOf(":");
    const key = term.slice(0, Math.max(0, colon));
    const value = term.slice(colon + 1);
    if (colon < 0) {
      tests.push(testOfWord(value, replay));
      continue;
    }
    if (!(key in KEYS)) throw new Error(`"${key}" is not a key; expected ${Object.keys(KEYS).join(", ")}`);
    if (!value) continue;
    if (key === "outcome") [outcomes, isUnnoticed] = [outcomeBits(value, replay), value !== "lost"];
    else if (key === "at") at = nodesOf(value, replay);
    else if (key === "node") either = nodesOf(value, replay);
    else tests.push(testOf(key, value, replay));
  }
  const shows = (reception: Reception, sender: number): boolean =>
    ((outcomes >> reception.outcome) & 1) === 1 &&
    (at === null || at.has(reception.receiver)) &&
    (either === null || either.has(sender) || either.has(reception.receiver));
  isUnnoticed &&= ((outcomes >> replay.unnoticed) & 1) === 1;
  if (at !== null || either !== null)
    tests.push((chunk, row) => {
      const frame = { chunk, row };
      const sender = senderOf(frame);
      if (at === null && either?.has(sender)) return hasOutcome(chunk, row);
      if (chunk.frames.receptions(row).some((reception) => shows(reception, sender))) return true;
      if (outcomes === ALL_OUTCOMES || !isUnnoticed) return false;
      const isWanted = (node: number): boolean => !either || either.has(sender) || either.has(node);
      return [...(at ?? either ?? [])].some((node) => isWanted(node) && replay.isUnnoticedAt(node, frame));
    });
  else if (outcomes !== ALL_OUTCOMES) tests.push(hasOutcome);
  return { passes: (chunk, row) => tests.every((test) => test(chunk, row)), shows, isEmpty: !tests.length };

  function hasOutcome({ frames }: Chunk, row: number): boolean {
    if (outcomes === ALL_OUTCOMES || (frames.outcomes[row] & outcomes) !== 0) return true;
    return isUnnoticed && frames.table.unnoticed[row] > 0;
  }
}

/** The terms in lower case. An outcome may be written as the page shows it: `outcome:receiver locked`. */
function termsOf(text: string, replay: Replay): string[] {
  let written = text.toLowerCase();
  for (const name of replay.run.outcomes) written = written.replaceAll(`:${outcomeWords(name)}`, `:${name}`);
  return written.split(/\s+/).filter(Boolean);
}

function testOf(key: string, value: string, replay: Replay): Test {
  if (key === "from") {
    const nodes = nodesOf(value, replay);
    return (chunk, row) => nodes.has(chunk.frames.table.node[row]);
  }
  if (key === "to") {
    const nodes = value === "all" ? new Set([BROADCAST]) : nodesOf(value, replay);
    return (chunk, row) => nodes.has(chunk.frames.table.destination[row]);
  }
  if (key === "kind") {
    const kind = replay.run.kinds.indexOf(value);
    if (kind < 0) throw new Error(`"${value}" is not a kind; expected ${replay.run.kinds.join(", ")}`);
    return (chunk, row) => chunk.frames.table.kind[row] === kind;
  }
  if (key === "text") return (chunk, row) => says({ chunk, row }, value);
  const wanted = key === "timer" ? `timer ${value}` : value;
  return (chunk, row) => {
    const cause = chunk.strings[chunk.frames.table.cause[row]].toLowerCase();
    return key === "timer" ? cause.startsWith(wanted) : cause.includes(wanted);
  };
}

/** A word without a key: in what the list shows of a frame, or in its message. */
function testOfWord(word: string, replay: Replay): Test {
  const named = [...replay.nodes.values()].filter((node) => node.name.toLowerCase().includes(word));
  const nodes = new Set(named.map((node) => node.id));
  return (chunk, row) => {
    const { node, destination } = chunk.frames.table;
    if (nodes.has(node[row]) || nodes.has(destination[row])) return true;
    return causeText(replay, { chunk, row }).toLowerCase().includes(word) || says({ chunk, row }, word);
  };
}

/** Whether the recorded beginning of a frame's message has a word, written in lower case. */
function says(frame: Frame, word: string): boolean {
  return messageOf(frame)?.lower.includes(word) ?? false;
}

function nodesOf(value: string, replay: Replay): Nodes {
  const all = [...replay.nodes.values()];
  const isCalled = ({ id, name, group }: (typeof all)[0]): boolean =>
    [name.toLowerCase(), group.toLowerCase(), String(id)].includes(value);
  const named = all.filter((node) => node.name.toLowerCase() === value);
  const found = named.length ? named : all.filter(isCalled);
  if (!found.length) throw new Error(`"${value}" is not a node; expected an id, a name or a group`);
  return new Set(found.map((node) => node.id));
}

function outcomeBits(value: string, replay: Replay): number {
  const { outcomes } = replay.run;
  let bits = 0;
  for (const outcome of replay.possible)
    if (value === "lost" ? replay.isLost[outcome] : outcomes[outcome].startsWith(value)) bits |= 1 << outcome;
  if (!bits) {
    const names = new Set(["lost", ...replay.possible.map((outcome) => outcomes[outcome])]);
    throw new Error(`"${value}" is not an outcome; expected ${[...names].join(", ")}`);
  }
  return bits;
}
