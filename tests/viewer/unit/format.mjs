import assert from "node:assert/strict";
import { test } from "node:test";
import { deflateSync } from "node:zlib";
import { PackedChunk } from "../../../viewer/src/format";

/** Bytes 0 of all numbers, then bytes 1, and so on. */
function shuffled(numbers, width, write) {
  const plain = Buffer.alloc(numbers.length * width);
  numbers.forEach((value, row) => {
    write(plain, value, row * width);
  });
  const planes = [...Array(width).keys()].map((byte) => numbers.map((_, row) => plain[row * width + byte]));
  return deflateSync(Buffer.from(planes.flat()));
}

function chunk() {
  const columns = [
    ["time_ns", "u64", true, shuffled([1, 2n ** 40n, 3].map(BigInt), 8, (to, value, at) => to.writeBigUInt64LE(value, at))],
    ["power", "i16", false, shuffled([-1, 2, -30000], 2, (to, value, at) => to.writeInt16LE(value, at))],
    ["x", "f64", false, shuffled([0.1, -2, 1e300], 8, (to, value, at) => to.writeDoubleLE(value, at))],
    ["node", "u32", false, shuffled([0, 1, 4294967295], 4, (to, value, at) => to.writeUInt32LE(value, at))],
    ["kind", "u8", false, deflateSync(Buffer.from([7, 8, 9]))],
  ];
  const described = columns.map(([name, type, delta, bytes]) => [name, type, delta, bytes.length]);
  const tables = { none: { rows: 0, columns: [["a", "u32", false, 0]] }, frames: { rows: 3, columns: described } };
  const header = Buffer.from(JSON.stringify({ tables }));
  const length = Buffer.alloc(4);
  length.writeUInt32LE(header.length);
  return Buffer.concat([length, header, ...columns.map((column) => column[3])]);
}

for (const [name, packed] of [
  ["bytes", new Uint8Array(chunk())],
  ["base64", chunk().toString("base64")],
])
  test(`a table is read from ${name}`, async () => {
    const table = await new PackedChunk(packed).table("frames");
    assert.deepEqual(Object.fromEntries(Object.entries(table).map(([column, values]) => [column, [...values]])), {
      time_ns: [1, 2 ** 40 + 1, 2 ** 40 + 4],
      power: [-1, 2, -30000],
      x: [0.1, -2, 1e300],
      node: [0, 1, 4294967295],
      kind: [7, 8, 9],
    });
  });

test("a table without rows has empty columns", async () => {
  assert.deepEqual([...(await new PackedChunk(new Uint8Array(chunk())).table("none")).a], []);
});

test("a table that is not there is an error", async () => {
  await assert.rejects(new PackedChunk(new Uint8Array(chunk())).table("events"), /events/);
});

test("a chunk that was cut is an error", () => {
  const bytes = new Uint8Array(chunk());
  assert.throws(() => new PackedChunk(bytes.subarray(0, -1)), new RegExp(`expected ${bytes.length}`));
});
