// Several replays side by side: one clock, one set of controls, and their outcomes in one table.
// The page reads the replays as data: it does not run their scripts, and exchanges no messages with other pages.

import { runDialog, subtitleOf, titleOf, warningOf } from "./about";
import { Address, readAddress } from "./address";
import { SLANT } from "./camera";
import { Capture } from "./capture";
import { Clock, speedFor } from "./clock";
import { outcomeColor, outcomeDash, outcomeWords } from "./colors";
import { Actions, Controls } from "./controls";
import { countText, make, shareText } from "./dom";
import { Filter, parseFilter } from "./filter";
import { FrameDetails } from "./frame_details";
import { keysDialog, listenToKeys } from "./keys";
import { Overlay } from "./overlay";
import { Frame, Replay, startOf } from "./replay";
import { setText, showRows } from "./rows";
import { Scene, TRAIL_S } from "./scene";
import { fileSource, openSocket } from "./source";
import { State, Store } from "./state";
import { findStep, Goal } from "./steps";
import { Timeline, Window } from "./timeline";

const TEXTS_MS = 160;

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
    const text = await (await fetch(address)).text();
    const data = text.slice(text.indexOf("</style>") + 1); // Its styles would be reported, as they are not of this page.
    const source = fileSource(new DOMParser().parseFromString(data, "text/html"));
    if (source === null) throw new Error(`${name} holds no run`);
    return { address, name, replay: new Replay(source) };
  });
  return new Beside(await Promise.all(files));
}

/** One of the replays: its picture, its timeline and its chosen frame. */
class View {
  readonly stage: HTMLElement;
  readonly link: HTMLAnchorElement;
  readonly element: HTMLElement;
  readonly chosen: HTMLElement;
  readonly scene: Scene;
  readonly details: FrameDetails;
  filter: Filter;
  frame: Frame | null = null;
  private readonly overlay: Overlay;
  private readonly timeline: Timeline;

  constructor(
    readonly replay: Replay,
    readonly title: string,
    readonly address: string,
    groups: readonly string[],
    window: Window,
    legendOf: readonly Replay[],
    private readonly beside: Beside,
  ) {
    const redraw = (): void => beside.redraw();
    const canvas = make("canvas", { class: "scene", tabindex: "0", "aria-label": `The nodes of ${title} in space` });
    const labels = make("canvas", { class: "labels", "aria-hidden": "true" });
    this.stage = make("div", { class: "stage" }, canvas, labels);
    this.timeline = new Timeline(replay, (timeNs) => beside.seek(timeNs), redraw, window);
    this.link = make("a", { target: "_blank", title: `Show this replay alone: ${subtitleOf(replay)}` }, title);
    const warning = make("p", { class: "mistake" }, warningOf(replay));
    this.element = make("section", {}, make("h2", {}, this.link), warning, this.stage, this.timeline.element);
    this.scene = new Scene(canvas, replay, redraw, groups);
    this.overlay = new Overlay(labels, replay, this.scene, legendOf);
    this.overlay.onClick(canvas, (node) => beside.chooseName(node === null ? null : replay.nameOf(node)));
    this.details = new FrameDetails(replay, () => beside.clearChoice());
    this.chosen = make("div", { hidden: "" }, make("h3", {}, title), this.details.element);
    this.filter = parseFilter("", replay);
    for (const type of ["pointerdown", "wheel"])
      canvas.addEventListener(type, () => beside.lead(this), { capture: true, passive: true });
    new ResizeObserver(redraw).observe(canvas);
  }

  idOf(name: string | null): number | null {
    return this.replay.run.nodes.find((node) => node.name === name)?.id ?? null;
  }

  /** Of a run that is over, the end is shown. */
  timeOf({ timeNs }: Clock): number {
    return Math.min(timeNs, this.replay.endNs);
  }

  find(goal: Goal, direction: 1 | -1, { timeNs }: Clock, name: string | null): Promise<Frame | null> {
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

  draw(clock: Clock, shared: Readonly<State>, name: string | null): void {
    const { replay, filter, details } = this;
    const timeNs = this.timeOf(clock);
    const state = { ...shared, node: this.idOf(name), frame: this.frame };
    const positions = replay.positions(timeNs);
    const look = replay.look(timeNs);
    this.scene.draw({ timeNs, speed: clock.speed, positions, state, look, filter, interferers: details.interferers });
    this.overlay.draw(timeNs, positions, state, look);
    this.timeline.draw(clock.timeNs);
    const missing = replay.missingBefore(timeNs, Math.max(0, timeNs - TRAIL_S * 1e9));
    if (missing !== null) void replay.loadChunk(missing).then(() => this.beside.redraw());
  }
}

export class Beside implements Actions {
  readonly ready: Promise<void>;
  readonly views: View[];
  private readonly clock = new Clock(false);
  private readonly store = new Store();
  private readonly controls = new Controls(this.clock, this.store, this);
  /** The nodes of all replays, by name. `State.node` is an id of these. */
  private readonly nodes: { id: number; name: string }[];
  private readonly choice = make("select", { "aria-label": "Node", title: "Choose a node" });
  private readonly tableTitle = make("h3");
  private readonly rows = make("tbody");
  private readonly dialogs: { run: HTMLDialogElement; keys: HTMLDialogElement };
  private readonly message = make("p", { class: "mistake" });
  private readonly capture: Capture;
  private readonly address: Address;
  /** The view that was moved last: the others look from the same place. */
  private leader: View;
  private isDirty = true;
  private areTextsOld = true;
  private lastTickMs = 0;
  private lastTextsMs = 0;

