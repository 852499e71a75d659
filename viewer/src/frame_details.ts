// The chosen frame: what became of it where, who interfered.

import { Interferer } from "./air";
import { outcomeColor, outcomeWords } from "./colors";
import { button, distanceText, durationText, make, timeText } from "./dom";
import { senderOf } from "./filter";
import { NO_POWER, Table } from "./format";
import { causeText, destinationText } from "./frames";
import { Frame, Replay, startOf } from "./replay";

interface Loss {
  power: number;
  interference: number;
  interferers: number[];
}

export class FrameDetails {
  readonly element = make("div", { class: "details" });
  interferers: Interferer[] = [];
  private frame: Frame | null = null;

  constructor(
    private readonly replay: Replay,
    private readonly close: () => void,
  ) {}

  /** Show a frame; null: none. */
  async read(frame: Frame | null): Promise<void> {
    this.frame = frame;
    this.interferers = [];
    this.element.replaceChildren();
    if (frame === null) return;
    const losses = await readLosses(frame);
    if (this.frame !== frame) return;
    for (const [receiver, loss] of losses)
      for (const node of loss.interferers) this.interferers.push({ node, receiver });
    this.element.replaceChildren(...describe(this.replay, frame, losses, this.close));
  }
}

/** Return what is known of the losses of a frame, by receiver. */
async function readLosses({ chunk, row }: Frame): Promise<Map<number, Loss>> {
  const [losses, interferers] = await Promise.all([chunk.table("losses"), chunk.table("interferers")]);
  const found = new Map<number, Loss>();
  for (const place of rowsOf(losses, row))
    found.set(losses.receiver[place], {
      power: losses.power_cdbm[place],
      interference: losses.interference_cdbm[place],
      interferers: [],
    });
  for (const place of rowsOf(interferers, row)) {
    const receiver = interferers.receiver[place];
    const loss = found.get(receiver) ?? { power: NO_POWER, interference: NO_POWER, interferers: [] };
    loss.interferers.push(interferers.node[place]);
    found.set(receiver, loss);
  }
  return found;
}

function describe(
  replay: Replay,
  frame: Frame,
  losses: ReadonlyMap<number, Loss>,
  close: () => void,
): HTMLElement[] {
  const { table } = frame.chunk.frames;
  const sender = senderOf(frame);
  const kind = replay.run.kinds[table.kind[frame.row]];
  const facts = [
    `${kind}, ${causeText(replay, frame)}`,
    `at ${Number(timeText(startOf(frame), 9))} s for ${durationText(table.duration_ns[frame.row])}`,
    `${table.bytes[frame.row]} bytes at ${(table.bitrate_bps[frame.row] / 1e6).toLocaleString("en-US")} Mbit/s`,
  ];
  const receptions = frame.chunk.frames
    .receptions(frame.row)
    .map((reception) => ({ ...reception, distance: distance(replay, frame, reception.receiver) }))
    .sort((a, b) => Number(replay.isLost[b.outcome]) - Number(replay.isLost[a.outcome]) || a.distance - b.distance);
  const body = make("tbody");
  for (const { receiver, outcome, distance: meters } of receptions) {
    const name = replay.run.outcomes[outcome];
    const loss = losses.get(receiver);
    const words = make("span", { class: replay.isLost[outcome] ? "badge lost" : "badge" }, outcomeWords(name));
    words.style.setProperty("--color", outcomeColor(name));
    const by = loss?.interferers.map(
      (other) => `${replay.nameOf(other)} (${distanceText(between(replay, frame, other, receiver))})`,
    );
    const others = by?.length ? `with ${by.join(", ")}${strengthText(loss?.interference)}` : "";
    const cells = [
      [replay.nameOf(receiver)],
      [words, make("div", { class: "muted" }, others)],
      [distanceText(meters)],
      [strengthText(loss?.power).replace(": ", "")],
    ];
    body.append(make("tr", {}, ...cells.map((cell) => make("td", {}, ...cell))));
  }
  const heads = ["at", "outcome", "distance", "power"].map((head) => make("th", {}, head));
  const unnoticed = table.unnoticed[frame.row];
  return [
    make(
      "div",
      { class: "row" },
      make("h2", {}, `${replay.nameOf(sender)} → ${destinationText(replay, frame)}`),
      make("span", { class: "end" }, button("✕", "Close (Esc)", close)),
    ),
    make("p", { class: "message" }, facts.join(" · ")),
    make("table", {}, make("thead", {}, make("tr", {}, ...heads)), body),
    make("p", { class: "message" }, unnoticed ? `${unnoticed} more nodes did not notice it.` : ""),
  ];
}

/** The rows of a table, sorted by frame, that belong to a frame. */
function* rowsOf(table: Table, frame: number): Generator<number> {
  let low = 0;
  let high = table.frame.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (table.frame[middle] < frame) low = middle + 1;
    else high = middle;
  }
  for (; low < table.frame.length && table.frame[low] === frame; low += 1) yield low;
}

function distance(replay: Replay, frame: Frame, receiver: number): number {
  return between(replay, frame, senderOf(frame), receiver);
}

function between(replay: Replay, frame: Frame, a: number, b: number): number {
  const [from, to] = [replay.position(a, frame), replay.position(b, frame)];
  return Math.hypot(from[0] - to[0], from[1] - to[1], from[2] - to[2]);
}

/** ": -83.8 dBm"; "" if it is not known. */
function strengthText(power: number | undefined): string {
  return power === undefined || power === NO_POWER ? "" : `: ${(power / 100).toFixed(1)} dBm`;
}
