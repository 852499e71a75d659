// How a run wants to be drawn: the commands of its VisualizationController.

export interface Look {
  /** Colors of nodes: red, green and blue, from 0 to 1. */
  colors: Map<number, [number, number, number]>;
  /** Nodes whose names are hidden. */
  nameless: Set<number>;
  /** "#rrggbb", or "" for that of the page. */
  background: string;
  /** Radius of the nodes in meters, or 0 for marks of constant size on the screen. */
  radiusM: number;
}

export interface Command {
  command: string;
  payload: { node_id: number; color: [number, number, number]; size: number; show: boolean };
}

export function plainLook(): Look {
  return { colors: new Map(), nameless: new Set(), background: "", radiusM: 0 };
}

export function copyOf({ colors, nameless, background, radiusM }: Look): Look {
  return { colors: new Map(colors), nameless: new Set(nameless), background, radiusM };
}

export function apply(look: Look, { command, payload }: Command): void {
  const { node_id: node, color, size, show } = payload;
  if (command === "paint_node") look.colors.set(node, [color[0] / 255, color[1] / 255, color[2] / 255]);
  else if (command === "paint_environment") look.background = hexColor(color);
  else if (command === "resize_nodes") look.radiusM = size;
  else if (command === "show_node_id" && show) look.nameless.delete(node);
  else if (command === "show_node_id") look.nameless.add(node);
}

/** "#rrggbb" of parts from 0 to 1; larger ones are 1. */
function hexColor(parts: number[]): string {
  const bytes = parts.map((part) => Math.round(255 * Math.min(1, part)));
  return `#${bytes.map((byte) => byte.toString(16).padStart(2, "0")).join("")}`;
}
