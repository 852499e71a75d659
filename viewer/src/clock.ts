// The time that the page shows.

/** Slowest and fastest, in simulated seconds for a second. */
export const SPEEDS = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];

export class Clock {
  timeNs = 0;
  speed = 1;
  isPlaying = false;

  /** Where it stops, or waits if more may come. */
  endNs = 0;
  mayGrow = false;

  seek(timeNs: number): void {
    this.timeNs = Math.min(Math.max(0, timeNs), this.endNs);
  }

  /** Play, or pause. At the end it starts again. */
  toggle(): void {
    this.isPlaying = !this.isPlaying;
    if (this.isPlaying && this.timeNs >= this.endNs && !this.mayGrow) this.timeNs = 0;
  }

  /** Go on by so many seconds of the wall clock. */
  advance(wallS: number): void {
    if (!this.isPlaying) return;
    this.seek(this.timeNs + wallS * this.speed * 1e9);
    if (this.timeNs >= this.endNs && !this.mayGrow) this.isPlaying = false;
  }
}
