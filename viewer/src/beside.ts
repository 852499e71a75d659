// The page of several replays side by side: one clock, one set of controls, and their outcomes in one table.
// The page reads the replays as data: it does not run their scripts, and exchanges no messages with other pages.

import { subtitleOf, titleOf, warningOf } from "./about";
import { Stage } from "./capture";
import { paintOutcome } from "./colors";
import { nodeChoice } from "./controls";
import { countText, make, shareText } from "./dom";
import { outcomeWords } from "./frame_text";
import { Page } from "./page";
import { Frame, Replay, startOf } from "./replay";
import { setText, showRows } from "./rows";
import { fileSource, openSocket } from "./source";
import { State } from "./state";
import { findStep, Goal } from "./steps";
import { Shared, View } from "./view";

/** What a page with several replays holds. */
export interface Files {
  /** Path of the WebSocket that tells the server that the page is open. */
  socket: string;
  /** {address: name of the file}. */
  replays: Record<string, string>;
}

/** Load replays and show them. */
export async function showBeside({ socket, replays }: Files): Promise<Beside> {
  openSocket(socket);
  const files = Object.entries(replays).map(async ([address, name]) => {
    try {
      return { address, name, replay: await replayAt(address) };
    } catch (error) {
      throw new Error(`${name}: ${(error as Error).message}`);
    }
  });
  return new Beside(await Promise.all(files));
}

async function replayAt(address: string): Promise<Replay> {
  const response = await fetch(address);
  if (!response.ok) throw new Error("the file cannot be read anymore");
  const text = await response.text();
  const data = text.slice(text.indexOf("</style>") + 1); // Its styles would be reported, as they are not of this page.
  const source = fileSource(new DOMParser().parseFromString(data, "text/html"));
  if (source === null) throw new Error("it holds no run");
  return new Replay(source);
}

/** One of the replays, with its title and its chosen frame. */
class Part extends View {
  readonly link: HTMLAnchorElement;
  readonly element: HTMLElement;
  readonly chosen: HTMLElement;
  frame: Frame | null = null;

  constructor(
    replay: Replay,
    readonly title: string,
    readonly address: string,
    beside: Beside,
    shared: Shared,
  ) {
    super(replay, `The nodes of ${title} in space`, beside, shared);
    this.link = make("a", { target: "_blank", title: `Show this replay alone: ${subtitleOf(replay)}` }, title);
    const warning = make("p", { class: "mistake" }, warningOf(replay));
    const stage = make("div", { class: "stage" }, this.canvas, this.labels);
    this.element = make("section", {}, make("h2", {}, this.link), warning, stage, this.timeline.element);
    this.chosen = make("div", { hidden: "" }, make("h3", {}, title), this.details.element);
    this.overlay.onClick(this.canvas, (node) => beside.chooseName(node === null ? null : replay.nameOf(node)));
    for (const type of ["pointerdown", "wheel"])
      this.canvas.addEventListener(type, () => beside.lead(this), { capture: true, passive: true });
  }

  idOf(name: string | null): number | null {
    return this.replay.run.nodes.find((node) => node.name === name)?.id ?? null;
  }

  find(goal: Goal, direction: 1 | -1, timeNs: number, name: string | null): Promise<Frame | null> {
    const node = this.idOf(name);
    if (typeof goal === "object" && node === null) return Promise.resolve(null);
    const here = typeof goal === "object" && node !== null ? { node } : goal;
    return findStep(this.replay, here, this.filter, this.frame ?? timeNs, direction);
  }

  async choose(frame: Frame | null, name: string | null): Promise<void> {
    this.frame = frame;
    this.chosen.hidden = frame === null;
    await this.details.read(frame, this.idOf(name));
  }
}

export class Beside extends Page {
  readonly ready: Promise<void>;
  readonly views: Part[];
  protected leader: Part;
  private readonly tableTitle = make("h3");
  private readonly rows = make("tbody");

  /** `State.node` is an index into the names of all nodes. */
  constructor(files: { address: string; name: string; replay: Replay }[]) {
    const replays = files.map(({ replay }) => replay);
    const all = replays.flatMap(({ run }) => run.nodes);
    super(replays, [...new Set(all.map(({ name }) => name))].map((name, id) => ({ id, name })));
    const groups = [...new Set(all.map(({ group }) => group))];
    const titles = titlesOf(files);
    const window = { fromNs: 0, toNs: 0 };
    this.views = files.map(({ replay, address }, index) => {
      const legendOf = index === 0 ? replays : [];
      return new Part(replay, titles[index], address, this, { groups, window, legendOf });
    });
    this.leader = this.views[0];
    const heads = ["", ...titles, ...(titles.length === 2 ? ["difference"] : [])].map((head) => make("th", {}, head));
    const comparison = make(
      "section",
      { "aria-label": "Comparison" },
      make("div", { class: "row" }, make("h2", {}, "Node"), nodeChoice(this.nodes, this.store)),
      this.tableTitle,
      make("table", { class: "differences" }, make("thead", {}, make("tr", {}, ...heads)), this.rows),
      ...this.views.map(({ chosen }) => chosen),
    );
    document.title = `${titles.join(" | ")} – gradysim replays`;
    document.body.classList.add("beside");
    this.layOut(
      [...new Set(replays.map(({ run }) => run.file))].join(", "),
      [],
      [make("main", { class: "views" }, ...this.views.map(({ element }) => element)), make("aside", {}, comparison)],
    );
    this.clock.grow(Math.max(...replays.map(({ endNs }) => endNs)), false);
    this.ready = this.open();
  }

