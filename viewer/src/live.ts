// The chunks of a run that goes on, from `gradysim view`, over a WebSocket.

import { PackedChunk, Run, RunEnd } from "./format";
import { connect, Source } from "./source";

/** Between two messages to the run, in milliseconds. */
const TELL_MS = 100;

class LiveSource implements Source {
  readonly isLive = true;
  readonly follows = false;
  readonly chunks: PackedChunk[] = [];
  run!: Run;
  end: RunEnd | null = null;
  isLost = false;
  onChange: (() => void) | null = null;
  private told = "";
  private toldMs = 0;

  constructor(
    private readonly socket: WebSocket,
    started: () => void,
  ) {
    socket.binaryType = "arraybuffer";
    socket.addEventListener("message", ({ data }) => {
      if (typeof data !== "string") this.chunks.push(new PackedChunk(new Uint8Array(data)));
      else Object.assign(this, JSON.parse(data) as { run?: Run; end?: RunEnd });
      if (this.run && (this.chunks.length || this.end)) started();
      this.onChange?.();
    });
    socket.addEventListener("close", () => {
      this.isLost = this.end === null;
      this.onChange?.();
    });
  }

  tell(timeNs: number, speed: number): void {
    const message = JSON.stringify({ time_s: timeNs / 1e9, speed });
    const nowMs = performance.now();
    if (message === this.told || nowMs - this.toldMs < TELL_MS || this.socket.readyState !== WebSocket.OPEN) return;
    [this.told, this.toldMs] = [message, nowMs];
    this.socket.send(message);
  }
}

/** Connect to the run that the page names; null if it names none. */
export function liveSource(): Promise<Source> | null {
  return connect("gradysim-live", (socket, started) => new LiveSource(socket, started));
}
