// The timeline: how many receptions were lost when, and where the clock is. Drag to seek, wheel to zoom.

import { outcomeColor, styleColor } from "./colors";
import { clockText, countText, prepareCanvas, timeText } from "./dom";
import { Replay } from "./replay";

const AXIS_PX = 18;

/** Room for the names of the lanes. */
const LEFT_PX = 50;

/** The part of a run that is shown. Timelines may share it. */
export interface Window {
  fromNs: number;
  /** 0: the end of the run. */
  toNs: number;
}

export class Timeline {
  readonly element: HTMLCanvasElement;
  private hoverX: number | null = null;
  private bars = { frames: new Float64Array(0), lost: new Float64Array(0) };

  constructor(
    private readonly replay: Replay,
    private readonly seek: (timeNs: number) => void,
    private readonly redraw: () => void,
    private readonly shown: Window = { fromNs: 0, toNs: 0 },
  ) {
    this.element = document.createElement("canvas");
    this.element.className = "timeline";
    this.element.tabIndex = 0;
    this.element.setAttribute("role", "slider");
    this.element.setAttribute("aria-label", "Time");
    this.element.addEventListener("pointerdown", (event) => {
      this.element.setPointerCapture(event.pointerId);
      this.seek(this.timeAt(event.offsetX));
    });
    this.element.addEventListener("pointermove", (event) => {
      if (event.buttons & 1) this.seek(this.timeAt(event.offsetX));
      this.hoverX = event.offsetX;
      this.redraw();
    });
    this.element.addEventListener("pointerleave", () => {
      this.hoverX = null;
      this.redraw();
    });
    this.element.addEventListener("wheel", (event) => this.zoom(event), { passive: false });
    this.element.addEventListener("dblclick", () => {
      Object.assign(this.shown, { fromNs: 0, toNs: 0 });
      this.redraw();
    });
  }

  draw(timeNs: number): void {
    const [context, full, height] = prepareCanvas(this.element);
    const width = full - LEFT_PX;
    const [fromNs, toNs] = this.window(timeNs);
    const heat = height - AXIS_PX;
    context.translate(LEFT_PX, 0);
    this.drawDensity(context, width, heat, fromNs, toNs);
    this.drawAxis(context, width, height, fromNs, toNs);
    const x = ((timeNs - fromNs) / (toNs - fromNs)) * width;
    context.fillStyle = styleColor("--accent");
    context.fillRect(x - 1, 0, 2, height);
    context.beginPath();
    context.moveTo(x - 6, 0);
    context.lineTo(x + 6, 0);
    context.lineTo(x, 8);
    context.fill();
    if (this.hoverX !== null && this.hoverX >= LEFT_PX) this.drawReadout(context, width, this.hoverX - LEFT_PX);
    this.element.setAttribute("aria-valuenow", timeText(timeNs, 3));
    this.element.setAttribute("aria-valuemax", timeText(this.replay.durationNs, 3));
    this.element.setAttribute("aria-valuetext", `${timeText(timeNs, 3)} s`);
  }

  /** The part of the run that is shown: it moves along with the clock. */
  private window(timeNs: number): [number, number] {
    const endNs = this.replay.durationNs;
    if (this.shown.toNs === 0) return [0, endNs];
    const span = this.shown.toNs - this.shown.fromNs;
    if (timeNs < this.shown.fromNs || timeNs > this.shown.toNs) {
      this.shown.fromNs = Math.min(Math.max(0, timeNs - span / 4), endNs - span);
      this.shown.toNs = this.shown.fromNs + span;
    }
    return [this.shown.fromNs, this.shown.toNs];
  }

  private timeAt(x: number): number {
    const [fromNs, toNs] = this.shown.toNs === 0 ? [0, this.replay.durationNs] : [this.shown.fromNs, this.shown.toNs];
    const width = this.element.clientWidth - LEFT_PX;
    return fromNs + (Math.min(Math.max(0, x - LEFT_PX), width) / width) * (toNs - fromNs);
  }

  private zoom(event: WheelEvent): void {
    event.preventDefault();
    const endNs = this.replay.durationNs;
    const [fromNs, toNs] = this.shown.toNs === 0 ? [0, endNs] : [this.shown.fromNs, this.shown.toNs];
    const at = this.timeAt(event.offsetX);
    const factor = Math.exp(Math.sign(event.deltaY) * 0.25);
    const span = Math.min(endNs, Math.max(1e6, (toNs - fromNs) * factor));
    this.shown.fromNs = Math.min(Math.max(0, at - ((at - fromNs) / (toNs - fromNs)) * span), endNs - span);
    this.shown.toNs = span >= endNs ? 0 : this.shown.fromNs + span;
    this.redraw();
  }

