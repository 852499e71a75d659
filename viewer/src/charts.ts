// Charts of tracked variables on one time axis: their zoom and cursor are linked, and the clock is a line in each.

import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { styleColor } from "./colors";
import { make } from "./dom";
import { setText } from "./rows";
import { Series, valueText } from "./variables";

const HEIGHT_PX = 88;
const DASH = [6, 4];

/** A variable of a node. */
export interface Curve {
  series: Series;
  node: string;
  color: () => string;
  dash: boolean;
}

interface Chart {
  curves: Curve[];
  values: HTMLElement[];
  plot: uPlot | null;
  now: HTMLElement;
}

export class Charts {
  readonly element = make("div", { class: "charts" });
  private charts: Chart[] = [];
  private endS = 0;
  private timeS = 0;
  private pointedS: number | null = null;

  /** `showTime` is called with the time of the values: that of the mouse, or of the clock. */
  constructor(
    private readonly seek: (timeNs: number) => void,
    private readonly showTime: (timeS: number) => void,
  ) {
    new ResizeObserver(() => {
      for (const { plot } of this.charts) plot?.setSize({ width: this.element.clientWidth, height: HEIGHT_PX });
    }).observe(this.element);
  }

  /** Show a chart for each name; of those that are shown, what was added. */
  show(byName: ReadonlyMap<string, Curve[]>, endS: number): void {
    const all = [...byName.values()];
    const seriesOf = (charts: readonly Curve[][]): Series[] => charts.flatMap((curves) => curves.map(({ series }) => series));
    const before = seriesOf(this.charts.map(({ curves }) => curves));
    const now = seriesOf(all);
    const view = this.view;
    const wasAll = view === null || view[1] - view[0] >= this.endS;
    this.endS = endS;
    if (before.length === now.length && before.every((series, index) => series === now[index]))
      for (const { plot, curves } of this.charts) plot?.setData(dataOf(curves, endS));
    else {
      for (const { plot } of this.charts) plot?.destroy();
      this.element.replaceChildren();
      const areSeveral = new Set(all.flat().map(({ node }) => node)).size > 1;
      this.charts = all.map((curves) => this.add(curves, areSeveral));
    }
    if (!wasAll) this.zoomTo(...view);
    this.moveTo(this.timeS);
  }

  moveTo(timeS: number): void {
    const view = this.view;
    // A part of the run moves along with the clock.
    if (view && timeS !== this.timeS && (timeS < view[0] || timeS > view[1])) {
      const from = Math.max(0, Math.min(timeS - (view[1] - view[0]) / 4, this.endS - (view[1] - view[0])));
      this.zoomTo(from, from + view[1] - view[0]);
    }
    this.timeS = timeS;
    this.showValues();
    for (const { plot, now } of this.charts) if (plot) this.placeClock(plot, now);
  }

  private placeClock(plot: uPlot, now: HTMLElement): void {
    const x = plot.valToPos(this.timeS, "x");
    now.hidden = !(x >= 0 && x <= plot.over.clientWidth);
    now.style.transform = `translateX(${x}px)`;
  }

  /** The part of the run that is shown. */
  private get view(): [number, number] | null {
    const scale = this.charts.find(({ plot }) => plot !== null)?.plot?.scales.x;
    return scale?.min === undefined || scale.max === undefined ? null : [scale.min, scale.max];
  }

  private zoomTo(min: number, max: number): void {
    for (const { plot } of this.charts) plot?.setScale("x", { min, max });
  }

  private showValues(): void {
    const timeS = this.pointedS ?? this.timeS;
    this.showTime(timeS);
    for (const { curves, values } of this.charts)
      for (const [index, { series }] of curves.entries()) setText(values[index], valueText(series, timeS));
  }

  private add(curves: Curve[], areSeveral: boolean): Chart {
    const values = curves.map(({ node, color }) => {
      const value = make("span", { title: node });
      if (areSeveral) value.style.color = color();
      return value;
    });
    const head = make("div", { class: "row" }, make("span", {}, curves[0].series.name), make("span", { class: "end" }, ...values));
    const box = make("div", {}, head);
    this.element.append(box);
    const now = make("div", { class: "now" });
    const isNumeric = curves.some(({ series }) => series.values.some((number) => number !== null));
    return { curves, values, plot: isNumeric ? this.plot(curves, box, now) : null, now };
  }

  private plot(curves: Curve[], box: HTMLElement, now: HTMLElement): uPlot {
    const axis = {
      stroke: () => styleColor("--muted"),
      grid: { stroke: () => styleColor("--line"), width: 1 },
      ticks: { show: false },
      font: "11px system-ui, sans-serif",
    };
    const plot = new uPlot(
      {
        width: Math.max(100, this.element.clientWidth),
        height: HEIGHT_PX,
        legend: { show: false },
        scales: { x: { time: false, range: (_, min, max) => [min, Math.max(max, min + 1e-9)] } },
        cursor: {
          y: false,
          points: { show: false },
          drag: { x: true, y: false, setScale: true },
          sync: { key: "tracked", scales: ["x", null] },
        },
        hooks: {
          draw: [(drawn) => this.placeClock(drawn, now)],
          setCursor: [
            ({ cursor: { left = -1 }, posToVal }) => {
              this.pointedS = left < 0 ? null : posToVal(left, "x");
              this.showValues();
            },
          ],
        },
        axes: [
          { ...axis, size: 24, gap: 6, values: (_, ticks) => ticks.map((tick) => `${tick} s`) },
          { ...axis, size: 44, gap: 2, splits: extremes, values: (_, values) => values.map(shortText) },
        ],
        series: [
          {},
          ...curves.map(({ color, dash }) => ({
            stroke: color,
            dash: dash ? DASH : [],
            width: 1.5,
            points: { show: false },
            paths: uPlot.paths.stepped?.({ align: 1 }),
          })),
        ],
      },
      dataOf(curves, this.endS),
      box,
    );
    plot.over.append(now);
    plot.over.addEventListener("click", (event) => {
      if (plot.select.width === 0) this.seek(plot.posToVal(event.offsetX, "x") * 1e9);
    });
    return plot;
  }
}

/** The smallest and the largest value shown: a chart has no room for more. */
function extremes(plot: uPlot, _axis: number, low: number, high: number): number[] {
  let [least, most] = [Infinity, -Infinity];
  for (const values of plot.data.slice(1))
    for (const value of values) {
      if (value === null || value === undefined || value < low || value > high) continue;
      [least, most] = [Math.min(least, value), Math.max(most, value)];
    }
  return least < most ? [least, most] : least === most ? [least] : [];
}

function shortText(value: number): string {
  if (Math.abs(value) < 1e5) return String(Number(value.toPrecision(5)));
  return value.toLocaleString("en-US", { notation: "compact", maximumSignificantDigits: 4 });
}

/** All charts begin at 0 and go on to the end. */
function dataOf(curves: readonly Curve[], endS: number): uPlot.AlignedData {
  const whole: uPlot.AlignedData = [[0, endS], [null, null]];
  const tables = curves.map(({ series: { timesS, values } }): uPlot.AlignedData => [
    [...timesS, endS],
    [...values, values[values.length - 1]],
  ]);
  const [times, , ...joined] = uPlot.join([whole, ...tables]);
  // Each value holds until the next one, so that it counts in a part of the run without any.
  for (const values of joined)
    for (let index = 1; index < values.length; index += 1)
      if (values[index] === undefined) (values as (number | null | undefined)[])[index] = values[index - 1];
  return [times, ...joined];
}
