// Which nodes a sequence chart has lanes for, and which frames it shows.

import { Picture } from "./air";
import { senderOf } from "./frame_text";
import { Frame, Replay, startOf } from "./replay";

/** How many lanes it has, unless more nodes are pinned. */
const MOST_LANES = 9;

/** How many frames it shows. */
export const MOST_FRAMES = 600;

/** How many rows it decodes for them. */
const MOST_ROWS = 60_000;

/** A frame may be that long. */
const LONGEST_NS = 1e8;

export function endOf(frame: Frame): number {
  return startOf(frame) + frame.chunk.frames.table.duration_ns[frame.row];
}

/** Return the frames of a window, the last ones if there are too many; null if they have to be decoded first: `redraw` is called then. */
export function framesOf(
  replay: Replay,
  fromNs: number,
  toNs: number,
  { filter, interferers, state }: Picture,
  redraw: () => void,
): Frame[] | null {
  const end = Math.min(toNs, replay.endNs);
  if (!replay.isReady(end)) {
    void replay.load(end).then(redraw);
    return null;
  }
  let rows = 0;
  for (let index = replay.chunkIndexAt(end); index >= 0 && rows < MOST_ROWS; index -= 1) {
    if (replay.chunks[index].header.end_ns < fromNs) break;
    const chunk = replay.chunk(index);
    if (chunk === null) {
      void replay.loadChunk(index).then(redraw);
      return null;
    }
    rows += chunk.size;
  }
  const interfered = (frame: Frame): boolean =>
    interferers.some(({ node }) => node === senderOf(frame)) && overlap(frame, state.frame);
  return replay
    .framesBetween(fromNs - LONGEST_NS, end, MOST_FRAMES)
    .filter((frame) => endOf(frame) >= fromNs && (filter.passes(frame.chunk, frame.row) || interfered(frame)))
    .reverse();
}

/** Whether two frames are on the air at once. */
export function overlap(a: Frame, b: Frame | null): boolean {
  return b !== null && startOf(a) < endOf(b) && startOf(b) < endOf(a);
}

/**
 * Return the nodes to show, by id: those that are pinned, or those that have to do with the chosen frame or node, or
 * with the frames next to the clock, and whether all of them fit. `before`, the nodes shown so far, stay where there is
 * room.
 */
export function lanesOf(
  replay: Replay,
  frames: readonly Frame[],
  { state, timeNs, interferers }: Picture,
  before: readonly number[],
): { lanes: number[]; areAll: boolean } {
  const lanes = new Set(state.pinned);
  if (state.node !== null) lanes.add(state.node);
  if (lanes.size < 2) {
    if (state.frame !== null) lanes.add(senderOf(state.frame));
    for (const { node, receiver } of interferers) lanes.add(node).add(receiver);
    const ofNode = frames.filter((frame) => state.node === null || nodesOf(replay, frame).includes(state.node));
    const away = (frame: Frame): number => Math.abs(startOf(frame) - timeNs);
    for (const frame of state.frame ? [state.frame] : ofNode.sort((a, b) => away(a) - away(b))) {
      if (lanes.size > MOST_LANES) break;
      for (const node of nodesOf(replay, frame)) lanes.add(node);
    }
    const shown = [...new Set([...lanes, ...before])].slice(0, MOST_LANES);
    return { lanes: shown.sort((a, b) => a - b), areAll: lanes.size <= MOST_LANES };
  }
  return { lanes: [...lanes].sort((a, b) => a - b), areAll: true };
}

/** The sender of a frame, and the nodes that lost or noticed it. */
function nodesOf({ isLost }: Replay, frame: Frame): number[] {
  const receptions = frame.chunk.frames.receptions(frame.row);
  receptions.sort((a, b) => Number(isLost[b.outcome]) - Number(isLost[a.outcome]));
  return [senderOf(frame), ...receptions.map(({ receiver }) => receiver)];
}
