// Words about a frame.

import { BROADCAST } from "./format";
import { Frame, Replay } from "./replay";

export function senderOf({ chunk, row }: Frame): number {
  return chunk.frames.table.node[row];
}

export function destinationText(replay: Replay, { chunk, row }: Frame): string {
  const destination = chunk.frames.table.destination[row];
  return destination === BROADCAST ? "all" : replay.nameOf(destination);
}

/** What made a node send the frame: "timer beacon"; of an acknowledgment, its kind. */
export function causeText(replay: Replay, { chunk, row }: Frame): string {
  const { table } = chunk.frames;
  const cause = chunk.strings[table.cause[row]];
  const kind = replay.run.kinds[table.kind[row]];
  return (cause || kind) + (table.retry[row] ? ` (retry ${table.retry[row]})` : "");
}
