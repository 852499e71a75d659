// What was run: enough to run it again.

import { make, timeText } from "./dom";
import { dialog } from "./keys";
import { Replay } from "./replay";

export function titleOf({ run }: Replay): string {
  return run.config ? `${run.config} #${run.run}` : "Simulation";
}

export function subtitleOf(replay: Replay): string {
  const { config, description, iterations, mode, seed, file, nodes } = replay.run;
  if (!config) return `${nodes.length} nodes`;
  const values = Object.entries(iterations).map(([name, value]) => `${name} = ${value}`);
  // What does not fit is cut off: the description, which is long and known.
  const parts = [`${mode} mode`, `seed ${seed}`, ...values, `${nodes.length} nodes`, file, description];
  return parts.filter(Boolean).join(" · ");
}

/** A note if the record does not show the whole run; "" otherwise. */
export function warningOf(replay: Replay): string {
  const { recorded, nodes, duration_s } = replay.run;
  const { end, isLive, isLost } = replay.source;
  const parts: string[] = [];
  if (isLost && isLive) parts.push("The connection to the run is lost: it was ended, or it does not answer.");
  else if (isLost) parts.push("The run ended early: this is what was recorded until then.");
  else if (end?.complete === false)
    parts.push(`The run was ended at ${timeText(end.time_s * 1e9, 1)} s of ${duration_s} s.`);
  if (recorded !== null && recorded.length < nodes.length)
    parts.push(`Receptions were recorded at ${recorded.length} of ${nodes.length} nodes.`);
  return parts.join(" ");
}

/** The facts of runs side by side, and their configuration files. */
export function runDialog(replays: readonly Replay[]): HTMLDialogElement {
  const facts = replays.map(({ run }) => ({
    file: run.file,
    configuration: run.config,
    run: String(run.run),
    mode: run.mode,
    seed: String(run.seed),
    duration: `${run.duration_s} s`,
    ...run.iterations,
  }));
  const names = new Set(facts.flatMap((one) => Object.keys(one)));
  const rows = [...names].map((name) => {
    const values = facts.map((one: Record<string, unknown>) => make("td", {}, String(one[name] ?? "")));
    return make("tr", {}, make("th", {}, name), ...values);
  });
  const texts = [...new Set(replays.map(({ run }) => run.ini))].filter(Boolean);
  const ini = texts.flatMap((text) => [make("h3", {}, "Configuration file"), make("pre", { tabindex: "0" }, text)]);
  return dialog("What was run", make("table", {}, make("tbody", {}, ...rows)), ...ini);
}
