import assert from "node:assert/strict";
import { test } from "node:test";
import { parseFilter } from "../../../viewer/src/filter";
import { BROADCAST } from "../../../viewer/src/format";
import { Replay } from "../../../viewer/src/replay";

const OUTCOMES = ["delivered", "interference", "receiver_locked", "below_sensitivity", "in_air"];
const KINDS = ["broadcast", "unicast", "ack"];
const node = (id, name) => ({ id, name, group: name.split("[")[0] });
const run = {
  nodes: [node(0, "uavs[0]"), node(1, "uavs[1]"), node(2, "base")],
  outcomes: OUTCOMES,
  kinds: KINDS,
  recorded: null,
  mode: "integrated",
};
const replay = new Replay({ run, chunks: [] });

/** Three frames: sender, destination, kind, cause, message, and outcomes by receiver. */
const FRAMES = [
  [0, BROADCAST, 0, "timer beacon", "Hello all", { 1: "delivered", 2: "interference" }],
  [1, 2, 1, "handle_packet", "reply", { 2: "receiver_locked" }],
  [2, 1, 2, "", "", {}],
];
const bit = (outcome) => 1 << OUTCOMES.indexOf(outcome);
const chunk = {
  strings: FRAMES.map(([, , , cause]) => cause),
  texts: { of: (row) => (FRAMES[row][4] ? { lower: FRAMES[row][4].toLowerCase() } : null) },
  frames: {
    table: {
      node: FRAMES.map(([sender]) => sender),
      destination: FRAMES.map(([, destination]) => destination),
      kind: FRAMES.map(([, , kind]) => kind),
      cause: [0, 1, 2],
      text: [0, 1, 2],
      retry: [0, 0, 0],
      unnoticed: [0, 0, 0],
    },
    outcomes: FRAMES.map((frame) => Object.values(frame[5]).reduce((bits, outcome) => bits | bit(outcome), 0)),
    receptions: (row) =>
      Object.entries(FRAMES[row][5]).map(([receiver, outcome]) => ({
        receiver: Number(receiver),
        outcome: OUTCOMES.indexOf(outcome),
      })),
  },
};

for (const [filter, passing] of [
  ["", [0, 1, 2]],
  ["from:uavs[0]", [0]],
  ["from:uavs", [0, 1]],
  ["from:2", [2]],
  ["to:all", [0]],
  ["to:base", [1]],
  ["at:base", [0, 1]],
  ["kind:ack", [2]],
  ["timer:beacon", [0]],
  ["cause:packet", [1]],
  ["text:hello", [0]],
  ["HELLO", [0]],
  ["base", [1, 2]],
  ["outcome:lost", [0, 1]],
  ["outcome:interference", [0]],
  ["outcome:receiver locked", [1]],
  ["from:uavs outcome:receiver_locked", [1]],
  ["at:uavs[1] outcome:interference", []],
  ["from:", [0, 1, 2]],
])
  test(`"${filter}" lets frames ${passing} pass`, () => {
    const { passes } = parseFilter(filter, replay);
    assert.deepEqual([0, 1, 2].filter((row) => passes(chunk, row)), passing);
  });

test("receptions are shown that fit outcome and node", () => {
  const { shows } = parseFilter("at:base outcome:interference", replay);
  const receptions = chunk.frames.receptions(0);
  assert.deepEqual(receptions.map((reception) => shows(reception, 0)), [false, true]);
});

for (const [filter, wrong, expected] of [
  ["sender:2", "sender", "from"],
  ["from:drone", "drone", "id"],
  ["kind:beacon", "beacon", "broadcast"],
  ["outcome:gone", "gone", "delivered"],
])
  test(`the mistake in "${filter}" is named, with what is expected`, () => {
    assert.throws(
      () => parseFilter(filter, replay),
      ({ message }) => message.includes(`"${wrong}"`) && message.split("expected")[1].includes(expected),
    );
  });
