// Puts the parts of the page together and draws them when something has changed.

import { runDialog, subtitleOf, titleOf, warningOf } from "./about";
import { Address, findNumber, readAddress } from "./address";
import { SLANT } from "./camera";
import { Capture } from "./capture";
import { Clock, speedFor } from "./clock";
import { Actions, Controls } from "./controls";
import { make } from "./dom";
import { Filter, parseFilter } from "./filter";
import { FrameDetails } from "./frame_details";
import { FrameList } from "./frames";
import { Inspector } from "./inspector";
import { keysDialog, listenToKeys } from "./keys";
import { Overlay } from "./overlay";
import { Frame, Replay, startOf } from "./replay";
import { setText } from "./rows";
import { Scene, TRAIL_S } from "./scene";
import { Source } from "./source";
import { Sequence } from "./sequence";
import { State, Store } from "./state";
import { findStep, Goal } from "./steps";
import { Timeline } from "./timeline";

/** How often texts change: less often than the picture. */
const TEXTS_MS = 160;

export class App implements Actions {
  readonly replay: Replay;
  readonly ready: Promise<void>;
  private readonly clock: Clock;
  private readonly store = new Store();
  private readonly scene: Scene;
  private readonly overlay: Overlay;
  private readonly timeline: Timeline;
  private readonly sequence: Sequence;
  private readonly controls: Controls;
  private readonly inspector: Inspector;
  private readonly list: FrameList;
  private readonly chosen: FrameDetails;
  private readonly address: Address;
  private readonly dialogs: { run: HTMLDialogElement; keys: HTMLDialogElement };
  private readonly capture: Capture;
  private readonly warning = make("p", { class: "mistake" });
  private readonly side = make("aside");
  private filter: Filter;
  private isDirty = true;
  private areTextsOld = true;
  private lastTickMs = 0;
  private lastTextsMs = 0;

  constructor(source: Source) {
    this.replay = new Replay(source);
    this.clock = new Clock(source.follows);
    this.filter = parseFilter("", this.replay);
    this.address = new Address(this.replay);
    this.dialogs = { run: runDialog([this.replay]), keys: keysDialog() };
    this.controls = new Controls(this.clock, this.store, this);
    this.inspector = new Inspector(
      this.replay,
      this.store,
      (timeNs) => this.seek(timeNs),
      (node) => this.pin(node),
    );
    this.chosen = new FrameDetails(this.replay, () => this.store.set({ frame: null }));
    this.list = new FrameList(this.replay, this.store, (frame) => void this.chooseFrame(frame));
    this.timeline = new Timeline(
      this.replay,
      (timeNs) => this.seek(timeNs),
      () => this.redraw(),
    );
    this.sequence = new Sequence(this.replay, {
      choose: (frame) => void this.chooseFrame(frame),
      chooseNode: (node) => this.store.set({ node }),
      seek: (timeNs) => this.seek(timeNs),
      redraw: () => this.redraw(),
      close: () => this.store.set({ sequence: false }),
    });
    const canvas = make("canvas", { class: "scene", tabindex: "0", "aria-label": "The nodes in space" });
    const labels = make("canvas", { class: "labels", "aria-hidden": "true" });
    this.layOut(canvas, labels);
    this.scene = new Scene(canvas, this.replay, () => this.redraw());
    this.overlay = new Overlay(labels, this.replay, this.scene);
    this.overlay.onClick(canvas, (node, isToPin) => {
      if (node !== null && isToPin) this.pin(node);
      else if (node !== null || this.store.now.node !== null) this.store.set({ node });
    });
    const title = [titleOf(this.replay), this.replay.run.mode].filter(Boolean).join(" · ");
    this.capture = new Capture(
      () => [{ stage: canvas.parentElement as HTMLElement, title }],
      this.clock,
      () => this.drawNow(),
      (text) => setText(this.warning, text),
    );
    this.listen(canvas);
    source.onChange = () => this.takeNews();
    this.takeNews();
    this.clock.isPlaying = source.isLive;
    if (source.follows) this.clock.seek(this.clock.endNs);
    this.ready = this.open();
  }

