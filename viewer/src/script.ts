// What scripts and tests can ask of the page: `await gradysim.ready; await gradysim.state(12.5)`.

import { App } from "./app";

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

export function scriptInterface(app: App): ScriptInterface {
  const { replay } = app;
  return {
    ready: app.ready,
    seek: (timeS) => app.show(timeS * 1e9),
    async state(timeS) {
      const timeNs = timeS * 1e9;
      await replay.load(timeNs);
      const places = replay.positions(timeNs);
      const tally = replay.tally(timeNs);
      const { frames, counts } = tally;
      const names = replay.run.outcomes;
      const outcomes: Record<string, number> = {};
      counts.forEach((count, place) => {
        const name = names[place % names.length];
        if (count) outcomes[name] = (outcomes[name] ?? 0) + count;
      });
      const unnoticed = tally.unnoticedAt(null);
      if (unnoticed) outcomes[names[replay.unnoticed]] = unnoticed;
      const ids = [...replay.nodes.keys()].sort((a, b) => a - b);
      const positions = ids.map((id): [number, number, number] => [
        places[id * 3],
        places[id * 3 + 1],
        places[id * 3 + 2],
      ]);
      return { time_s: timeS, positions, frames, outcomes };
    },
  };
}
