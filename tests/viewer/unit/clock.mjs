import assert from "node:assert/strict";
import { test } from "node:test";
import { Clock, speedFor } from "../../../viewer/src/clock";

function clock(endNs, { follows = false, mayGrow = false } = {}) {
  const made = new Clock(follows);
  made.grow(endNs, mayGrow);
  return made;
}

test("the speed is the slowest with which the run is over in 100 s", () => {
  assert.deepEqual([1, 100, 101, 7200].map((durationS) => speedFor(durationS * 1e9)), [0.01, 1, 2, 100]);
});

test("the longest run has the greatest speed", () => {
  assert.equal(speedFor(1e18), 1000);
});

test("it advances by its speed", () => {
  const playing = clock(10e9);
  playing.speed = 5;
  playing.toggle();
  assert.equal(playing.advance(0.5), true);
  assert.equal(playing.timeNs, 2.5e9);
});

test("a clock that stands does not advance", () => {
  const standing = clock(10e9);
  assert.equal(standing.advance(1), false);
  assert.equal(standing.timeNs, 0);
});

test("it pauses at the end, and starts again from there", () => {
  const playing = clock(1e9);
  playing.toggle();
  playing.advance(2);
  assert.deepEqual([playing.timeNs, playing.isPlaying], [1e9, false]);
  playing.toggle();
  assert.deepEqual([playing.timeNs, playing.isPlaying], [0, true]);
});

test("it waits at the end of a run that goes on", () => {
  const playing = clock(1e9, { mayGrow: true });
  playing.toggle();
  playing.advance(2);
  assert.deepEqual([playing.timeNs, playing.isPlaying], [1e9, true]);
});

test("it stays within the run", () => {
  const standing = clock(1e9);
  standing.seek(-5);
  assert.equal(standing.timeNs, 0);
  standing.seek(5e9);
  assert.equal(standing.timeNs, 1e9);
});

test("at the end of a run that does not wait, it follows without going beyond it", () => {
  const following = clock(1e9, { follows: true, mayGrow: true });
  following.seek(1e9);
  assert.equal(following.isFollowing, true);
  following.grow(2e9, true);
  following.advance(0.125);
  assert.equal(following.timeNs, 1.5e9);
  following.advance(10);
  assert.equal(following.timeNs, 2e9);
});
