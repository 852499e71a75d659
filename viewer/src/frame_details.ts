// The chosen frame: what became of it where, who interfered.

import { Interferer } from "./air";
import { outcomeColor } from "./colors";
import { button, countText, distanceText, durationText, make, timeText } from "./dom";
import { causeText, messageOf, outcomeWords, routeText, senderOf } from "./frame_text";
import { between, farTexts, Loss, lossTexts, readLosses } from "./losses";
import { Reception } from "./receptions";
import { Frame, Replay, startOf } from "./replay";

/** Of the nodes that a frame did not reach because of the distance. */
const MOST_FAR = 5;

/** Of a message. */
const SHOWN_CHARACTERS = 200;

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
    const losses = await readLosses(this.replay, frame);
    if (this.frame !== frame || this.node !== node) return;
    this.interferers = [];
    for (const [receiver, loss] of losses)
      for (const { node } of loss.interferers) this.interferers.push({ node, receiver });
    this.element.replaceChildren(...describe(this.replay, frame, node, losses, this.close));
  }
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
  const has = (node: number): boolean => noticed.some(({ receiver }) => receiver === node);
  const far = new Set(replay.unnoticedBy(frame, MOST_FAR).filter((node) => !has(node)));
  if (chosen !== null && !has(chosen) && replay.isUnnoticedAt(chosen, frame)) far.add(chosen);
  for (const receiver of far) noticed.push({ receiver, outcome: replay.unnoticed });
  // The chosen node first, then losses of which more is known, then other losses.
  const rank = ({ receiver, outcome }: Reception): number =>
    receiver === chosen ? 4 : losses.has(receiver) ? 3 : far.has(receiver) ? 0 : 1 + Number(replay.isLost[outcome]);
  const receptions = noticed
    .map((reception) => ({ ...reception, distance: between(replay, frame, sender, reception.receiver) }))
    .sort((a, b) => rank(b) - rank(a) || a.distance - b.distance);
  const body = make("tbody");
  for (const { receiver, outcome, distance: meters } of receptions) {
    const name = replay.run.outcomes[outcome];
    const loss = losses.get(receiver);
    const isLost = replay.isLost[outcome] && !far.has(receiver);
    const words = make("span", { class: isLost ? "badge lost" : "badge" }, outcomeWords(name));
    words.style.setProperty("--color", outcomeColor(name));
    const cells = [[replay.nameOf(receiver)], [words], [distanceText(meters)]];
    body.append(make("tr", {}, ...cells.map((cell) => make("td", {}, ...cell))));
    const texts = loss ? lossTexts(replay, frame, receiver, loss) : [];
    if (far.has(receiver)) texts.push(...farTexts(replay, frame, receiver));
    for (const text of texts)
      body.append(make("tr", {}, make("td", { class: "muted", colspan: "3" }, text)));
  }
  const heads = ["at", "outcome", "distance"].map((head) => make("th", {}, head));
  const shown = noticed.filter(({ outcome }) => outcome === replay.unnoticed).length;
  const unnoticed = table.unnoticed[frame.row] - shown;
  return [
    make(
      "div",
      { class: "row" },
      make("h2", {}, routeText(replay, frame)),
      make("span", { class: "end" }, button("✕", "Close (Esc)", close)),
    ),
    make("p", { class: "message" }, facts.join(" · ")),
    ...describeMessage(frame),
    ...(replay.isInAir(frame) ? [make("p", { class: "message" }, "In the air at the end.")] : []),
    ...(unnoticed ? [make("p", { class: "message" }, unnoticedText(replay, unnoticed))] : []),
    make("table", {}, make("thead", {}, make("tr", {}, ...heads)), body),
  ];
}

/** The beginning of the message, and a button that shows what else is recorded of it. */
function describeMessage(frame: Frame): HTMLElement[] {
  const { chunk, row } = frame;
  if (chunk.texts.isLeftOut(chunk.frames.table.text[row]))
    return [make("p", { class: "message" }, "Its text was not recorded: this part of the run has too many.")];
  const message = messageOf(frame);
  if (message === null) return [];
  const { text, bytes, isWhole } = message;
  const rest = isWhole ? "" : ` … (${countText(bytes)} bytes; the record has their beginning)`;
  const shown = make("p", { class: "text" }, text.slice(0, SHOWN_CHARACTERS));
  if (text.length <= SHOWN_CHARACTERS) {
    shown.append(rest);
    return [shown];
  }
  const more = button("… Show all", "Show the rest of the message", () => {
    shown.textContent = text + rest;
    more.remove();
  });
  return [shown, more];
}

function unnoticedText(replay: Replay, count: number): string {
  const words = outcomeWords(replay.run.outcomes[replay.unnoticed]);
  return `${count} ${count === 1 ? "other" : "others"} did not notice it (${words}).`;
}

/** Prototype mode has no bit rates. */
function bitrateText(bitrateBps: number): string {
  return bitrateBps ? ` at ${(bitrateBps / 1e6).toLocaleString("en-US")} Mbit/s` : "";
}
