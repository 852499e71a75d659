// What the page of one replay and the page of several share: clock, buttons and keys, and when to draw.

import { runDialog } from "./about";
import { Address, Named, Place } from "./address";
import { SLANT } from "./camera";
import { Capture, Stage } from "./capture";
import { Clock, speedFor } from "./clock";
import { Actions, Controls } from "./controls";
import { make } from "./dom";
import { parseFilter } from "./filter";
import { keysDialog, listenToKeys } from "./keys";
import { Replay } from "./replay";
import { setText } from "./rows";
import { State, Store } from "./state";
import { Goal } from "./steps";
import { View } from "./view";

/** How often texts change: less often than the picture. */
const TEXTS_MS = 160;

export abstract class Page implements Actions {
  abstract readonly ready: Promise<void>;
  protected abstract readonly views: readonly View[];
  /** The view that was moved last: others look from the same place. */
  protected abstract leader: View;
  protected readonly clock: Clock;
  protected readonly store = new Store();
  protected readonly controls: Controls;
  protected readonly warning = make("p", { class: "mistake" });
  private readonly capture: Capture;
  private readonly address: Address;
  private readonly dialogs: { run: HTMLDialogElement; keys: HTMLDialogElement };
  private isDirty = true;
  private areTextsOld = true;
  private lastTickMs = 0;
  private lastTextsMs = 0;

  /** `nodes`: those that can be chosen. */
  constructor(
    protected readonly replays: readonly Replay[],
    protected readonly nodes: readonly Named[],
  ) {
    this.clock = new Clock(replays.some(({ source }) => source.follows));
    this.controls = new Controls(this.clock, this.store, this);
    this.address = new Address(nodes, replays[0]);
    this.dialogs = { run: runDialog(replays), keys: keysDialog() };
    this.capture = new Capture(
      () => this.stages(),
      this.clock,
      () => this.drawNow(),
      (text) => setText(this.warning, text),
    );
  }

  /** Step to a frame that fits `goal`. */
  abstract step(goal: Goal, direction: 1 | -1): Promise<void>;
  abstract focusFilter(): void;
  /** What a picture of the scene shows. */
  protected abstract stages(): Stage[];
  /** What is chosen in a view. */
  protected abstract stateOf(view: View): Readonly<State>;
  protected abstract clearFrame(): void;
  /** Read the chosen frame again: it, or the chosen node, has changed. */
  protected abstract readFrame(): void;
  protected abstract showMistake(message: string): void;
  protected abstract drawViews(): void;
  protected abstract drawTexts(): void;

  redraw(): void {
    this.isDirty = true;
  }

  seek(timeNs: number): void {
    this.clock.seek(timeNs);
    this.clearFrame();
    this.redraw();
  }

  /** Go to a time, choosing no frame, and draw it. */
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

  stepOfNode(direction: 1 | -1): void {
    const { node } = this.store.now;
    if (node !== null) void this.step({ node }, direction);
  }

  chooseNode(direction: 1 | -1): void {
    const ids = this.nodes.map(({ id }) => id);
    const { node } = this.store.now;
    const index = node === null ? (direction > 0 ? -1 : ids.length) : ids.indexOf(node);
    this.store.set({ node: ids[(index + direction + ids.length) % ids.length] });
  }

  clearChoice(): void {
    if (this.views.some((view) => this.stateOf(view).frame !== null)) this.clearFrame();
    else this.store.set({ node: null, isFollowing: false });
  }

  showAll(): void {
    this.store.set({ isFollowing: false });
    this.leader.scene.fit(this.views.flatMap((view) => [...view.replay.positions(view.timeOf(this.clock))]));
    this.redraw();
  }

  /** Show the chosen frame or node from near. */
  zoom(): void {
    const { leader } = this;
    const { frame, node } = this.stateOf(leader);
    if (!leader.scene.zoomIn(leader.timeOf(this.clock), frame, leader.details.interferers, node)) this.showAll();
    this.redraw();
  }

