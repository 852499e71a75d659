// A picture or a film of the scene: what its canvases show, on one canvas, at least twice as sharp as the screen needs.

import { inkOn, styleColor } from "./colors";
import { Clock } from "./clock";
import { make, sharpness, timeText } from "./dom";

const SHARP = 2;
const FILM = "video/webm";
const FILM_BITS_PER_S = 16e6;
const FRAMES_PER_S = 30;

/** The browser gets the film in parts, as it can keep them on the disk. */
const PART_MS = 1000;

/** How often the last picture is drawn until the film has it. */
const LAST_TRIES = 100;

/** An element with canvases on top of each other, and what is written below. */
export interface Stage {
  stage: HTMLElement;
  title: string;
}

export class Capture {
  private recorder: MediaRecorder | null = null;
  private readonly film = make("canvas");

  /** `draw` draws the canvases anew, `say` shows a message. */
  constructor(
    private readonly stages: () => readonly Stage[],
    private readonly clock: Clock,
    private readonly draw: () => Promise<void>,
    private readonly say: (text: string) => void,
  ) {}

  get isRecording(): boolean {
    return this.recorder !== null;
  }

  async save(): Promise<void> {
    const canvas = make("canvas");
    sharpness.least = SHARP;
    await this.draw();
    this.compose(canvas);
    if (!this.isRecording) sharpness.least = 1;
    canvas.toBlob((blob) => blob && this.download(blob, "png"));
    await this.draw();
  }

  /** Record from now on, or stop and save what was recorded. */
  async toggleFilm(): Promise<void> {
    if (this.recorder !== null) {
      if (this.recorder.state === "recording") await this.recordLast(this.recorder);
      if (this.recorder?.state === "recording") this.recorder.stop();
      return;
    }
    if (typeof MediaRecorder === "undefined" || !MediaRecorder.isTypeSupported(FILM)) {
      this.say("This browser cannot record a film: it does not offer MediaRecorder for WebM.");
      return;
    }
    sharpness.least = SHARP;
    this.compose(this.film);
    const stream = this.film.captureStream(FRAMES_PER_S);
    const parts: Blob[] = [];
    // Before the page is drawn, as the key may be pressed again until then.
    this.recorder = new MediaRecorder(stream, { mimeType: FILM, videoBitsPerSecond: FILM_BITS_PER_S });
    this.recorder.addEventListener("dataavailable", ({ data }) => parts.push(data));
    this.recorder.addEventListener("stop", () => {
      this.recorder = null;
      sharpness.least = 1;
      this.download(new Blob(parts, { type: FILM }), "webm");
      void this.draw();
    });
    await this.draw();
    this.compose(this.film);
    this.recorder.start(PART_MS);
    await this.draw();
  }

  /** Draw, and wait until the film has it: encoding takes time, more than a film may be long. */
  private async recordLast(recorder: MediaRecorder): Promise<void> {
    const nextPart = (): Promise<Blob> =>
      new Promise((done) => {
        recorder.addEventListener("dataavailable", ({ data }) => done(data), { once: true });
        if (recorder.state === "recording") recorder.requestData();
        else done(new Blob());
      });
    await nextPart();
    for (let tries = 0; tries < LAST_TRIES; tries += 1) {
      await this.draw();
      if ((await nextPart()).size > 0) return;
    }
  }

  /** Add what was drawn to the film, if one is recorded. Call it after each drawing: canvases lose it later. */
  add(): void {
    if (this.recorder !== null) this.copy(this.film);
  }

  private compose(canvas: HTMLCanvasElement): void {
    const { width, height } = this.box();
    const ratio = Math.max(window.devicePixelRatio, SHARP);
    [canvas.width, canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
    this.copy(canvas);
  }

  /** Where the stages are on the page. */
  private box(): DOMRect {
    const boxes = this.stages().map(({ stage }) => stage.getBoundingClientRect());
    const [left, top] = [Math.min(...boxes.map((box) => box.left)), Math.min(...boxes.map((box) => box.top))];
    const [right, bottom] = [Math.max(...boxes.map((box) => box.right)), Math.max(...boxes.map((box) => box.bottom))];
    return new DOMRect(left, top, right - left, bottom - top);
  }

  private copy(canvas: HTMLCanvasElement): void {
    const context = canvas.getContext("2d") as CanvasRenderingContext2D;
    const all = this.box();
    context.setTransform(canvas.width / all.width, 0, 0, canvas.height / all.height, 0, 0);
    context.fillStyle = styleColor("--line");
    context.fillRect(0, 0, all.width, all.height);
    for (const { stage, title } of this.stages()) {
      const { left, top, width, height } = stage.getBoundingClientRect();
      const [x, y] = [left - all.left, top - all.top];
      const background = styleColor("--scene");
      context.fillStyle = background;
      context.fillRect(x, y, width, height);
      for (const layer of stage.querySelectorAll("canvas")) context.drawImage(layer, x, y, width, height);
      context.fillStyle = inkOn(background);
      context.font = "12px system-ui, sans-serif";
      context.textAlign = "right";
      context.fillText(`${title} · ${timeText(this.clock.timeNs)} s`, x + width - 12, y + height - 14, width - 24);
    }
  }

  private download(blob: Blob, extension: string): void {
    const name = this.stages().map(({ title }) => title.replace(/ [^\w#.-]* ?/g, "-"));
    const href = URL.createObjectURL(blob);
    make("a", { href, download: `${name.join("-")}-${timeText(this.clock.timeNs, 3)}s.${extension}` }).click();
    setTimeout(() => URL.revokeObjectURL(href), 60_000);
  }
}
