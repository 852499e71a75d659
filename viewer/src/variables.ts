// The tracked variables of a node over the whole run, and its events.

import { Replay } from "./replay";
import { countUntil } from "./tables";

export interface Series {
  name: string;
  timesS: number[];
  /** Numbers; null where the value was something else. */
  values: (number | null)[];
  texts: string[];
}

export interface NodeEvent {
  timeNs: number;
  kind: string;
  text: string;
}

export interface History {
  node: number;
  /** How many chunks were read. */
  chunks: number;
  series: Map<string, Series>;
  events: NodeEvent[];
}

export function noHistory(node: number): History {
  return { node, chunks: 0, series: new Map(), events: [] };
}

/** Read the chunks that are not read yet, one after the other, as long as that is wanted. */
export async function readOn(replay: Replay, history: History, isWanted: () => boolean): Promise<void> {
  const { node, series, events } = history;
  while (history.chunks < replay.chunks.length && isWanted()) {
    const chunk = replay.chunks[history.chunks];
    history.chunks += 1;
    const { tables, strings } = chunk.header;
    const [variables, happened] = await Promise.all(
      ["variables", "events"].map((name) => (tables[name].rows ? chunk.table(name) : null)),
    );
    for (let row = 0; variables && row < variables.node.length; row += 1) {
      if (variables.node[row] !== node) continue;
      const name = strings[variables.name[row]];
      let one = series.get(name);
      if (!one) series.set(name, (one = { name, timesS: [], values: [], texts: [] }));
      const value = variables.value[row];
      one.timesS.push(variables.time_ns[row] / 1e9);
      one.values.push(Number.isNaN(value) ? null : value);
      one.texts.push(Number.isNaN(value) ? strings[variables.text[row]] : "");
    }
    for (let row = 0; happened && row < happened.node.length; row += 1)
      if (happened.node[row] === node)
        events.push({
          timeNs: happened.time_ns[row],
          kind: replay.run.event_kinds[happened.kind[row]],
          text: strings[happened.text[row]],
        });
  }
}

/** Return the value at a time as text. */
export function valueText(series: Series, timeS: number): string {
  const index = countUntil(series.timesS, timeS) - 1;
  if (index < 0) return "–";
  const value = series.values[index];
  return value === null ? series.texts[index] : String(Number(value.toPrecision(7)));
}
