// Where the chunks of a run come from: the elements of the page, or a run that still goes on.

import { PackedChunk, Run, RunEnd } from "./format";

export interface Source {
  readonly run: Run;
  /** By time; grows while a run goes on. */
  readonly chunks: readonly PackedChunk[];
  /** How the run ended; null if that is not known. */
  readonly end: RunEnd | null;
  /** Whether more may come. */
  readonly isLive: boolean;
  /** Whether the process of the run has gone before its end. */
  readonly isLost: boolean;
  /** Called when something of this has changed. */
  onChange: (() => void) | null;
  /** Tell the run what the page shows, and how fast it goes on: the run waits for that. */
  tell(timeNs: number, speed: number): void;
}

export const FORMAT = 1;

/** The run that the page itself holds; null if it holds none. */
export function fileSource(): Source | null {
  const run = jsonElement<Run>("gradysim-run");
  if (run === null) return null;
  if (run.format !== FORMAT) throw new Error(`a replay of format ${run.format}; expected format ${FORMAT}`);
  const chunks: PackedChunk[] = [];
  for (const element of document.querySelectorAll("script.gradysim-chunk")) {
    try {
      chunks.push(new PackedChunk(element.textContent ?? ""));
    } catch (error) {
      console.warn("the last chunk is not complete", error); // The run was killed while it wrote it.
      break;
    }
  }
  const end = jsonElement<RunEnd>("gradysim-end");
  return { run, chunks, end, isLive: false, isLost: end === null, onChange: null, tell: () => {} };
}

/** What an element of the page holds; null if there is none. */
export function jsonElement<T>(id: string): T | null {
  const element = document.getElementById(id);
  return element === null ? null : (JSON.parse(element.textContent ?? "") as T);
}