  toggleTop(): void {
    this.leader.scene.camera.toggleTop();
    this.redraw();
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

  showRun(): void {
    if (this.replays.some(({ hasFrames }) => hasFrames)) this.dialogs.run.showModal();
  }

  showKeys(): void {
    this.dialogs.keys.showModal();
  }

  protected layOut(title: string, about: HTMLElement[], middle: HTMLElement[], foot: HTMLElement[] = []): void {
    document.body.append(
      make("header", {}, make("h1", {}, title), ...about, this.warning, this.controls.tools),
      ...middle,
      make("footer", {}, this.controls.bar, ...foot),
      this.dialogs.run,
      this.dialogs.keys,
    );
  }

  /** Begin to react and to draw. Resolves when the page shows what its address asks for. */
  protected async open(): Promise<void> {
    this.store.onChange((changed) => this.react(changed));
    listenToKeys(this.controls, this, this.clock);
    window.addEventListener("hashchange", () => void this.goToAddress());
    if (!this.replays.some(({ source }) => source.isLive)) {
      await Promise.all(this.replays.map((replay) => replay.sumAll()));
      this.clock.speed = speedFor(this.clock.endNs);
    }
    await Promise.all(this.replays.map((replay) => replay.load(0)));
    const extent = this.replays.flatMap((replay) => replay.extent());
    for (const { scene } of this.views) scene.fit(extent, SLANT);
    await this.goToAddress();
    requestAnimationFrame((nowMs) => this.tick(nowMs));
  }

  protected async goTo({ timeNs }: Place): Promise<void> {
    await this.show(timeNs ?? (this.clock.isFollowing ? this.clock.endNs : this.clock.timeNs));
  }

  protected writeAddress(): void {
    this.address.write(this.clock.timeNs, this.store.now);
  }

  private async goToAddress(): Promise<void> {
    const place = this.address.read();
    this.store.set(place.state);
    await this.goTo(place);
  }

  private react(changed: Partial<State>): void {
    if ("filter" in changed) this.setFilter();
    if ("node" in changed && this.store.now.node === null && this.store.now.isFollowing)
      this.store.set({ isFollowing: false });
    if (changed.isFollowing && this.store.now.node === null) this.chooseNode(1);
    if ("frame" in changed || "node" in changed) this.readFrame();
    this.redraw();
  }

  private setFilter(): void {
    try {
      for (const view of this.views) view.filter = parseFilter(this.store.now.filter, view.replay);
      this.showMistake("");
    } catch (error) {
      this.showMistake((error as Error).message);
    }
  }

  private tick(nowMs: number): void {
    const wallS = Math.min(0.25, (nowMs - this.lastTickMs) / 1000);
    this.lastTickMs = nowMs;
    const { timeNs, speed, isPlaying } = this.clock;
    const { isReady } = this;
    for (const { source } of this.replays) source.tell(timeNs, speed, isPlaying);
    if (isReady && this.clock.advance(wallS)) {
      this.clearFrame();
      this.isDirty = true;
      // What comes next is decoded before it is needed.
      void this.load(speed * 1e9);
    }
    const canDraw = this.isReady;
    if (this.isDirty && canDraw) this.draw();
    else if (this.isDirty) void this.load();
    if (this.areTextsOld && canDraw && nowMs - this.lastTextsMs > TEXTS_MS) {
      this.areTextsOld = false;
      this.lastTextsMs = nowMs;
      this.drawTexts();
    }
    requestAnimationFrame((next) => this.tick(next));
  }

  private get isReady(): boolean {
    return this.views.every((view) => view.replay.isReady(view.timeOf(this.clock)));
  }

  /** Decode what is needed to show the time of the clock, or one `aheadNs` later. */
  private async load(aheadNs = 0): Promise<void> {
    const timeNs = this.clock.timeNs + aheadNs;
    await Promise.all(this.replays.map((replay) => replay.load(Math.min(replay.endNs, timeNs))));
  }

  private async drawNow(): Promise<void> {
    await this.load();
    this.draw();
  }

  private draw(): void {
    this.isDirty = false;
    this.areTextsOld = true;
    this.drawViews();
    this.capture.add();
    this.controls.update();
  }
}
