// Charts of tracked variables, with the clock as a line.

import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { styleColor } from "./colors";
import { make } from "./dom";
import { setText } from "./rows";
import { Series, valueText } from "./variables";

const HEIGHT_PX = 84;

export class Charts {
  readonly element = make("div", { class: "charts" });
  private readonly charts: { series: Series; value: HTMLElement; plot: uPlot | null; now: HTMLElement }[] = [];

  constructor(private readonly seek: (timeNs: number) => void) {
    new ResizeObserver(() => {
      for (const { plot } of this.charts) plot?.setSize({ width: this.element.clientWidth, height: HEIGHT_PX });
    }).observe(this.element);
  }

  /** Show these series; of those that are shown, what was added. */
  show(all: Iterable<Series>, endS: number): void {
    const series = [...all];
    this.charts.forEach((chart, place) => {
      if (chart.plot && chart.series === series[place]) chart.plot.setData(dataOf(chart.series, endS));
    });
    for (const one of series.slice(this.charts.length)) {
      const value = make("span", { class: "end" });
      const box = make("div", {}, make("div", { class: "row" }, make("span", {}, one.name), value));
      this.element.append(box);
      const now = make("div", { class: "now" });
      const isNumeric = one.values.some((number) => number !== null);
      this.charts.push({ series: one, value, plot: isNumeric ? this.plot(one, endS, box, now) : null, now });
    }
  }

  clear(): void {
    for (const { plot } of this.charts) plot?.destroy();
    this.charts.length = 0;
    this.element.replaceChildren();
  }

  moveTo(timeS: number): void {
    for (const { series, value, plot, now } of this.charts) {
      setText(value, valueText(series, timeS));
      if (plot) now.style.transform = `translateX(${plot.valToPos(timeS, "x")}px)`;
    }
  }

  private plot(series: Series, endS: number, box: HTMLElement, now: HTMLElement): uPlot {
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
        cursor: { y: false, points: { show: false }, drag: { x: true, y: false, setScale: true } },
        axes: [
          { ...axis, size: 20, gap: 2, values: (_, ticks) => ticks.map((tick) => `${tick} s`) },
          { ...axis, size: 44, gap: 2, splits: extremes, values: (_, values) => values.map(shortText) },
        ],
        series: [
          {},
          {
            stroke: () => styleColor("--curve"),
            width: 1.5,
            points: { show: false },
            paths: uPlot.paths.stepped?.({ align: 1 }),
          },
        ],
      },
      dataOf(series, endS),
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
  for (const value of plot.data[1] as (number | null)[]) {
    if (value === null || value < low || value > high) continue;
    [least, most] = [Math.min(least, value), Math.max(most, value)];
  }
  return least < most ? [least, most] : least === most ? [least] : [];
}

function shortText(value: number): string {
  if (Math.abs(value) < 1e5) return String(Number(value.toPrecision(5)));
  return value.toLocaleString("en-US", { notation: "compact", maximumSignificantDigits: 4 });
}

/** The last value holds until the end. */
function dataOf({ timesS, values }: Series, endS: number): [number[], (number | null)[]] {
  return [
    [...timesS, endS],
    [...values, values[values.length - 1]],
  ];
}