  /** Let the other views look from where this one does. */
  lead(view: Part): void {
    this.leader = view;
  }

  /** Step to the next frame of any replay; those of several replays that begin at once are one step. */
  async step(goal: Goal, direction: 1 | -1): Promise<void> {
    this.clock.isPlaying = false;
    const { timeNs } = this.clock;
    const found = await Promise.all(this.views.map((view) => view.find(goal, direction, timeNs, this.name)));
    const times = found.map((frame) => (frame === null ? direction * Infinity : startOf(frame)));
    const next = direction > 0 ? Math.min(...times) : Math.max(...times);
    if (!Number.isFinite(next)) return;
    this.clock.seek(next);
    this.choose(found.map((frame, index) => (times[index] === next ? frame : null)));
  }

  chooseName(name: string | null): void {
    this.store.set({ node: this.nodes.find((node) => node.name === name)?.id ?? null });
  }

  override zoom(): void {
    this.leader = this.views.find(({ frame }) => frame !== null) ?? this.leader;
    super.zoom();
  }

  focusFilter(): void {}

  protected stages(): Stage[] {
    return this.views;
  }

  protected stateOf(view: Part): Readonly<State> {
    return { ...this.store.now, node: view.idOf(this.name), frame: view.frame };
  }

  protected clearFrame(): void {
    if (this.views.some(({ frame }) => frame !== null)) this.choose([]);
  }

  protected readFrame(): void {
    this.choose(this.views.map(({ frame }) => frame));
  }

  protected showMistake(message: string): void {
    setText(this.warning, message);
  }

  protected drawViews(): void {
    const { leader } = this;
    leader.draw(this.clock, this.stateOf(leader));
    for (const view of this.views) {
      if (view === leader) continue;
      view.scene.lookAs(leader.scene);
      view.draw(this.clock, { ...this.stateOf(view), isFollowing: false });
    }
  }

  protected drawTexts(): void {
    const { timeNs, isPlaying } = this.clock;
    setText(this.tableTitle, timeNs === 0 ? "Outcomes of the whole runs" : "Outcomes so far");
    this.showTable(timeNs === 0);
    if (isPlaying) return;
    this.writeAddress();
    const hash = new URLSearchParams({ t: String(timeNs / 1e9), ...(this.name === null ? {} : { node: this.name }) });
    for (const { link, address } of this.views) link.href = `${address}#${hash}`;
  }

  /** Name of the chosen node. */
  private get name(): string | null {
    const { node } = this.store.now;
    return node === null ? null : this.nodes[node].name;
  }

  private choose(frames: (Frame | null)[]): void {
    this.views.forEach((view, index) => {
      void view.choose(frames[index] ?? null, this.name).then(() => this.redraw());
    });
    this.redraw();
  }

  /** Frames, receptions and receptions by outcome; at the chosen node, if there is one. */
  private showTable(isWhole: boolean): void {
    const columns = this.views.map((view) => {
      const { replay } = view;
      const tally = (isWhole ? replay.whole : null) ?? replay.tally(view.timeOf(this.clock));
      const id = view.idOf(this.name);
      const sums = this.name !== null && id === null ? [] : tally.sums(id);
      return {
        frames: tally.frames,
        total: sums.reduce((a, b) => a + b, 0),
        outcomes: new Map(replay.run.outcomes.map((name, outcome) => [name, sums[outcome] ?? 0])),
      };
    });
    const names = new Set(columns.flatMap(({ outcomes }) => [...outcomes.keys()]));
    const outcomes = [...names]
      .map((name) => ({ name, counts: columns.map((column) => column.outcomes.get(name) ?? 0) }))
      .filter(({ counts }) => counts.some(Boolean))
      .sort((a, b) => Math.max(...b.counts) - Math.max(...a.counts));
    const sums = [
      { name: "receptions", counts: columns.map(({ total }) => total) },
      { name: "frames", counts: columns.map(({ frames }) => frames) },
    ];
    const columnsOf = (counts: number[]): string[] =>
      counts.length === 2 ? [...counts.map(countText), differenceText(counts[1] - counts[0])] : counts.map(countText);
    const cells = (): HTMLElement[] => columnsOf(this.views.map(() => 0)).map(() => make("td"));
    showRows(
      this.rows,
      [...outcomes, ...sums],
      () => make("tr", {}, make("th", {}, make("i"), make("span")), ...cells()),
      (row, { name, counts }) => {
        row.classList.toggle("sum", !names.has(name));
        paintOutcome(row, name);
        setText(row.children[0].children[1], outcomeWords(name));
        for (const [index, text] of columnsOf(counts).entries()) setText(row.children[index + 1], text);
        counts.forEach((count, index) => {
          (row.children[index + 1] as HTMLElement).title = shareText(count / columns[index].total);
        });
      },
    );
  }
}

function differenceText(difference: number): string {
  return `${difference > 0 ? "+" : ""}${countText(difference).replace("-", "−")}`;
}

/** Configuration, run and mode, as far as they differ; the names of the files if that does not tell runs apart. */
function titlesOf(files: { replay: Replay; name: string }[]): string[] {
  const parts = files.map(({ replay }) => [titleOf(replay), replay.run.mode]);
  const differs = [0, 1].map((part) => new Set(parts.map((one) => one[part])).size > 1);
  const titles = parts.map((one) => one.filter((_, part) => differs[part]).join(" · "));
  return new Set(titles).size === files.length ? titles : files.map(({ name }) => name);
}
