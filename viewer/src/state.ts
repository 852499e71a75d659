// What the person who looks has chosen.

import { Frame } from "./replay";

export interface State {
  /** The chosen node. */
  node: number | null;
  /** The chosen frame. */
  frame: Frame | null;
  /** Nodes whose lanes and variables stay when another node is chosen. */
  pinned: readonly number[];
  filter: string;
  isFollowing: boolean;
  labels: boolean;
  legend: boolean;
  trails: boolean;
  /** Whether the sequence chart is open. */
  sequence: boolean;
}

/** What a button switches on and off. */
export type Switch = "isFollowing" | "labels" | "trails" | "legend" | "sequence";

export class Store {
  private state: State = {
    node: null,
    frame: null,
    pinned: [],
    filter: "",
    isFollowing: false,
    labels: true,
    legend: window.innerWidth > 860,
    trails: true,
    sequence: false,
  };
  private readonly listeners: ((changed: Partial<State>) => void)[] = [];

  get now(): Readonly<State> {
    return this.state;
  }

  set(changed: Partial<State>): void {
    this.state = { ...this.state, ...changed };
    for (const listener of this.listeners) listener(changed);
  }

  onChange(listener: (changed: Partial<State>) => void): void {
    this.listeners.push(listener);
  }
}