  constructor(files: { address: string; name: string; replay: Replay }[]) {
    const replays = files.map(({ replay }) => replay);
    const all = replays.flatMap(({ run }) => run.nodes);
    this.nodes = [...new Set(all.map(({ name }) => name))].map((name, id) => ({ id, name }));
    const groups = [...new Set(all.map(({ group }) => group))];
    const titles = titlesOf(files);
    const range = { fromNs: 0, toNs: 0 };
    this.views = files.map(({ replay, address }, place) => {
      const legendOf = place === 0 ? replays : [];
      return new View(replay, titles[place], address, groups, range, legendOf, this);
    });
    this.leader = this.views[0];
    this.dialogs = { run: runDialog(replays), keys: keysDialog() };
    this.address = new Address({ nameOf: (node) => this.nodes[node].name, chunks: [] });
    this.capture = new Capture(
      () => this.views.map(({ stage, title }) => ({ stage, title })),
      this.clock,
      () => this.drawNow(),
      (text) => setText(this.message, text),
    );
    this.layOut(titles);
    this.clock.grow(Math.max(...replays.map(({ endNs }) => endNs)), false);
    this.store.onChange((changed) => {
      if (changed.isFollowing && this.store.now.node === null) this.chooseNode(1);
      if ("node" in changed) this.choose(this.views.map(({ frame }) => frame));
      this.redraw();
    });
    listenToKeys(this.controls, this, this.clock);
    window.addEventListener("hashchange", () => this.goToAddress());
    this.ready = this.open();
  }

  redraw(): void {
    this.isDirty = true;
  }

  /** Let the other views look from where this one does. */
  lead(view: View): void {
    this.leader = view;
  }

  seek(timeNs: number): void {
    this.clock.seek(timeNs);
    if (this.hasFrame) this.choose([]);
    this.redraw();
  }

  async show(timeNs: number): Promise<void> {
    this.seek(timeNs);
    await this.drawNow();
  }

  playOrPause(): void {
    this.clock.toggle();
    this.redraw();
  }

  setSpeed(speed: number): void {
    this.clock.speed = speed;
    this.redraw();
  }

  /** Step to the next frame of any replay; those of several replays that begin at once are one step. */
  async step(goal: Goal, direction: 1 | -1): Promise<void> {
    this.clock.isPlaying = false;
    const found = await Promise.all(this.views.map((view) => view.find(goal, direction, this.clock, this.name)));
    const times = found.map((frame) => (frame === null ? direction * Infinity : startOf(frame)));
    const next = direction > 0 ? Math.min(...times) : Math.max(...times);
    if (!Number.isFinite(next)) return;
    this.clock.seek(next);
    this.choose(found.map((frame, place) => (times[place] === next ? frame : null)));
  }

  stepOfNode(direction: 1 | -1): void {
    const { node } = this.store.now;
    if (node !== null) void this.step({ node }, direction);
  }

  chooseName(name: string | null): void {
    this.store.set({ node: this.nodes.find((node) => node.name === name)?.id ?? null });
  }

  chooseNode(direction: 1 | -1): void {
    const { length } = this.nodes;
    const place = this.store.now.node ?? (direction > 0 ? -1 : length);
    this.store.set({ node: (place + direction + length) % length });
  }

  clearChoice(): void {
    if (this.hasFrame) this.choose([]);
    else this.store.set({ node: null, isFollowing: false });
  }

  showAll(): void {
    this.store.set({ isFollowing: false });
    this.leader.scene.fit(this.views.flatMap((view) => [...view.replay.positions(view.timeOf(this.clock))]));
  }

  zoom(): void {
    this.leader = this.views.find(({ frame }) => frame !== null) ?? this.leader;
    const { scene, frame, details } = this.leader;
    const node = this.leader.idOf(this.name);
    if (!scene.zoomIn(this.leader.timeOf(this.clock), frame, details.interferers, node)) this.showAll();
    this.redraw();
  }

  toggleTop(): void {
    this.leader.scene.camera.toggleTop();
    this.redraw();
  }

  focusFilter(): void {}

  showRun(): void {
    this.dialogs.run.showModal();
  }

  showKeys(): void {
    this.dialogs.keys.showModal();
  }

  savePicture(): void {
    void this.capture.save();
  }

  toggleFilm(): void {
    void this.capture.toggleFilm();
  }

  get isRecording(): boolean {
    return this.capture.isRecording;
  }

  /** Name of the chosen node. */
  private get name(): string | null {
    const { node } = this.store.now;
    return node === null ? null : this.nodes[node].name;
  }

  private get hasFrame(): boolean {
    return this.views.some(({ frame }) => frame !== null);
  }

