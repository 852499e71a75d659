import { App } from "./app";
import { Files, showBeside } from "./beside";
import { make } from "./dom";
import { liveSource } from "./live";
import { Replay } from "./replay";
import { scriptInterface } from "./script";
import { snapshotSource } from "./snapshots";
import { fileSource, jsonElement } from "./source";
import "./style.css";

async function start(): Promise<void> {
  try {
    const files = jsonElement<Files>("gradysim-beside");
    if (files !== null) {
      const beside = await showBeside(files);
      const runs = beside.views.map(({ replay }) => scriptInterface(beside, replay));
      Object.assign(window, { gradysim: { ...runs[0], runs } });
      return;
    }
    const source = await (liveSource() ?? snapshotSource() ?? fileSource());
    if (source === null) document.body.append(make("p", { class: "message" }, "This page holds no run."));
    else {
      const app = new App(new Replay(source));
      Object.assign(window, { gradysim: scriptInterface(app, app.replay) });
    }
  } catch (error) {
    document.body.append(make("p", { class: "mistake" }, `The replay cannot be shown: ${(error as Error).message}`));
    throw error;
  }
}

document.addEventListener("DOMContentLoaded", () => void start());
