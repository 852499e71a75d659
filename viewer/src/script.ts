// What scripts and tests can ask of the page: `await gradysim.ready; await gradysim.state(12.5)`.

import { Replay } from "./replay";

export interface RunState {
  time_s: number;
  /** Of each node, by id: x, y, z in meters. */
  positions: [number, number, number][];
  /** How many frames began until this time. */
  frames: number;
  /** What became of them at receivers. */
  outcomes: Record<string, number>;
}

export interface ScriptInterface {
  ready: Promise<void>;
  /** Show a time, in seconds; resolves when it is drawn. */
  seek(timeS: number): Promise<void>;
  /** Return what the run was like at a time, in seconds. */
  state(timeS: number): Promise<RunState>;
}

export function scriptInterface(
  app: { ready: Promise<void>; show(timeNs: number): Promise<void> },
  replay: Replay,
): ScriptInterface {
  return {
    ready: app.ready,
    seek: (timeS) => app.show(timeS * 1e9),
    async state(timeS) {
      const timeNs = timeS * 1e9;
      await replay.load(timeNs);
      const flat = replay.positions(timeNs);
      const tally = replay.tally(timeNs);
      const sums = tally.sums(null).map((count, outcome): [string, number] => [replay.run.outcomes[outcome], count]);
      const outcomes = Object.fromEntries(sums.filter(([, count]) => count));
      const ids = [...replay.nodes.keys()].sort((a, b) => a - b);
      const positions = ids.map((id): [number, number, number] => [
        flat[id * 3],
        flat[id * 3 + 1],
        flat[id * 3 + 2],
      ]);
      return { time_s: timeS, positions, frames: tally.frames, outcomes };
    },
  };
}
