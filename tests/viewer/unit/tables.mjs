import assert from "node:assert/strict";
import { test } from "node:test";
import { countUntil, firstNot, groupRows } from "../../../viewer/src/tables";

test("rows are grouped in their order", () => {
  const { first, rows } = groupRows([2, 0, 2, 2, 0], 4);
  assert.deepEqual([...first], [0, 2, 2, 5, 5]);
  assert.deepEqual([...rows], [1, 4, 0, 2, 3]);
});

test("no rows have empty groups", () => {
  assert.deepEqual([...groupRows([], 2).first], [0, 0, 0]);
});

test("the times until a time are counted with that time", () => {
  const times = [1, 3, 3, 7];
  assert.deepEqual([0, 1, 2, 3, 7, 8].map((time) => countUntil(times, time)), [0, 1, 1, 3, 4, 4]);
});

test("the search stays between its limits", () => {
  assert.equal(firstNot(() => true, 5, 2), 5);
  assert.equal(firstNot(() => false, 5, 2), 2);
});
