// Several replays beside each other, on one clock: that in which the person acts tells the others the time.

import { make } from "./dom";
import { openSocket } from "./source";

/** State of a page's clock. */
export interface Told {
  timeNs: number;
  speed: number;
  isPlaying: boolean;
}

/** The replays beside each other: {address: title}. */
export interface Beside {
  /** Path of the WebSocket that tells the server that the page is open. */
  socket: string;
  replays: Record<string, string>;
}

/** Show pages beside each other; what one of them tells goes to the others. */
export function showBeside({ socket, replays }: Beside): void {
  openSocket(socket);
  const frames = Object.entries(replays).map(([address, title]) =>
    make("iframe", { src: address + location.hash, title, sandbox: "allow-scripts" }),
  );
  document.body.className = "beside";
  document.body.append(...frames);
  window.addEventListener("message", (event) => {
    if (!frames.some((frame) => frame.contentWindow === event.source)) return;
    for (const frame of frames)
      if (frame.contentWindow !== event.source) frame.contentWindow?.postMessage(event.data, "*");
  });
}

/** The link of a page to those beside it. */
export class Neighbors {
  /** Whether this page tells the time. */
  leads = false;
  private readonly isAlone = window.parent === window;

  constructor(onTold: (told: Told) => void) {
    if (this.isAlone) return;
    window.addEventListener("message", (event) => {
      if (event.source !== window.parent) return;
      this.leads = false;
      onTold(event.data as Told);
    });
  }

  /** Whether the clock goes on by itself. */
  get mayAdvance(): boolean {
    return this.isAlone || this.leads;
  }

  tell(told: Told): void {
    if (!this.isAlone && this.leads) window.parent.postMessage(told, "*");
  }
}
