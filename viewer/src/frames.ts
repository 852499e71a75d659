// The list of frames around the clock, with its filter.

import { outcomeColor } from "./colors";
import { make, timeText } from "./dom";
import { Filter, KEYS } from "./filter";
import { causeText, messageOf, outcomeWords, routeText } from "./frame_text";
import { Frame, isSameFrame, Replay, startOf } from "./replay";
import { setText, showRows } from "./rows";
import { Store } from "./state";

const BEFORE = 30;
const AFTER = 15;
const ROW_PX = 24;
const SHOWN_CHARACTERS = 100;

/** Whether a frame of the whole run fits, as far as that is known. */
interface Search {
  filter: Filter;
  /** How many chunks were searched. */
  chunks: number;
  hasFound: boolean;
  isReading: boolean;
}

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
  private search: Search | null = null;

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
    if (!this.replay.hasFrames) return;
    if (this.field.value !== this.store.now.filter && document.activeElement !== this.field)
      this.field.value = this.store.now.filter;
    const before = this.around(timeNs, filter, -1, BEFORE).reverse();
    const after = this.around(timeNs, filter, 1, AFTER);
    const focused = this.shown[this.indexOfFocus()];
    this.shown = [...before, ...after];
    setText(this.note, this.shown.length ? "" : this.noteOf(filter));
    showRows(this.list, this.shown, frameButton, (element, frame) => this.fill(element, frame, timeNs));
    this.keepFocus(focused);
    const top = before.length * ROW_PX - this.list.clientHeight * 0.6;
    // The frame of now is in view; while the mouse is about to click another one, only a chosen one is.
    if (!this.list.matches(":hover")) this.list.scrollTop = top;
    else if (this.store.now.frame !== null) {
      const end = before.length * ROW_PX;
      this.list.scrollTop = Math.min(Math.max(this.list.scrollTop, end - this.list.clientHeight), end - ROW_PX);
    }
  }

  private indexOfFocus(): number {
    return [...this.list.children].indexOf(document.activeElement as Element);
  }

  /** Rows change under the focus: let it stay at its frame, so that Enter does not choose another one. */
  private keepFocus(frame: Frame | undefined): void {
    const old = this.indexOfFocus();
    if (old < 0 || frame === undefined) return;
    const index = this.shown.findIndex((other) => isSameFrame(other, frame));
    if (index === old) return;
    (document.activeElement as HTMLElement).blur();
    if (index >= 0) (this.list.children[index] as HTMLElement).focus({ preventScroll: true });
  }

  /** What to say when no frame fits near. */
  private noteOf(filter: Filter): string {
    if (this.search?.filter !== filter) this.search = { filter, chunks: 0, hasFound: false, isReading: false };
    const { chunks, hasFound } = this.search;
    if (hasFound) return "No frame fits near this time. ← and → find the next one.";
    if (chunks < this.replay.chunks.length) void this.readOn();
    else return filter.isEmpty ? "There are no frames." : "No frame of the run fits.";
    return "No frame fits near this time.";
  }

  /** Look for a frame that fits in the chunks that were not searched. */
  private async readOn(): Promise<void> {
    const { search, replay } = this;
    if (search === null || search.isReading) return;
    search.isReading = true;
    while (search === this.search && !search.hasFound && search.chunks < replay.chunks.length) {
      const chunk = await replay.loadChunk(search.chunks);
      for (let row = 0; row < chunk.frames.count && !search.hasFound; row += 1)
        search.hasFound = search.filter.passes(chunk, row);
      search.chunks += 1;
    }
    search.isReading = false;
    this.store.set({}); // say it
  }

  /**
   * Frames that fit, from the clock on, as far as chunks are decoded. The chosen frame is the last one before:
   * others may begin at the same instant.
   */
  private around(timeNs: number, filter: Filter, step: 1 | -1, most: number): Frame[] {
    const found: Frame[] = [];
    const { frame } = this.store.now;
    const chunks = step < 0 ? this.replay.chunksBefore(timeNs) : this.replay.chunksAfter(timeNs);
    for (const chunk of chunks) {
      const { frames } = chunk;
      let until = frames.rowsUntil(timeNs);
      if (frame !== null) {
        const later = chunk.index - frame.chunk.index;
        until = later === 0 ? frame.row + 1 : later < 0 ? frames.count : 0;
      }
      for (let row = step > 0 ? until : until - 1; row >= 0 && row < frames.count; row += step) {
        if (found.length >= most) return found;
        if (filter.passes(chunk, row) || isSameFrame({ chunk, row }, frame)) found.push({ chunk, row });
      }
    }
    return found;
  }

  private fill(element: HTMLElement, frame: Frame, timeNs: number): void {
    const { chunk, row } = frame;
    const { table } = chunk.frames;
    const [time, who, cause, what] = element.children as HTMLCollectionOf<HTMLElement>;
    setText(time, timeText(startOf(frame)));
    setText(who, routeText(this.replay, frame));
    const text = messageOf(frame)?.text.slice(0, SHOWN_CHARACTERS) ?? "";
    setText(cause, [causeText(this.replay, frame), text].filter(Boolean).join(": "));
    element.title = `${who.textContent}, ${cause.textContent}`;
    const { unnoticed, isLost } = this.replay;
    const counts = new Map<number, number>();
    for (const { outcome } of chunk.frames.receptions(row)) counts.set(outcome, (counts.get(outcome) ?? 0) + 1);
    const parts: ([number, number, boolean] | string)[] = [...counts]
      .sort((a, b) => a[0] - b[0])
      .map(([outcome, count]) => [outcome, count, isLost[outcome]]);
    if (this.replay.isInAir(frame)) parts.push("in the air at the end");
    else if (table.receptions[row] && !parts.length) parts.push("not recorded");
    const tooFar = table.unnoticed[row] - (counts.get(unnoticed) ?? 0);
    if (tooFar) parts.push([unnoticed, tooFar, false]);
    showRows(what, parts, () => make("i"), (part, counted) => {
      const name = typeof counted === "string" ? "" : this.replay.run.outcomes[counted[0]];
      setText(part, typeof counted === "string" ? counted : String(counted[1]));
      part.title = name ? outcomeWords(name) : "";
      part.style.setProperty("--color", name ? outcomeColor(name) : "transparent");
      part.className = name ? (typeof counted !== "string" && counted[2] ? "lost" : "") : "none";
    });
    element.classList.toggle("later", startOf(frame) > timeNs);
    element.setAttribute("aria-pressed", String(isSameFrame(frame, this.store.now.frame)));
  }
}

function frameButton(): HTMLButtonElement {
  const parts = ["time", "who", "cause", "what"].map((name) => make("span", { class: name }));
  return make("button", { type: "button" }, ...parts);
}
