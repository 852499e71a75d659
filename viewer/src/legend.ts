// The legend: what shapes and lines of the 3-D picture stand for.

import { groupColor, outcomeColor, outcomeDash, styleColor } from "./colors";
import { outcomeWords } from "./frame_text";
import { SHAPES } from "./shapes";

const ROW_PX = 18;
const SAMPLE_PX = 26;

/** Draw a row for each group of nodes and each outcome, at the top left of a canvas. */
export function drawLegend(
  context: CanvasRenderingContext2D,
  groups: readonly string[],
  outcomes: readonly string[],
): void {
  const words = [...groups, ...outcomes.map(outcomeWords)];
  const wide = Math.max(...words.map((one) => context.measureText(one).width));
  context.save();
  context.globalAlpha = 0.85;
  context.fillStyle = styleColor("--panel");
  context.beginPath();
  context.roundRect(8, 8, wide + SAMPLE_PX + 26, words.length * ROW_PX + 8, 6);
  context.fill();
  context.globalAlpha = 1;
  words.forEach((text, row) => {
    const y = 12 + (row + 0.5) * ROW_PX;
    if (row < groups.length) drawMark(context, row, 16 + SAMPLE_PX / 2, y);
    else drawLine(context, outcomes[row - groups.length], 16, y);
    context.fillStyle = styleColor("--ink");
    context.fillText(text, 24 + SAMPLE_PX, y);
  });
  context.restore();
}

function drawMark(context: CanvasRenderingContext2D, group: number, x: number, y: number): void {
  context.fillStyle = groupColor(group);
  context.beginPath();
  const shape = group % SHAPES;
  if (shape === 0) context.arc(x, y, 5.5, 0, 2 * Math.PI);
  else {
    const first = shape === 1 ? Math.PI / 4 : -Math.PI / 2;
    const corners = shape === 2 ? 3 : 4;
    for (let corner = 0; corner < corners; corner += 1) {
      const angle = first + (2 * Math.PI * corner) / corners;
      context.lineTo(x + 7 * Math.cos(angle), y + 7 * Math.sin(angle));
    }
  }
  context.fill();
}

function drawLine(context: CanvasRenderingContext2D, outcome: string, x: number, y: number): void {
  const dash = outcomeDash(outcome);
  context.strokeStyle = outcomeColor(outcome);
  context.lineWidth = dash ? 3 : 2;
  context.setLineDash(dash ? [dash, dash * 0.7] : []);
  context.beginPath();
  context.moveTo(x, y);
  context.lineTo(x + SAMPLE_PX, y);
  context.stroke();
}
