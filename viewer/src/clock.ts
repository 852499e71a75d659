// The time that the page shows.

/** Slowest and fastest, in simulated seconds for a second. */
export const SPEEDS = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];

/** Return the slowest speed at which a run is over in 100 s: a whole replay takes about a minute. */
export function speedFor(durationNs: number): number {
  return SPEEDS.find((speed) => durationNs / speed <= 100e9) ?? SPEEDS[SPEEDS.length - 1];
}

/** How long a clock that follows takes to get to the end, in seconds. */
const CATCH_UP_S = 0.25;

export class Clock {
  timeNs = 0;
  speed = 1;
  isPlaying = false;

  /** Where it stops, or waits if more may come. */
  endNs = 0;
  mayGrow = false;

  /** Whether it stays at the end while the run goes on, at the speed of the run. */
  isFollowing = false;
  private rate = 0; // while it follows: nanoseconds for a second

  /** `follows`: whether the run goes on without waiting for the clock. */
  constructor(private readonly follows: boolean) {}

  grow(endNs: number, mayGrow: boolean): void {
    [this.endNs, this.mayGrow] = [endNs, mayGrow];
    this.rate = (endNs - this.timeNs) / CATCH_UP_S;
  }

  seek(timeNs: number): void {
    this.timeNs = Math.min(Math.max(0, timeNs), this.endNs);
    this.isFollowing = this.follows && this.mayGrow && this.timeNs === this.endNs;
  }

  /** Play, or pause. At the end it starts again. */
  toggle(): void {
    this.isPlaying = !this.isPlaying;
    if (this.isPlaying && this.timeNs >= this.endNs && !this.mayGrow) this.seek(0);
  }

  /** Advance by `wallS` seconds of wall time; return whether something has changed. */
  advance(wallS: number): boolean {
    const { timeNs, isPlaying } = this;
    // A run that pauses goes on a little: it is followed to where it stands.
    if (this.isFollowing) this.timeNs = Math.min(this.endNs, timeNs + this.rate * wallS);
    else if (isPlaying) this.seek(timeNs + wallS * this.speed * 1e9);
    if (this.timeNs >= this.endNs && !this.mayGrow) this.isPlaying = false;
    return timeNs !== this.timeNs || isPlaying !== this.isPlaying;
  }
}
