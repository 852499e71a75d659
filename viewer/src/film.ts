// A film of a canvas as a WebM file. MediaRecorder would lose pictures that wait for its encoder when it stops.

import { Muxer, StreamTarget } from "webm-muxer";

export const FILM = "video/webm";
const BITS_PER_S = 16e6;
const FRAMES_PER_S = 30;
/** A player can jump to pictures this far apart. A WebM cluster ends before 32 s. */
const KEY_FRAME_MS = 2000;
/** On a slow machine, the film has fewer pictures per second: encoding does not fall further behind. */
const MAX_WAITING = 2;
const PART_BYTES = 2 ** 20;

export class Film {
  private readonly parts: Blob[] = [];
  private readonly muxer: Muxer<StreamTarget>;
  private readonly encoder: VideoEncoder;
  private startMs: number | null = null;
  private lastMs = -Infinity;
  private lastKeyMs = -Infinity;

  /** The size of the canvas stays the same. `fail` is called if the browser cannot encode it. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    fail: (error: DOMException) => void,
  ) {
    const { width, height } = canvas;
    // The browser can keep parts that are blobs on the disk. A stream has them in order, but the muxer wants both arguments.
    const onData = (data: Uint8Array, _position: number): unknown => this.parts.push(new Blob([data as BlobPart]));
    const target = new StreamTarget({ onData, chunked: true, chunkSize: PART_BYTES });
    this.muxer = new Muxer({ target, streaming: true, video: { codec: "V_VP8", width, height } });
    this.encoder = new VideoEncoder({
      output: (chunk, meta) => this.muxer.addVideoChunk(chunk, meta),
      error: fail,
    });
    this.encoder.configure({ codec: "vp8", width, height, bitrate: BITS_PER_S, latencyMode: "realtime" });
  }

  /** Add what the canvas shows, unless the last picture is too recent or the encoder is busy. */
  add(): void {
    const isEarly = performance.now() - this.lastMs < 1000 / FRAMES_PER_S;
    if (isEarly || this.encoder.state !== "configured" || this.encoder.encodeQueueSize >= MAX_WAITING) return;
    this.encode(performance.now() - this.lastKeyMs >= KEY_FRAME_MS);
  }

  /** Add what the canvas shows as the last picture, wait for the encoder, and return the file. */
  async end(): Promise<Blob> {
    this.encode(true); // an encoder may skip other pictures to keep the bitrate
    await this.encoder.flush();
    this.encoder.close();
    this.muxer.finalize();
    return new Blob(this.parts, { type: FILM });
  }

  private encode(keyFrame: boolean): void {
    const nowMs = performance.now();
    this.startMs ??= nowMs;
    const frame = new VideoFrame(this.canvas, { timestamp: Math.round((nowMs - this.startMs) * 1000) });
    this.encoder.encode(frame, { keyFrame });
    frame.close();
    this.lastMs = nowMs;
    if (keyFrame) this.lastKeyMs = nowMs;
  }
}
