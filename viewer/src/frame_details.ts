// The chosen frame: what became of it where, who interfered.

import { Interferer } from "./air";
import { outcomeColor, outcomeWords } from "./colors";
import { button, distanceText, durationText, make, timeText } from "./dom";
import { NO_POWER, Table } from "./format";
import { causeText, destinationText, senderOf } from "./frame_text";
import { Reception } from "./receptions";
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
  private node: number | null = null;

  constructor(
    private readonly replay: Replay,
    private readonly close: () => void,
  ) {}

  /** Show a frame (null: none), what became of it at the chosen node first. */
  async read(frame: Frame | null, node: number | null): Promise<void> {
    if (frame !== this.frame) {
      this.interferers = [];
      this.element.replaceChildren();
    }
    [this.frame, this.node] = [frame, node];
    if (frame === null) return;
    const losses = await readLosses(frame);
    if (this.frame !== frame || this.node !== node) return;
    this.interferers = [];
    for (const [receiver, loss] of losses)
      for (const node of loss.interferers) this.interferers.push({ node, receiver });
    this.element.replaceChildren(...describe(this.replay, frame, node, losses, this.close));
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
  chosen: number | null,
  losses: ReadonlyMap<number, Loss>,
  close: () => void,
): HTMLElement[] {
  const { table } = frame.chunk.frames;
  const sender = senderOf(frame);
  const kind = replay.run.kinds[table.kind[frame.row]];
  const facts = [
    `${kind}, ${causeText(replay, frame)}`,
    `at ${Number(timeText(startOf(frame), 9))} s for ${durationText(table.duration_ns[frame.row])}`,
    `${table.bytes[frame.row]} bytes${bitrateText(table.bitrate_bps[frame.row])}`,
  ];
  const noticed = frame.chunk.frames.receptions(frame.row);
  if (chosen !== null && replay.isUnnoticedAt(chosen, frame))
    noticed.push({ receiver: chosen, outcome: replay.unnoticed });
  // The chosen node first, then losses of which more is known, then other losses.
  const rank = ({ receiver, outcome }: Reception): number =>
    receiver === chosen ? 3 : losses.has(receiver) ? 2 : Number(replay.isLost[outcome]);
  const receptions = noticed
    .map((reception) => ({ ...reception, distance: distance(replay, frame, reception.receiver) }))
    .sort((a, b) => rank(b) - rank(a) || a.distance - b.distance);
  const body = make("tbody");
  for (const { receiver, outcome, distance: meters } of receptions) {
    const name = replay.run.outcomes[outcome];
    const loss = losses.get(receiver);
    const words = make("span", { class: replay.isLost[outcome] ? "badge lost" : "badge" }, outcomeWords(name));
    words.style.setProperty("--color", outcomeColor(name));
    const cells = [[replay.nameOf(receiver)], [words], [distanceText(meters)]];
    body.append(make("tr", {}, ...cells.map((cell) => make("td", {}, ...cell))));
    const by = loss?.interferers.map(
      (other) => `${replay.nameOf(other)} (${distanceText(between(replay, frame, other, receiver))})`,
    );
    const others = by?.length ? `with ${by.join(", ")}${strengthText(loss?.interference)}` : "";
    const reason = [`power${strengthText(loss?.power)}`, others].filter((part) => part && part !== "power").join(", ");
    if (reason) body.append(make("tr", {}, make("td", { class: "muted", colspan: "3" }, reason)));
  }
  const heads = ["at", "outcome", "distance"].map((head) => make("th", {}, head));
  const unnoticed = table.unnoticed[frame.row];
  return [
    make(
      "div",
      { class: "row" },
      make("h2", {}, `${replay.nameOf(sender)} → ${destinationText(replay, frame)}`),
      make("span", { class: "end" }, button("✕", "Close (Esc)", close)),
    ),
    make("p", { class: "message" }, facts.join(" · ")),
    ...(replay.isInAir(frame) ? [make("p", { class: "message" }, "In the air at the end.")] : []),
    ...(unnoticed ? [make("p", { class: "message" }, unnoticedText(replay, unnoticed))] : []),
    make("table", {}, make("thead", {}, make("tr", {}, ...heads)), body),
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

function unnoticedText(replay: Replay, count: number): string {
  const words = outcomeWords(replay.run.outcomes[replay.unnoticed]);
  return `${count} ${count === 1 ? "other" : "others"} did not notice it (${words}).`;
}

/** Prototype mode has no bit rates. */
function bitrateText(bitrateBps: number): string {
  return bitrateBps ? ` at ${(bitrateBps / 1e6).toLocaleString("en-US")} Mbit/s` : "";
}

/** ": -83.8 dBm"; "" if it is not known. */
function strengthText(power: number | undefined): string {
  return power === undefined || power === NO_POWER ? "" : `: ${(power / 100).toFixed(1)} dBm`;
}