  redraw(): void {
    this.isDirty = true;
  }

  /** Go to a time, choosing no frame, and draw it. */
  async show(timeNs: number): Promise<void> {
    this.seek(timeNs);
    await this.drawNow();
  }

  seek(timeNs: number): void {
    this.clock.seek(timeNs);
    if (this.store.now.frame !== null) this.store.set({ frame: null });
    this.redraw();
  }

  playOrPause(): void {
    this.clock.toggle();
    this.redraw();
  }

  setSpeed(speed: number): void {
    this.clock.speed = speed;
    this.redraw();
  }

  async step(goal: Goal, direction: 1 | -1): Promise<void> {
    if (!this.replay.hasFrames) return;
    this.clock.isPlaying = false;
    const from = this.store.now.frame ?? this.clock.timeNs;
    const frame = await findStep(this.replay, goal, this.filter, from, direction);
    if (frame) await this.chooseFrame(frame);
    else if (this.clock.mayGrow) this.seek(this.clock.endNs);
  }

  stepOfNode(direction: 1 | -1): void {
    const { node } = this.store.now;
    if (node !== null) void this.step({ node }, direction);
  }

  chooseNode(direction: 1 | -1): void {
    const ids = this.replay.run.nodes.map((node) => node.id);
    const { node } = this.store.now;
    const place = node === null ? (direction > 0 ? -1 : ids.length) : ids.indexOf(node);
    this.store.set({ node: ids[(place + direction + ids.length) % ids.length] });
  }

  pin(node = this.store.now.node): void {
    const { pinned } = this.store.now;
    if (node !== null) this.store.set({ pinned: pinned.includes(node) ? pinned.filter((one) => one !== node) : [...pinned, node] });
  }

  clearChoice(): void {
    this.store.set(this.store.now.frame ? { frame: null } : { node: null, isFollowing: false });
  }

  showAll(): void {
    this.store.set({ isFollowing: false });
    this.scene.fit(this.replay.positions(this.clock.timeNs));
    this.redraw();
  }

  /** Show the chosen frame or node from near. */
  zoom(): void {
    const { frame, node } = this.store.now;
    if (!this.scene.zoomIn(this.clock.timeNs, frame, this.chosen.interferers, node)) this.showAll();
    this.redraw();
  }

