// A picture or a film of the scene: what its canvases show, on one canvas, at least twice as sharp as the screen needs.

import { inkOn, styleColor } from "./colors";
import { Clock } from "./clock";
import { make, sharpness, timeText } from "./dom";
import { Film } from "./film";

const SHARP = 2;

/** An element with canvases on top of each other, and what is written below. */
export interface Stage {
  stage: HTMLElement;
  title: string;
}

export class Capture {
  private film: { canvas: HTMLCanvasElement; record: Film } | null = null;
  /** Whether a film starts or ends: until then, the key may be pressed again. */
  private isBusy = false;

  /** `draw` draws the canvases anew, `say` shows a message. */
  constructor(
    private readonly stages: () => readonly Stage[],
    private readonly clock: Clock,
    private readonly draw: () => Promise<void>,
    private readonly say: (text: string) => void,
  ) {}

  get isRecording(): boolean {
    return this.film !== null;
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
    if (this.isBusy) return;
    this.isBusy = true;
    try {
      await (this.film === null ? this.startFilm() : this.endFilm(this.film.record));
    } finally {
      this.isBusy = false;
    }
  }

  private async startFilm(): Promise<void> {
    if (typeof VideoEncoder === "undefined") {
      this.say("This browser cannot record a film here: it does not offer VideoEncoder.");
      return;
    }
    sharpness.least = SHARP;
    const canvas = make("canvas");
    this.compose(canvas);
    const fail = ({ message }: DOMException): void => {
      this.leaveFilm();
      this.say(`This browser cannot record a film: ${message}`);
    };
    this.film = { canvas, record: new Film(canvas, fail) };
    await this.draw();
  }

  private async endFilm(record: Film): Promise<void> {
    await this.draw();
    this.leaveFilm();
    this.download(await record.end(), "webm");
    await this.draw();
  }

  private leaveFilm(): void {
    this.film = null;
    sharpness.least = 1;
  }

  /** Add what was drawn to the film, if one is recorded. Call it after each drawing: canvases lose it later. */
  add(): void {
    if (this.film === null) return;
    this.copy(this.film.canvas);
    this.film.record.add();
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
