// Words about a frame.

import { BROADCAST } from "./format";
import { Frame, Replay } from "./replay";
import { Message } from "./texts";

/** "receiver locked": the words of the summary of a run. */
export function outcomeWords(name: string): string {
  return name.replaceAll("_", " ");
}

export function senderOf({ chunk, row }: Frame): number {
  return chunk.frames.table.node[row];
}

/** "uavs[0] → all" */
export function routeText(replay: Replay, frame: Frame): string {
  const destination = frame.chunk.frames.table.destination[frame.row];
  const to = destination === BROADCAST ? "all" : replay.nameOf(destination);
  return `${replay.nameOf(senderOf(frame))} → ${to}`;
}

/** The message of a frame; null if it has none, or if it was left out of the record. */
export function messageOf({ chunk, row }: Frame): Message | null {
  return chunk.texts.of(chunk.frames.table.text[row]);
}

/** What made a node send the frame: "timer beacon"; of an acknowledgment, its kind. */
export function causeText(replay: Replay, { chunk, row }: Frame): string {
  const { table } = chunk.frames;
  const cause = chunk.strings[table.cause[row]];
  const kind = replay.run.kinds[table.kind[row]];
  return (cause || kind) + (table.retry[row] ? ` (retry ${table.retry[row]})` : "");
}