  toggleTop(): void {
    this.scene.camera.toggleTop();
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

  focusFilter(): void {
    this.list.field.focus();
    this.list.field.select();
  }

  showRun(): void {
    if (this.replay.hasFrames) this.dialogs.run.showModal();
  }

  showKeys(): void {
    this.dialogs.keys.showModal();
  }

  /** More of the run has come. */
  private takeNews(): void {
    const { end, isLive, isLost } = this.replay.source;
    this.clock.grow(this.replay.endNs, isLive && !isLost && end === null);
    setText(this.warning, warningOf(this.replay));
    this.redraw();
  }

  private layOut(canvas: HTMLCanvasElement, labels: HTMLCanvasElement): void {
    document.body.classList.toggle("no-frames", !this.replay.hasFrames);
    this.side.append(
      this.inspector.element,
      make("section", { class: "of-frames", "aria-label": "Frames" }, this.chosen.element, ...this.list.elements),
    );
    document.title = `${titleOf(this.replay)} – gradysim replay`;
    document.body.append(
      make(
        "header",
        {},
        make("h1", {}, titleOf(this.replay)),
        make("p", { class: "about", title: subtitleOf(this.replay) }, subtitleOf(this.replay)),
        this.warning,
        this.controls.tools,
      ),
      make("main", { class: "stage" }, canvas, labels),
      this.sequence.element,
      this.side,
      make("footer", {}, this.controls.bar, this.timeline.element),
      this.dialogs.run,
      this.dialogs.keys,
    );
  }

  private listen(canvas: HTMLCanvasElement): void {
    this.store.onChange((changed) => this.react(changed));
    listenToKeys(this.controls, this, this.clock);
    new ResizeObserver(() => this.redraw()).observe(canvas);
    window.addEventListener("hashchange", () => void this.goToAddress());
  }

  private react(changed: Partial<State>): void {
    if ("filter" in changed)
      try {
        this.filter = parseFilter(this.store.now.filter, this.replay);
        this.list.showMistake("");
      } catch (error) {
        this.list.showMistake((error as Error).message);
      }
    if ("node" in changed && this.store.now.node === null && this.store.now.isFollowing)
      this.store.set({ isFollowing: false });
    if (changed.isFollowing && this.store.now.node === null) this.chooseNode(1);
    if ("frame" in changed || "node" in changed) {
      const { frame, node } = this.store.now;
      this.side.classList.toggle("with-frame", frame !== null);
      void this.chosen.read(frame, node).then(() => this.redraw());
    }
    this.redraw();
  }

  private async chooseFrame(frame: Frame): Promise<void> {
    this.clock.isPlaying = false;
    this.seek(startOf(frame));
    await this.replay.load(this.clock.timeNs);
    this.store.set({ frame });
  }

  private async goToAddress(): Promise<void> {
    const place = readAddress(this.replay.run.nodes);
    this.store.set(place.state);
    const frame = place.frame === null ? null : await findNumber(this.replay, place.frame);
    if (frame) await this.chooseFrame(frame);
    else await this.show(place.timeNs ?? (this.clock.isFollowing ? this.clock.endNs : this.clock.timeNs));
  }

  private async open(): Promise<void> {
    const { source } = this.replay;
    if (!source.isLive) {
      await this.replay.sumAll();
      this.clock.speed = speedFor(this.clock.endNs);
    }
    await this.replay.load(0);
    this.scene.fit(this.replay.extent(), SLANT);
    await this.goToAddress();
    requestAnimationFrame((nowMs) => this.tick(nowMs));
  }

  private tick(nowMs: number): void {
    const wallS = Math.min(0.25, (nowMs - this.lastTickMs) / 1000);
    this.lastTickMs = nowMs;
    const isReady = this.replay.isReady(this.clock.timeNs);
    this.replay.source.tell(this.clock.timeNs, this.clock.speed, this.clock.isPlaying);
    if (isReady && this.clock.advance(wallS)) {
      if (this.store.now.frame !== null) this.store.set({ frame: null });
      this.isDirty = true;
      // What comes next is decoded before it is needed.
      void this.replay.load(Math.min(this.clock.endNs, this.clock.timeNs + this.clock.speed * 1e9));
    }
    const canDraw = this.replay.isReady(this.clock.timeNs);
    if (this.isDirty && canDraw) this.draw();
    else if (this.isDirty) void this.replay.load(this.clock.timeNs);
    if (this.areTextsOld && canDraw && nowMs - this.lastTextsMs > TEXTS_MS) this.drawTexts(nowMs);
    requestAnimationFrame((next) => this.tick(next));
  }

  private async drawNow(): Promise<void> {
    await this.replay.load(this.clock.timeNs);
    this.draw();
  }

  private draw(): void {
    this.isDirty = false;
    this.areTextsOld = true;
    const { timeNs, speed } = this.clock;
    const positions = this.replay.positions(timeNs);
    const state = this.store.now;
    const { filter, chosen } = this;
    const look = this.replay.look(timeNs);
    const picture = { timeNs, speed, positions, state, look, filter, interferers: chosen.interferers };
    this.scene.draw(picture);
    this.sequence.draw(picture);
    this.overlay.draw(timeNs, positions, state, look);
    this.timeline.draw(timeNs);
    this.capture.add();
    this.controls.update();
    const missing = this.replay.missingBefore(timeNs, Math.max(0, timeNs - TRAIL_S * 1e9));
    if (missing !== null) void this.replay.loadChunk(missing).then(() => this.redraw());
  }

  private drawTexts(nowMs: number): void {
    this.areTextsOld = false;
    this.lastTextsMs = nowMs;
    const { timeNs, isPlaying } = this.clock;
    this.inspector.update(timeNs, this.replay.positions(timeNs));
    this.list.update(timeNs, this.filter);
    // A page that is loaded again does not have the past of a run that does not wait.
    if (!isPlaying && !this.replay.source.follows) this.address.write(timeNs, this.store.now);
  }
}
