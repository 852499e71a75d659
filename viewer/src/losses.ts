// Why receivers lost a frame: the power that arrived, what was needed, and what took the rest. The engine
// computed it with the models of the run; gradysim.replay.losses has the same words.

import { distanceText } from "./dom";
import { NO_POWER, Table } from "./format";
import { senderOf } from "./frame_text";
import { Frame, Replay } from "./replay";
import { countUntil } from "./tables";

/** Powers in dBm, gains in dB; null: none, or unknown. */
export interface Loss {
  sent: number | null;
  power: number | null;
  /** null: the frame was below the sensitivity of the receiver. */
  noise: number | null;
  interference: number | null;
  /** Without noise the sensitivity, otherwise the SINR with which half of such frames survive. */
  needed: number;
  /** In dB, only if there is no power. */
  pathLoss: number;
  gains: { name: string; gain: number }[];
  interferers: { node: number; power: number | null }[];
}

/** Smaller gains are not shown in full. */
const LEAST = -300;
const SHOWN = 0.05;

/** Return what is known of the losses of a frame, by receiver. */
export async function readLosses(replay: Replay, { chunk, row }: Frame): Promise<Map<number, Loss>> {
  const names = ["losses", "obstructions", "interferers"];
  const [losses, obstructions, interferers] = await Promise.all(names.map((name) => chunk.table(name)));
  const found = new Map<number, Loss>();
  const sender = replay.nameOf(chunk.frames.table.node[row]);
  for (const index of rowsOf(losses, row)) {
    const receiver = losses.receiver[index];
    const gains = [
      { name: `antenna of ${sender}`, gain: losses.sender_antenna_cdb[index] / 100 },
      { name: `antenna of ${replay.nameOf(receiver)}`, gain: losses.receiver_antenna_cdb[index] / 100 },
      ...["ground", "shadowing", "fading"].map((name) => ({ name, gain: losses[`${name}_cdb`][index] / 100 })),
    ];
    found.set(receiver, {
      sent: dbm(chunk.frames.table.power_cdbm[row]),
      power: dbm(losses.power_cdbm[index]),
      noise: dbm(losses.noise_cdbm[index]),
      interference: dbm(losses.interference_cdbm[index]),
      needed: losses.needed_cdb[index] / 100,
      pathLoss: -losses.distance_cdb[index] / 100,
      gains,
      interferers: [],
    });
  }
  for (const index of rowsOf(obstructions, row))
    found.get(obstructions.receiver[index])?.gains.push({
      name: replay.run.obstacles[obstructions.obstacle[index]].name,
      gain: obstructions.gain_cdb[index] / 100,
    });
  for (const index of rowsOf(interferers, row))
    found
      .get(interferers.receiver[index])
      ?.interferers.push({ node: interferers.node[index], power: dbm(interferers.power_cdbm[index]) });
  return found;
}

/** Return the lines about a receiver that a frame did not reach because of the distance. */
export function farTexts(replay: Replay, frame: Frame, receiver: number): string[] {
  const { table } = frame.chunk.frames;
  const sender = replay.nodes.get(senderOf(frame));
  const needed = replay.nodes.get(receiver)?.far_loss?.sensitivity_dbm;
  const sent = dbm(table.power_cdbm[frame.row]);
  const distance = between(replay, frame, senderOf(frame), receiver);
  if (sent === null) {
    const range = sender?.range_m ?? null;
    return range === null ? [] : [`the range is ${distanceText(range)}`];
  }
  if (!sender?.far_loss || needed === undefined || table.interface[frame.row] !== 0) return [];
  const { loss_at_1m_db, exponent, is_mean } = sender.far_loss;
  const pathLoss = loss_at_1m_db + exponent * 10 * Math.log10(distance);
  const loss = { sent, power: sent - pathLoss, noise: null, interference: null, needed, pathLoss, gains: [] };
  const text = needText({ ...loss, interferers: [] });
  return [is_mean ? `about ${text}` : text, pathText({ ...loss, interferers: [] }, distanceText(distance))];
}

/** Return the lines that explain a loss. */
export function lossTexts(replay: Replay, frame: Frame, receiver: number, loss: Loss): string[] {
  const with_ = loss.interferers.map(({ node, power }) => {
    const facts = [distanceText(between(replay, frame, node, receiver))];
    if (power !== null) facts.unshift(dbmText(power));
    return `${replay.nameOf(node)} (${facts.join(", ")})`;
  });
  const others = with_.length ? [`with ${with_.join(", ")}`] : [];
  if (loss.sent === null) return others;
  const distance = distanceText(between(replay, frame, senderOf(frame), receiver));
  return [...others, needText(loss), pathText(loss, distance)];
}

/** "-91.2 dBm, needs -85.0 dBm: 6.2 dB short" */
function needText({ power, noise, interference, needed }: Loss): string {
  const parts = [power === null ? "no power" : dbmText(power)];
  let had = power;
  if (noise !== null && power !== null) {
    const others = [noise, ...(interference === null ? [] : [interference])];
    had = power - 10 * Math.log10(others.reduce((sum, other) => sum + 10 ** (other / 10), 0));
    const words = [`noise ${dbmText(noise)}`, ...(interference === null ? [] : [`interference ${dbmText(interference)}`])];
    parts.push(...words, `SINR ${had.toFixed(1)} dB`);
  }
  let need = "needs";
  let short = "";
  if (had !== null && noise !== null && needed <= had) need = "half of such frames need";
  else if (had !== null) short = needed - had < SHOWN ? ": just short" : `: ${(needed - had).toFixed(1)} dB short`;
  return `${parts.join(", ")}, ${need} ${needed.toFixed(1)} ${noise === null ? "dBm" : "dB"}${short}`;
}

/** "of 14.9 dBm, 247 m take 88.1 dB, West block takes 18.0 dB" */
function pathText({ sent, power, pathLoss, gains }: Loss, distance: string): string {
  const ordered = [...gains].sort((a, b) => a.gain - b.gain);
  const taken = ordered
    .filter(({ gain }) => gain < -SHOWN)
    .map(({ name, gain }) => `${name} ${gain < LEAST ? `over ${-LEAST}` : (-gain).toFixed(1)} dB`);
  const added = ordered.filter(({ gain }) => gain > SHOWN).map(({ name, gain }) => `${name} adds ${gain.toFixed(1)} dB`);
  const others = gains.reduce((sum, { gain }) => sum + gain, 0);
  const loss = power === null ? pathLoss : (sent ?? 0) + others - power;
  return [`${distance} take ${loss.toFixed(1)} dB of ${dbmText(sent ?? 0)}`, ...taken, ...added].join(", ");
}

/** The rows of a table, sorted by frame, that belong to a frame. */
function* rowsOf(table: Table, frame: number): Generator<number> {
  for (let row = countUntil(table.frame, frame - 1); table.frame[row] === frame; row += 1) yield row;
}

/** The distance of two nodes when a frame began, in meters. */
export function between(replay: Replay, frame: Frame, a: number, b: number): number {
  const [from, to] = [replay.position(a, frame), replay.position(b, frame)];
  return Math.hypot(from[0] - to[0], from[1] - to[1], from[2] - to[2]);
}

function dbm(power: number): number | null {
  return power === NO_POWER ? null : power / 100;
}

function dbmText(power: number): string {
  return `${power.toFixed(1)} dBm`;
}
