// Steps from frame to frame.

import { Filter, parseFilter } from "./filter";
import { Chunk, Frame, Replay } from "./replay";

/** What to step to: any frame that the filter passes, one with a loss, or one of a node. */
export type Goal = "frame" | "loss" | { node: number };

/** Return the next frame (or, by `direction` -1, the one before) after a frame or a time; null if there is none. */
export function findStep(
  replay: Replay,
  goal: Goal,
  filter: Filter,
  from: Frame | number,
  direction: 1 | -1,
): Promise<Frame | null> {
  if (goal === "frame") return replay.findFrame(from, direction, filter.passes);
  if (goal === "loss")
    return replay.findFrame(
      from,
      direction,
      (chunk, row) => chunk.frames.lost[row] > 0 && filter.passes(chunk, row),
      ({ header }) => header.density.lost.some((count) => count > 0),
    );
  const { passes } = parseFilter(`node:${goal.node}`, replay);
  const isWanted = (chunk: Chunk, row: number): boolean => passes(chunk, row) && filter.passes(chunk, row);
  return replay.findFrame(from, direction, isWanted);
}
