// The buttons: what a run is, what is shown, play and steps. Keys do the same.

import { Named } from "./address";
import { Clock, SPEEDS } from "./clock";
import { button, make, timeText } from "./dom";
import { setText } from "./rows";
import { State, Store, Switch } from "./state";
import { Goal } from "./steps";

/** What buttons, keys and the parts of the page can ask of it. */
export interface Actions {
  /** Draw again soon. */
  redraw(): void;
  playOrPause(): void;
  seek(timeNs: number): void;
  setSpeed(speed: number): void;
  step(goal: Goal, direction: 1 | -1): void;
  /** Step to a frame of the chosen node. */
  stepOfNode(direction: 1 | -1): void;
  chooseNode(direction: 1 | -1): void;
  /** Pin the chosen node, or this one, or unpin it. */
  pin?(node?: number): void;
  clearChoice(): void;
  showAll(): void;
  zoom(): void;
  toggleTop(): void;
  savePicture(): void;
  /** Start to record a film, or end it. */
  toggleFilm(): void;
  readonly isRecording: boolean;
  focusFilter(): void;
  showRun(): void;
  showKeys(): void;
}

/** A list of all nodes, in which one can be chosen. */
export function nodeChoice(nodes: readonly Named[], store: Store): HTMLSelectElement {
  const names = nodes.map(({ id, name }) => make("option", { value: String(id) }, name));
  const all = make("option", { value: "" }, "All nodes");
  const choice = make("select", { "aria-label": "Node", title: "Choose a node" }, all, ...names);
  choice.addEventListener("change", () => store.set({ node: choice.value === "" ? null : Number(choice.value) }));
  store.onChange((changed) => {
    if ("node" in changed) choice.value = String(changed.node ?? "");
  });
  return choice;
}

export class Controls {
  readonly tools = make("div", { class: "tools" });
  readonly bar = make("div", { class: "controls" });
  private readonly play = button("Play", "Play or pause (space)", () => this.actions.playOrPause());
  private readonly speed = make("select", { "aria-label": "Speed", title: "Speed (+ and −)" });
  private readonly time = make("input", { class: "time", "aria-label": "Time in seconds", inputmode: "decimal" });
  private readonly end = make("span", { class: "muted" });
  private readonly film = button("Film", "Record a film of the scene, or end it (v)", () => this.actions.toggleFilm());
  private readonly toggles = new Map<keyof State, HTMLButtonElement>();

  constructor(
    private readonly clock: Clock,
    private readonly store: Store,
    private readonly actions: Actions,
  ) {
    this.play.classList.add("main");
    for (const speed of SPEEDS) this.speed.append(make("option", { value: String(speed) }, `${speed}×`));
    this.speed.addEventListener("change", () => actions.setSpeed(Number(this.speed.value)));
    this.time.addEventListener("change", () => {
      const seconds = Number.parseFloat(this.time.value);
      if (!Number.isNaN(seconds)) actions.seek(seconds * 1e9);
      this.time.blur();
    });
    const gap = (): HTMLElement => make("span", { class: "gap" });
    const steps = (words: string, key: string, backKey: string, step: (direction: 1 | -1) => void): HTMLElement =>
      make(
        "span",
        { class: "steps of-frames", role: "group", "aria-label": words },
        button("◀", `Previous ${words} (${backKey})`, () => step(-1)),
        make("span", { class: "words" }, words),
        button("▶", `Next ${words} (${key})`, () => step(1)),
      );
    this.bar.append(
      this.play,
      this.speed,
      gap(),
      this.time,
      this.end,
      gap(),
      steps("frame", "→", "←", (direction) => actions.step("frame", direction)),
      steps("loss", "Shift →", "Shift ←", (direction) => actions.step("loss", direction)),
      steps("frame of the node", ".", ",", (direction) => actions.stepOfNode(direction)),
    );
    this.addToggle("isFollowing", "Follow", "Follow the chosen node (f)");
    this.tools.append(
      button("Top view", "View from above, or at an angle again (t)", () => actions.toggleTop()),
      button("Show all", "Show all nodes (a)", () => actions.showAll()),
      button("Zoom in", "Zoom in on the chosen frame or node (z)", () => actions.zoom()),
    );
    this.addToggle("labels", "Names", "Show the names of nodes (l)");
    this.addToggle("trails", "Trails", "Show trails: the path of the last 30 s (r)");
    this.addToggle("sequence", "Sequence", "Show which node sent when to which one (s)").classList.add("of-frames", "alone");
    this.addToggle("legend", "Legend", "Show what shapes and lines stand for (g)");
    this.tools.append(button("Picture", "Save a picture of the scene (c)", () => actions.savePicture()), this.film);
    const run = button("Run", "What was run (i)", () => actions.showRun());
    run.classList.add("of-frames");
    this.tools.append(run, button("Keys", "Keys (?)", () => actions.showKeys()));
  }

  toggle(name: Switch): void {
    this.store.set({ [name]: !this.store.now[name] });
  }

  update(): void {
    const { timeNs, endNs, isPlaying, speed } = this.clock;
    setText(this.play, isPlaying ? "Pause" : "Play");
    setText(this.end, `of ${Number(timeText(endNs, 3))} s`);
    if (document.activeElement !== this.time) this.time.value = timeText(timeNs);
    if (document.activeElement !== this.speed || Number(this.speed.value) !== speed)
      this.speed.value = String(speed);
    this.film.setAttribute("aria-pressed", String(this.actions.isRecording));
    for (const [name, element] of this.toggles)
      element.setAttribute("aria-pressed", String(this.store.now[name]));
  }

  private addToggle(name: Switch, label: string, title: string): HTMLButtonElement {
    const element = button(label, title, () => this.toggle(name));
    this.toggles.set(name, element);
    this.tools.append(element);
    return element;
  }
}
