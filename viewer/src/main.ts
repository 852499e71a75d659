import { App } from "./app";
import { Beside, showBeside } from "./beside";
import { make } from "./dom";
import { liveSource } from "./live";
import { scriptInterface } from "./script";
import { snapshotSource } from "./snapshots";
import { fileSource, jsonElement } from "./source";
import "./style.css";

async function start(): Promise<void> {
  try {
    const beside = jsonElement<Beside>("gradysim-beside");
    if (beside !== null) return showBeside(beside);
    const source = await (liveSource() ?? snapshotSource() ?? fileSource());
    if (source === null) document.body.append(make("p", { class: "message" }, "This page holds no run."));
    else Object.assign(window, { gradysim: scriptInterface(new App(source)) });
  } catch (error) {
    document.body.append(make("p", { class: "mistake" }, `The replay cannot be shown: ${(error as Error).message}`));
    throw error;
  }
}

document.addEventListener("DOMContentLoaded", () => void start());
