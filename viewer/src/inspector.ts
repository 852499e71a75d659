// What is known of the chosen node, or of all nodes, at the time of the clock.

import { paintOutcome } from "./colors";
import { Actions, nodeChoice } from "./controls";
import { countText, distanceText, make, shareText, timeText } from "./dom";
import { outcomeWords } from "./frame_text";
import { Replay } from "./replay";
import { setText, showRows } from "./rows";
import { Store } from "./state";
import { countUntil } from "./tables";
import { Tracked } from "./tracked";

const MOST_NEIGHBORS = 12;
const MOST_EVENTS = 12;

export class Inspector {
  readonly element = make("section", { "aria-label": "Inspector" });
  private readonly facts = make("p", { class: "message" });
  private readonly outcomesTitle = make("h3", { class: "of-frames" });
  private readonly outcomes = make("div", { class: "outcomes of-frames" });
  private readonly outcomesNote = make("p", { class: "message of-frames" });
  private readonly tracked: Tracked;
  private readonly ofNode = make("div", {});
  private readonly neighbors = make("div", { class: "list" });
  private readonly neighborsTitle = make("h3", {});
  private readonly events = make("div", { class: "list of-frames" });
  private readonly eventsTitle = make("h3", { class: "of-frames" }, "Events");

  constructor(
    private readonly replay: Replay,
    private readonly store: Store,
    page: Required<Pick<Actions, "seek" | "pin">>,
  ) {
    this.tracked = new Tracked(replay, store, page);
    for (const list of [this.neighbors, this.events])
      list.addEventListener("click", (event) => {
        const { node, time } = (event.target as Element).closest<HTMLElement>("button")?.dataset ?? {};
        if (node) store.set({ node: Number(node) });
        if (time) page.seek(Number(time));
      });
    this.ofNode.append(
      this.neighborsTitle,
      this.neighbors,
      this.eventsTitle,
      this.events,
    );
    this.element.append(
      make("div", { class: "row" }, make("h2", {}, "Node"), nodeChoice(replay.run.nodes, store), this.tracked.pin),
      this.facts,
      this.outcomesTitle,
      this.outcomes,
      this.outcomesNote,
      this.tracked.element,
      this.ofNode,
    );
    store.onChange((changed) => {
      if ("node" in changed) this.ofNode.hidden = changed.node == null;
    });
  }

  update(timeNs: number, positions: Float64Array): void {
    const { node } = this.store.now;
    this.showOutcomes(timeNs, node);
    this.tracked.update(timeNs);
    if (node === null) {
      const more = this.replay.hasFrames ? ", neighbors and events" : " and neighbors";
      setText(this.facts, `Click a node, or choose one here, to see its variables${more}.`);
      return;
    }
    const [x, y, z] = positions.subarray(node * 3, node * 3 + 3);
    const { group, protocol, id, range_m } = this.replay.nodes.get(node)!;
    const position = [x, y, z].map((value) => value.toFixed(1)).join(", ");
    const range = range_m === null ? "" : ` · range ${distanceText(range_m)}`;
    const names = [...new Set([group, protocol])].join(" · ");
    setText(this.facts, `id ${id} · ${names}${range} · at (${position}) m`);
    this.showNeighbors(node, positions);
    this.showEvents(timeNs);
  }

  private showOutcomes(timeNs: number, node: number | null): void {
    const { outcomes, recorded } = this.replay.run;
    const whole = timeNs === 0 ? this.replay.whole : null;
    const tally = whole ?? this.replay.tally(timeNs);
    setText(this.outcomesTitle, whole ? "Outcomes of the whole run" : "Outcomes so far");
    const sums = tally.sums(node);
    const unnoticed = tally.unnoticedAt(node);
    const total = sums.reduce((a, b) => a + b, 0);
    const rows = outcomes.map((name, outcome) => ({ name, count: sums[outcome] })).filter((row) => row.count);
    const isMissing = node !== null && recorded !== null && !recorded.includes(node);
    const whose = node === null ? "" : " at this node";
    const share = unnoticed === null ? ", those not noticed not counted" : "";
    setText(
      this.outcomesNote,
      isMissing
        ? "The receptions of this node were not recorded."
        : `Frames: ${countText(tally.frames)}. Receptions${whose}: ${countText(total)}${share}.`,
    );
    showRows(
      this.outcomes,
      rows.sort((a, b) => b.count - a.count),
      () => make("div", { class: "row outcome" }, make("i"), make("span"), make("span", { class: "end" })),
      (element, { name, count }) => {
        setText(element.children[1], outcomeWords(name));
        setText(element.children[2], `${countText(count)} · ${shareText(count / total)}`);
        paintOutcome(element, name);
        element.style.setProperty("--share", `${(100 * count) / total}%`);
      },
    );
  }

  private showNeighbors(node: number, positions: Float64Array): void {
    const { range_m } = this.replay.nodes.get(node)!;
    const distances = [...this.replay.nodes.keys()]
      .filter((other) => other !== node)
      .map((other) => ({
        other,
        distance: Math.hypot(...[0, 1, 2].map((axis) => positions[other * 3 + axis] - positions[node * 3 + axis])),
      }))
      .filter(({ distance }) => range_m === null || distance <= range_m)
      .sort((a, b) => a.distance - b.distance);
    setText(
      this.neighborsTitle,
      range_m === null ? "Nearest nodes" : `In range (${distanceText(range_m)}): ${distances.length}`,
    );
    showRows(this.neighbors, distances.slice(0, MOST_NEIGHBORS), listButton, (element, { other, distance }) => {
      element.dataset.node = String(other);
      setText(element.children[0], this.replay.nameOf(other));
      setText(element.children[1], distanceText(distance));
    });
  }

  private showEvents(timeNs: number): void {
    const events = this.tracked.history?.events ?? [];
    const until = countUntil(
      events.map((event) => event.timeNs),
      timeNs,
    );
    setText(this.eventsTitle, `Events so far: ${countText(until)}`);
    const last = events.slice(Math.max(0, until - MOST_EVENTS), until).reverse();
    showRows(this.events, last, listButton, (element, { timeNs: atNs, kind, text }) => {
      element.dataset.time = String(atNs);
      element.dataset.kind = kind;
      setText(element.children[0], `${kind}: ${text}`);
      setText(element.children[1], `${timeText(atNs, 3)} s`);
    });
  }
}

function listButton(): HTMLButtonElement {
  return make("button", { type: "button" }, make("span"), make("span", { class: "end" }));
}
