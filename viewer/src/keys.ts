// The keyboard.

import { Clock, SPEEDS } from "./clock";
import { Actions, Controls } from "./controls";
import { make } from "./dom";

const KEYS: [keys: string, words: string][] = [
  ["Space", "play or pause"],
  ["+ −", "faster, slower"],
  ["→ ←", "next, previous frame that fits the filter"],
  ["Shift → ←", "next, previous frame with a loss"],
  [". ,", "next, previous frame that the chosen node sent or noticed"],
  ["PageDown PageUp", "10 s on, 10 s back"],
  ["Home End", "start, end"],
  ["n p", "choose the next, previous node"],
  ["f", "follow the chosen node"],
  ["k", "pin the chosen node: its variables and its lane stay; or unpin it"],
  ["s", "show the sequence chart"],
  ["t a z", "view from above; show all nodes; zoom in on the chosen frame or node"],
  ["l r g", "show names, trails, the legend"],
  ["c v", "save a picture of the scene; record a film of it, or end that"],
  ["/", "filter the frames"],
  ["i ?", "what was run; these keys"],
  ["Tab Enter", "go to a button, press it"],
  ["Esc", "clear the selection"],
];

export function listenToKeys(controls: Controls, actions: Actions, clock: Clock): void {
  const faster = (steps: number): void => {
    const index = SPEEDS.findIndex((speed) => speed >= clock.speed) + steps;
    actions.setSpeed(SPEEDS[Math.min(Math.max(0, index), SPEEDS.length - 1)]);
  };
  const done: Record<string, () => void> = {
    " ": () => actions.playOrPause(),
    "+": () => faster(1),
    "=": () => faster(1),
    "-": () => faster(-1),
    ArrowRight: () => actions.step("frame", 1),
    ArrowLeft: () => actions.step("frame", -1),
    "Shift ArrowRight": () => actions.step("loss", 1),
    "Shift ArrowLeft": () => actions.step("loss", -1),
    ".": () => actions.stepOfNode(1),
    ",": () => actions.stepOfNode(-1),
    PageDown: () => actions.seek(clock.timeNs + 10e9),
    PageUp: () => actions.seek(clock.timeNs - 10e9),
    Home: () => actions.seek(0),
    End: () => actions.seek(clock.endNs),
    n: () => actions.chooseNode(1),
    p: () => actions.chooseNode(-1),
    f: () => controls.toggle("isFollowing"),
    k: () => actions.pin?.(),
    s: () => controls.toggle("sequence"),
    t: () => actions.toggleTop(),
    a: () => actions.showAll(),
    z: () => actions.zoom(),
    l: () => controls.toggle("labels"),
    r: () => controls.toggle("trails"),
    g: () => controls.toggle("legend"),
    c: () => actions.savePicture(),
    v: () => actions.toggleFilm(),
    "/": () => actions.focusFilter(),
    i: () => actions.showRun(),
    "?": () => actions.showKeys(),
    Escape: () => actions.clearChoice(),
  };
  const isElsewhere = ({ ctrlKey, altKey, metaKey }: KeyboardEvent): boolean =>
    ctrlKey || altKey || metaKey || document.querySelector("dialog[open]") !== null;
  document.addEventListener("keyup", (event) => {
    // In Firefox this is what keeps the space bar from pressing the button that has the focus.
    if (event.key !== " " || isElsewhere(event) || (event.target as HTMLElement).matches("input")) return;
    event.preventDefault();
  });
  document.addEventListener("keydown", (event) => {
    const target = event.target as HTMLElement;
    if (isElsewhere(event)) return;
    if (target.matches("input")) {
      if (event.key === "Escape") target.blur();
      return;
    }
    const action = done[(event.shiftKey && event.key.startsWith("Arrow") ? "Shift " : "") + event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}

export function keysDialog(): HTMLDialogElement {
  const rows = KEYS.map(([keys, words]) =>
    make("tr", {}, make("td", {}, ...keys.split(" ").map((key) => make("kbd", {}, key))), make("td", {}, words)),
  );
  const mouse = "Drag to move the view, drag with the right button to turn it, turn the wheel to zoom, click a node. On the timeline, drag to move in time, turn the wheel to zoom, double click to see the whole run. In the sequence chart, drag to see what was before or after, turn the wheel to zoom, double click to come back. Click a node with Shift to pin it.";
  return dialog("Keys", make("table", {}, make("tbody", {}, ...rows)), make("p", { class: "message" }, mouse));
}

export function dialog(title: string, ...content: HTMLElement[]): HTMLDialogElement {
  const close = make("button", { type: "submit" }, "Close");
  const form = make("form", { method: "dialog" }, make("h2", {}, title), ...content, close);
  return make("dialog", {}, form);
}
