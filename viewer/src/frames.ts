// The list of frames around the clock, with its filter.

import { outcomeColor, outcomeWords } from "./colors";
import { make, timeText } from "./dom";
import { Filter, KEYS, senderOf } from "./filter";
import { BROADCAST } from "./format";
import { Frame, isSameFrame, Replay, startOf } from "./replay";
import { setText, showRows } from "./rows";
import { Store } from "./state";

const BEFORE = 30;
const AFTER = 15;
const ROW_PX = 24;

export class FrameList {
  readonly field = make("input", {
    type: "search",
    placeholder: "node:3 outcome:interference",
    title: Object.entries(KEYS)
      .map((entry) => entry.join(": "))
      .join("\n"),
    "aria-label": "Filter of frames",
    spellcheck: "false",
    list: "filter-keys",
  });
  readonly elements: HTMLElement[];
  private readonly mistake = make("p", { class: "mistake", role: "alert" });
  private readonly note = make("p", { class: "message" });
  private readonly list = make("div", { class: "list frames" });
  private shown: Frame[] = [];

  constructor(
    private readonly replay: Replay,
    private readonly store: Store,
    choose: (frame: Frame) => void,
  ) {
    const keys = Object.entries(KEYS).map(([key, words]) => make("option", { value: `${key}:` }, words));
    this.elements = [
      make("div", { class: "row" }, make("h2", {}, "Frames"), this.field),
      make("datalist", { id: "filter-keys" }, ...keys),
      this.mistake,
      this.note,
      this.list,
    ];
    this.field.addEventListener("input", () => store.set({ filter: this.field.value }));
    this.list.addEventListener("click", (event) => {
      const row = (event.target as Element).closest<HTMLElement>("button");
      const frame = row && this.shown[[...this.list.children].indexOf(row)];
      if (frame) choose(frame);
    });
  }

  showMistake(message: string): void {
    setText(this.mistake, message);
  }

  update(timeNs: number, filter: Filter): void {
    if (this.field.value !== this.store.now.filter && document.activeElement !== this.field)
      this.field.value = this.store.now.filter;
    const before = this.around(timeNs, filter, -1, BEFORE).reverse();
    const after = this.around(timeNs, filter, 1, AFTER);
    this.shown = [...before, ...after];
    setText(this.note, this.shown.length ? "" : "No frame fits near this time. ← and → find the next one.");
    showRows(this.list, this.shown, frameButton, (element, frame) => this.fill(element, frame, timeNs));
    // The frame of now is in view, unless the mouse is about to click another one.
    if (!this.list.matches(":hover"))
      this.list.scrollTop = before.length * ROW_PX - this.list.clientHeight * 0.6;
  }

  /** Frames that fit, from the clock on, as far as chunks are decoded. */
  private around(timeNs: number, filter: Filter, step: 1 | -1, most: number): Frame[] {
    const found: Frame[] = [];
    const chunks = step < 0 ? this.replay.chunksBefore(timeNs) : this.replay.chunksAfter(timeNs);
    for (const chunk of chunks) {
      const { frames } = chunk;
      const until = frames.rowsUntil(timeNs);
      for (let row = step > 0 ? until : until - 1; row >= 0 && row < frames.count; row += step) {
        if (found.length >= most) return found;
        if (filter.passes(chunk, row)) found.push({ chunk, row });
      }
    }
    return found;
  }

  private fill(element: HTMLElement, frame: Frame, timeNs: number): void {
    const { chunk, row } = frame;
    const { table } = chunk.frames;
    const [time, who, cause, what] = element.children as HTMLCollectionOf<HTMLElement>;
    setText(time, timeText(startOf(frame)));
    setText(who, `${this.replay.nameOf(senderOf(frame))} → ${destinationText(this.replay, frame)}`);
    setText(cause, causeText(this.replay, frame));
    element.title = `${who.textContent}, ${cause.textContent}`;
    const counts = new Map<number, number>();
    for (const { outcome } of chunk.frames.receptions(row)) counts.set(outcome, (counts.get(outcome) ?? 0) + 1);
    const parts = [...counts].sort((a, b) => a[0] - b[0]);
    showRows(what, parts.length ? parts : [null], () => make("i"), (part, counted) => {
      const name = counted && this.replay.run.outcomes[counted[0]];
      setText(part, counted ? String(counted[1]) : table.receptions[row] ? "not recorded" : "unnoticed");
      part.title = name ? outcomeWords(name) : "";
      part.style.setProperty("--color", name ? outcomeColor(name) : "transparent");
      part.className = counted === null ? "none" : this.replay.isLost[counted[0]] ? "lost" : "";
    });
    element.classList.toggle("later", startOf(frame) > timeNs);
    element.setAttribute("aria-pressed", String(isSameFrame(frame, this.store.now.frame)));
  }
}

export function destinationText(replay: Replay, { chunk, row }: Frame): string {
  const destination = chunk.frames.table.destination[row];
  return destination === BROADCAST ? "all" : replay.nameOf(destination);
}

/** What made a node send the frame: "timer beacon"; of an acknowledgment, its kind. */
export function causeText(replay: Replay, { chunk, row }: Frame): string {
  const { table } = chunk.frames;
  const cause = chunk.strings[table.cause[row]];
  const kind = replay.run.kinds[table.kind[row]];
  return (cause || kind) + (table.retry[row] ? ` (retry ${table.retry[row]})` : "");
}

function frameButton(): HTMLButtonElement {
  const parts = ["time", "who", "cause", "what"].map((name) => make("span", { class: name }));
  return make("button", { type: "button" }, ...parts);
}
