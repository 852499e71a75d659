// Where the chunks of a run come from: the elements of the page, or a run that still goes on.

import { PackedChunk, Run, RunEnd, StoredChunk } from "./format";

export interface Source {
  readonly run: Run;
  /** By time; grows while a run goes on. */
  readonly chunks: readonly StoredChunk[];
  /** How the run ended; null if that is not known. */
  readonly end: RunEnd | null;
  /** Whether more may come. */
  readonly isLive: boolean;
  /** Whether the run does not wait for the page, so that the page has to follow. */
  readonly follows: boolean;
  /** Whether the process of the run ended before the run did. */
  readonly isLost: boolean;
  /** Called when something of this has changed. */
  onChange: (() => void) | null;
  /** Tell the run what the page shows, how fast it goes on, and whether it does. */
  tell(timeNs: number, speed: number, isPlaying: boolean): void;
}

export const FORMAT = 2;

/** The run that a page holds, by default this one; null if it holds none. */
export function fileSource(page = document): Source | null {
  const run = jsonElement<Run>("gradysim-run", page);
  if (run === null) return null;
  if (run.format !== FORMAT) throw new Error(`a replay of format ${run.format}; expected format ${FORMAT}`);
  const chunks: PackedChunk[] = [];
  for (const element of page.querySelectorAll("script.gradysim-chunk")) {
    try {
      chunks.push(new PackedChunk(element.textContent ?? ""));
    } catch (error) {
      console.warn("the last chunk is not complete", error); // The run was killed while it wrote it.
      break;
    }
  }
  const end = jsonElement<RunEnd>("gradysim-end", page);
  return { run, chunks, end, isLive: false, follows: false, isLost: end === null, onChange: null, tell: () => {} };
}

/** Connect to the run that an element names; null if there is none. Resolves when there is something to show. */
export function connect(
  id: string,
  create: (socket: WebSocket, started: () => void) => Source,
): Promise<Source> | null {
  const named = jsonElement<{ socket: string }>(id);
  if (named === null) return null;
  return new Promise((resolve, reject) => {
    const socket = openSocket(named.socket);
    const source: Source = create(socket, () => resolve(source));
    socket.addEventListener("close", () => reject(new Error("the run was ended, or does not answer")));
  });
}

/** A WebSocket to the server of the page. */
export function openSocket(path: string): WebSocket {
  return new WebSocket(`ws://${location.host}${path}`);
}

/** What an element of a page holds, by default of this one; null if there is none. */
export function jsonElement<T>(id: string, page = document): T | null {
  const element = page.getElementById(id);
  return element === null ? null : (JSON.parse(element.textContent ?? "") as T);
}
