import assert from "node:assert/strict";
import { test } from "node:test";
import { Legs } from "../../../viewer/src/legs";

// Node 0 flies 10 m along x from 1 s to 2 s, and turns along y at 3 s; node 2 stands.
const TABLE = {
  node: [0, 2, 0],
  time_ns: [1e9, 0, 3e9],
  duration_ns: [1e9, 0, 2e9],
  x0: [0, 5, 10],
  y0: [0, 6, 0],
  z0: [0, 7, 0],
  x1: [10, 5, 10],
  y1: [0, 6, 4],
  z1: [0, 7, 0],
};
const legs = new Legs(TABLE, 3);

function position(node, timeNs) {
  const into = new Float64Array(4);
  legs.position(node, timeNs, into, 1);
  return [...into.subarray(1)];
}

test("a node is between the ends of its leg", () => {
  assert.deepEqual(position(0, 1.5e9), [5, 0, 0]);
});

test("a node waits where its leg ends", () => {
  assert.deepEqual(position(0, 2.9e9), [10, 0, 0]);
  assert.deepEqual(position(0, 99e9), [10, 4, 0]);
});

test("before its first leg a node is at its start", () => {
  assert.deepEqual(position(0, 0), [0, 0, 0]);
});

test("a node without a leg is nowhere", () => {
  assert.deepEqual(position(1, 1e9), [NaN, NaN, NaN]);
});

test("a node heads along its leg while it moves", () => {
  assert.deepEqual([1.5e9, 2.5e9, 4e9].map((timeNs) => legs.heading(0, timeNs)), [
    [1, 0, 0],
    [0, 0, 0],
    [0, 1, 0],
  ]);
  assert.deepEqual(legs.heading(2, 1e9), [0, 0, 0]);
});

test("corners are those between two times", () => {
  assert.deepEqual([...legs.corners(0, 1e9, 4e9)], [[3e9, 10, 0, 0]]);
});
