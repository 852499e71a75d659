// A replay on the page: its scene with what is written over it, its timeline and the details of a frame.

import { Picture } from "./air";
import { Clock } from "./clock";
import { Actions } from "./controls";
import { make } from "./dom";
import { Filter, parseFilter } from "./filter";
import { FrameDetails } from "./frame_details";
import { Overlay } from "./overlay";
import { Replay } from "./replay";
import { Scene, TRAIL_S } from "./scene";
import { State } from "./state";
import { Timeline, Window } from "./timeline";

/** What replays that are shown together have in common. */
export interface Shared {
  groups: readonly string[];
  window: Window;
  /** The replays whose outcomes are in the legend. */
  legendOf: readonly Replay[];
}

export class View {
  readonly canvas: HTMLCanvasElement;
  readonly labels = make("canvas", { class: "labels", "aria-hidden": "true" });
  readonly scene: Scene;
  readonly overlay: Overlay;
  readonly timeline: Timeline;
  readonly details: FrameDetails;
  filter: Filter;

  /** `words` describe the scene. */
  constructor(
    readonly replay: Replay,
    words: string,
    private readonly page: Actions,
    shared?: Shared,
  ) {
    const redraw = (): void => page.redraw();
    this.canvas = make("canvas", { class: "scene", tabindex: "0", "aria-label": words });
    this.scene = new Scene(this.canvas, replay, redraw, shared?.groups);
    this.overlay = new Overlay(this.labels, replay, this.scene, shared?.legendOf);
    this.timeline = new Timeline(replay, (timeNs) => page.seek(timeNs), redraw, shared?.window);
    this.details = new FrameDetails(replay, () => page.clearChoice());
    this.filter = parseFilter("", replay);
    new ResizeObserver(redraw).observe(this.canvas);
  }

  /** The element that holds the canvases. */
  get stage(): HTMLElement {
    return this.canvas.parentElement as HTMLElement;
  }

  /** Of a run that is over, the end is shown. */
  timeOf({ timeNs }: Clock): number {
    return Math.min(timeNs, this.replay.endNs);
  }

  /** Draw the time of the clock; return what was drawn. */
  draw(clock: Clock, state: Readonly<State>): Picture {
    const { replay, filter } = this;
    const timeNs = this.timeOf(clock);
    const positions = replay.positions(timeNs);
    const look = replay.look(timeNs);
    const picture = { timeNs, speed: clock.speed, positions, state, look, filter, interferers: this.details.interferers };
    this.scene.draw(picture);
    this.overlay.draw(timeNs, positions, state, look);
    this.timeline.draw(clock.timeNs);
    const missing = replay.missingBefore(timeNs, Math.max(0, timeNs - TRAIL_S * 1e9));
    if (missing !== null) void replay.loadChunk(missing).then(() => this.page.redraw());
    return picture;
  }
}