  private drawDensity(
    context: CanvasRenderingContext2D,
    width: number,
    height: number,
    fromNs: number,
    toNs: number,
  ): void {
    const bars = Math.max(1, Math.floor(width));
    const frames = new Float64Array(bars);
    const lost = new Float64Array(bars);
    const perBar = (toNs - fromNs) / bars;
    for (const { header } of this.replay.chunks) {
      if (header.end_ns < fromNs || header.start_ns > toNs) continue;
      const { bin_ns, frames: began, lost: losses } = header.density;
      for (let bin = 0; bin < began.length; bin += 1) {
        const start = (header.start_ns + bin * bin_ns - fromNs) / perBar;
        const end = (Math.min(header.start_ns + (bin + 1) * bin_ns, header.end_ns) - fromNs) / perBar;
        // Share it among the bars that it covers.
        for (let bar = Math.max(0, Math.floor(start)); bar < Math.min(bars, end); bar += 1) {
          const share = (Math.min(end, bar + 1) - Math.max(start, bar)) / Math.max(end - start, 1e-9);
          frames[bar] += began[bin] * share;
          lost[bar] += losses[bin] * share;
        }
      }
    }
    this.bars = { frames, lost };
    if (this.replay.hasFrames) this.drawLanes(context, frames, lost, height);
    const recorded = ((this.replay.endNs - fromNs) / (toNs - fromNs)) * width;
    if (recorded < width) {
      context.fillStyle = styleColor("--panel");
      context.fillRect(recorded, 0, width - recorded, height);
    }
  }

  private drawLanes(context: CanvasRenderingContext2D, frames: Float64Array, lost: Float64Array, height: number): void {
    const top = Math.round(height * 0.36);
    this.drawLane(context, frames, 0, top - 2, styleColor("--quiet"));
    this.drawLane(context, lost, top, height, outcomeColor("interference"));
    context.font = "11px system-ui, sans-serif";
    context.textBaseline = "bottom";
    context.fillStyle = styleColor("--muted");
    context.fillText("frames", -LEFT_PX, top);
    context.fillText("losses", -LEFT_PX, height);
  }

  /** Bars from zero to the most; high ones are stronger in color, too. */
  private drawLane(
    context: CanvasRenderingContext2D,
    values: Float64Array,
    top: number,
    bottom: number,
    color: string,
  ): void {
    const most = values.reduce((a, b) => Math.max(a, b), 0);
    context.fillStyle = color;
    values.forEach((value, bar) => {
      if (value < 1e-6) return;
      const share = value / most;
      context.globalAlpha = 0.35 + 0.65 * share;
      const tall = Math.max(2, share * (bottom - top));
      context.fillRect(bar, bottom - tall, 1, tall);
    });
    context.globalAlpha = 1;
  }

  /** What there was at the place of the mouse. */
  private drawReadout(context: CanvasRenderingContext2D, width: number, x: number): void {
    const bar = Math.min(Math.floor(x), this.bars.frames.length - 1);
    const [frames, lost] = [this.bars.frames[bar], this.bars.lost[bar]].map((count) =>
      count > 0 && count < 1 ? "< 1" : countText(Math.round(count)),
    );
    const counts = this.replay.hasFrames ? `: ${frames} frames, ${lost} losses` : "";
    const text = `${timeText(this.timeAt(x + LEFT_PX), 3)} s${counts}`;
    const wide = context.measureText(text).width + 12;
    const left = Math.min(x + 10, width - wide);
    context.fillStyle = styleColor("--panel");
    context.strokeStyle = styleColor("--line");
    context.lineWidth = 1;
    context.beginPath();
    context.roundRect(left, 0.5, wide, 18, 4);
    context.fill();
    context.stroke();
    context.fillStyle = styleColor("--ink");
    context.textBaseline = "middle";
    context.fillText(text, left + 6, 10);
    context.fillRect(x, 0, 1, 18);
  }

  private drawAxis(
    context: CanvasRenderingContext2D,
    width: number,
    height: number,
    fromNs: number,
    toNs: number,
  ): void {
    const steps = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5, 1, 5, 10, 30, 60, 300, 600, 1800, 3600, 18_000, 86_400];
    const most = Math.max(2, width / 90);
    const step = (steps.find((s) => (toNs - fromNs) / 1e9 / s <= most) ?? 1e6) * 1e9;
    context.font = "11px system-ui, sans-serif";
    context.textBaseline = "bottom";
    context.fillStyle = styleColor("--muted");
    for (let mark = Math.ceil(fromNs / step) * step; mark <= toNs; mark += step) {
      const x = ((mark - fromNs) / (toNs - fromNs)) * width;
      context.fillRect(Math.round(x), height - AXIS_PX, 1, 5);
      const text = step < 1e9 ? `${Number((mark / 1e9).toFixed(6))} s` : clockText(mark);
      const wide = context.measureText(text).width;
      context.fillText(text, Math.min(Math.max(1, x - wide / 2), width - wide - 1), height);
    }
  }
}