  private choose(frames: (Frame | null)[]): void {
    this.views.forEach((view, place) => {
      void view.choose(frames[place] ?? null, this.name).then(() => this.redraw());
    });
    this.redraw();
  }

  private layOut(titles: string[]): void {
    const files = new Set(this.views.map(({ replay }) => replay.run.file));
    document.title = `${titles.join(" | ")} – gradysim replays`;
    document.body.classList.add("beside");
    this.choice.append(make("option", { value: "" }, "All nodes"));
    for (const { id, name } of this.nodes) this.choice.append(make("option", { value: String(id) }, name));
    this.choice.addEventListener("change", () =>
      this.store.set({ node: this.choice.value === "" ? null : Number(this.choice.value) }),
    );
    const heads = ["", ...titles, ...(titles.length === 2 ? ["difference"] : [])].map((head) => make("th", {}, head));
    document.body.append(
      make("header", {}, make("h1", {}, [...files].join(", ")), this.message, this.controls.tools),
      make("main", { class: "views" }, ...this.views.map(({ element }) => element)),
      make(
        "aside",
        {},
        make(
          "section",
          { "aria-label": "Comparison" },
          make("div", { class: "row" }, make("h2", {}, "Node"), this.choice),
          this.tableTitle,
          make("table", { class: "differences" }, make("thead", {}, make("tr", {}, ...heads)), this.rows),
          ...this.views.map(({ chosen }) => chosen),
        ),
      ),
      make("footer", {}, this.controls.bar),
      this.dialogs.run,
      this.dialogs.keys,
    );
  }

  private goToAddress(): void {
    const { timeNs, state } = readAddress(this.nodes);
    for (const view of this.views) view.filter = parseFilter(state.filter ?? "", view.replay);
    this.store.set(state);
    this.seek(timeNs ?? this.clock.timeNs);
  }

  private async open(): Promise<void> {
    await Promise.all(this.views.map(({ replay }) => replay.sumAll()));
    this.clock.speed = speedFor(this.clock.endNs);
    await Promise.all(this.views.map(({ replay }) => replay.load(0)));
    const extent = this.views.flatMap(({ replay }) => replay.extent());
    for (const { scene } of this.views) scene.fit(extent, SLANT);
    this.goToAddress();
    await this.drawNow();
    requestAnimationFrame((nowMs) => this.tick(nowMs));
  }

  private tick(nowMs: number): void {
    const wallS = Math.min(0.25, (nowMs - this.lastTickMs) / 1000);
    this.lastTickMs = nowMs;
    if (this.isReady && this.clock.advance(wallS)) {
      if (this.hasFrame) this.choose([]);
      this.isDirty = true;
      void this.load(this.clock.speed * 1e9);
    }
    if (this.isDirty && this.isReady) this.draw();
    else if (this.isDirty) void this.load();
    if (this.areTextsOld && this.isReady && nowMs - this.lastTextsMs > TEXTS_MS) this.drawTexts(nowMs);
    requestAnimationFrame((next) => this.tick(next));
  }

  private get isReady(): boolean {
    return this.views.every((view) => view.replay.isReady(view.timeOf(this.clock)));
  }

  /** Decode what is needed to show the time of the clock, or one `aheadNs` later. */
  private async load(aheadNs = 0): Promise<void> {
    const timeNs = this.clock.timeNs + aheadNs;
    await Promise.all(this.views.map(({ replay }) => replay.load(Math.min(replay.endNs, timeNs))));
  }

  private async drawNow(): Promise<void> {
    await this.load();
    this.draw();
  }

  private draw(): void {
    this.isDirty = false;
    this.areTextsOld = true;
    const { now } = this.store;
    this.leader.draw(this.clock, now, this.name);
    for (const view of this.views) {
      if (view === this.leader) continue;
      view.scene.lookAs(this.leader.scene);
      view.draw(this.clock, { ...now, isFollowing: false }, this.name);
    }
    this.controls.update();
    this.capture.add();
  }

  private drawTexts(nowMs: number): void {
    this.areTextsOld = false;
    this.lastTextsMs = nowMs;
    const { timeNs, isPlaying } = this.clock;
    this.choice.value = String(this.store.now.node ?? "");
    setText(this.tableTitle, timeNs === 0 ? "Outcomes of the whole runs" : "Outcomes so far");
    this.showTable(timeNs === 0);
    if (isPlaying) return;
    this.address.write(timeNs, this.store.now);
    const hash = new URLSearchParams({ t: String(timeNs / 1e9), ...(this.name === null ? {} : { node: this.name }) });
    for (const { link, address } of this.views) link.href = `${address}#${hash}`;
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
        row.style.setProperty("--color", outcomeColor(name));
        row.style.setProperty("--dash", `${outcomeDash(name) || 100}px`);
        setText(row.children[0].children[1], outcomeWords(name));
        columnsOf(counts).forEach((text, place) => setText(row.children[place + 1], text));
        counts.forEach((count, place) => {
          (row.children[place + 1] as HTMLElement).title = shareText(count / columns[place].total);
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
