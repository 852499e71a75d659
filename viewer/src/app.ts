// The page of one replay: puts its parts together.

import { subtitleOf, titleOf, warningOf } from "./about";
import { findNumber, Place } from "./address";
import { Stage } from "./capture";
import { make } from "./dom";
import { FrameList } from "./frames";
import { Inspector } from "./inspector";
import { Page } from "./page";
import { Frame, Replay, startOf } from "./replay";
import { setText } from "./rows";
import { Sequence } from "./sequence";
import { State } from "./state";
import { findStep, Goal } from "./steps";
import { View } from "./view";

export class App extends Page {
  readonly ready: Promise<void>;
  protected readonly leader: View;
  protected readonly views: View[];
  private readonly sequence: Sequence;
  private readonly inspector: Inspector;
  private readonly list: FrameList;
  private readonly side: HTMLElement;

  constructor(readonly replay: Replay) {
    super([replay], replay.run.nodes);
    const { source } = replay;
    this.inspector = new Inspector(replay, this.store, this);
    this.list = new FrameList(replay, this.store, (frame) => void this.chooseFrame(frame));
    this.sequence = new Sequence(replay, this.store, this, (frame) => void this.chooseFrame(frame));
    this.leader = new View(replay, "The nodes in space", this);
    this.views = [this.leader];
    const { canvas, labels, overlay, timeline, details } = this.leader;
    overlay.onClick(canvas, (node, isToPin) => {
      if (node !== null && isToPin) this.pin(node);
      else if (node !== null || this.store.now.node !== null) this.store.set({ node });
    });
    this.side = make(
      "aside",
      {},
      this.inspector.element,
      make("section", { class: "of-frames", "aria-label": "Frames" }, details.element, ...this.list.elements),
    );
    document.title = `${titleOf(replay)} – gradysim replay`;
    document.body.classList.toggle("no-frames", !replay.hasFrames);
    this.layOut(
      titleOf(replay),
      [make("p", { class: "about", title: subtitleOf(replay) }, subtitleOf(replay))],
      [make("main", { class: "stage" }, canvas, labels), this.sequence.element, this.side],
      [timeline.element],
    );
    source.onChange = () => this.update();
    this.update();
    this.clock.isPlaying = source.isLive;
    if (source.follows) this.clock.seek(this.clock.endNs);
    this.ready = this.open();
  }

  async step(goal: Goal, direction: 1 | -1): Promise<void> {
    if (!this.replay.hasFrames) return;
    this.clock.isPlaying = false;
    const from = this.store.now.frame ?? this.clock.timeNs;
    const frame = await findStep(this.replay, goal, this.leader.filter, from, direction);
    if (frame) await this.chooseFrame(frame);
    else if (this.clock.mayGrow) this.seek(this.clock.endNs);
  }

  pin(node = this.store.now.node): void {
    const { pinned } = this.store.now;
    if (node !== null) this.store.set({ pinned: pinned.includes(node) ? pinned.filter((one) => one !== node) : [...pinned, node] });
  }

  focusFilter(): void {
    this.list.field.focus();
    this.list.field.select();
  }

  protected stages(): Stage[] {
    const title = [titleOf(this.replay), this.replay.run.mode].filter(Boolean).join(" · ");
    return [{ stage: this.leader.stage, title }];
  }

  protected stateOf(): Readonly<State> {
    return this.store.now;
  }

  protected clearFrame(): void {
    if (this.store.now.frame !== null) this.store.set({ frame: null });
  }

  protected readFrame(): void {
    const { frame, node } = this.store.now;
    this.side.classList.toggle("with-frame", frame !== null);
    void this.leader.details.read(frame, node).then(() => this.redraw());
  }

  protected showMistake(message: string): void {
    this.list.showMistake(message);
  }

  protected drawViews(): void {
    this.sequence.draw(this.leader.draw(this.clock, this.store.now));
  }

  protected drawTexts(): void {
    const { timeNs, isPlaying } = this.clock;
    this.inspector.update(timeNs, this.replay.positions(timeNs));
    this.list.update(timeNs, this.leader.filter);
    // A page that is loaded again does not have the past of a run that does not wait.
    if (!isPlaying && !this.replay.source.follows) this.writeAddress();
  }

  protected override async goTo(place: Place): Promise<void> {
    const frame = place.frame === null ? null : await findNumber(this.replay, place.frame);
    if (frame) await this.chooseFrame(frame);
    else await super.goTo(place);
  }

  /** More of the run has come. */
  private update(): void {
    const { end, isLive, isLost } = this.replay.source;
    this.clock.grow(this.replay.endNs, isLive && !isLost && end === null);
    setText(this.warning, warningOf(this.replay));
    this.redraw();
  }

  private async chooseFrame(frame: Frame): Promise<void> {
    this.clock.isPlaying = false;
    this.seek(startOf(frame));
    await this.replay.load(this.clock.timeNs);
    this.store.set({ frame });
  }
}
