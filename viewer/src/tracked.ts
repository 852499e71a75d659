// The tracked variables of the chosen node and of the pinned ones: a chart for each name, a curve for each node.

import { Charts, Curve } from "./charts";
import { groupColor } from "./colors";
import { Actions } from "./controls";
import { button, make, timeText } from "./dom";
import { Replay } from "./replay";
import { setText } from "./rows";
import { Store } from "./state";
import { History, noHistory, readOn } from "./variables";

export class Tracked {
  readonly element = make("div", {});
  /** Pins the chosen node. */
  readonly pin: HTMLButtonElement;
  private readonly title = make("h3", {});
  private readonly legend = make("p", { class: "legend" });
  private readonly note = make("p", { class: "message" });
  private readonly charts: Charts;
  private histories = new Map<number, History>();
  private shown: Map<number, History> | null = null;
  private isReading = false;

  constructor(
    private readonly replay: Replay,
    private readonly store: Store,
    private readonly page: Required<Pick<Actions, "seek" | "pin">>,
  ) {
    this.pin = button("Pin", "Keep the variables and the lane of this node (k)", () => page.pin());
    this.charts = new Charts((timeNs) => page.seek(timeNs), (timeS) => setText(this.title, `Tracked variables at ${timeText(timeS * 1e9, 3)} s`));
    this.element.append(this.title, this.legend, this.note, this.charts.element);
    store.onChange((changed) => {
      if (!("node" in changed || "pinned" in changed)) return;
      const { node, pinned } = store.now;
      this.histories = new Map(this.nodes.map((one) => [one, this.histories.get(one) ?? noHistory(one)]));
      this.element.hidden = !this.nodes.length;
      this.pin.hidden = node === null;
      this.pin.setAttribute("aria-pressed", String(node !== null && pinned.includes(node)));
      this.legend.replaceChildren(...(pinned.length ? this.nodes : []).map((one, index) => this.nameOf(one, index)));
      void this.read();
    });
  }

  /** What is read of the chosen node. */
  get history(): History | undefined {
    return this.histories.get(this.store.now.node ?? NaN);
  }

  update(timeNs: number): void {
    void this.read();
    this.charts.moveTo(timeNs / 1e9);
  }

  /** Pinned nodes first, so that each keeps its color. */
  private get nodes(): number[] {
    const { node, pinned } = this.store.now;
    return [...new Set([...pinned, ...(node === null ? [] : [node])])];
  }

  private nameOf(node: number, index: number): HTMLElement {
    const name = this.replay.nameOf(node);
    const isPinned = this.store.now.pinned.includes(node);
    const { color, dash } = lineOf(index);
    const line = make("i", dash ? { class: "dashed" } : {});
    const element = make("span", {}, line, name, ...(isPinned ? [button("✕", `Unpin ${name}`, () => this.page.pin(node))] : []));
    element.style.setProperty("--color", color());
    return element;
  }

  /** Read what is not read yet: all, or what came of a run that goes on. */
  private async read(): Promise<void> {
    if (this.isReading) return;
    const { histories } = this;
    const missing = [...histories.values()].filter(({ chunks }) => chunks < this.replay.chunks.length);
    if (missing.length || this.shown !== histories) {
      this.isReading = true;
      setText(this.note, missing.some(({ chunks }) => !chunks) ? "Reading …" : "");
      for (const history of missing) await readOn(this.replay, history, () => this.histories === histories);
      this.isReading = false;
      if (this.histories !== histories) return this.read();
      this.shown = histories;
      this.show();
      this.store.set({});
    }
  }

  private show(): void {
    const byName = new Map<string, Curve[]>();
    this.nodes.forEach((node, index) => {
      for (const series of this.histories.get(node)?.series.values() ?? []) {
        const curves = byName.get(series.name) ?? [];
        byName.set(series.name, curves);
        curves.push({ series, ...lineOf(index), node: this.replay.nameOf(node) });
      }
    });
    setText(this.note, byName.size || !this.nodes.length ? "" : "There are none.");
    this.charts.show(byName, this.replay.endNs / 1e9);
  }
}

/** The line of a node: five colors, those next to each other far apart, and then the same ones dashed. */
function lineOf(index: number): { color: () => string; dash: boolean } {
  return { color: () => groupColor(index * 4), dash: index % 10 >= 5 };
}
