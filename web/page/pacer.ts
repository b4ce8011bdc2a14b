// When steps are due.

/**
 * Keeps simulated time in step with the clock where the machine is fast enough. Where it is not, the simulation falls at
 * most `mostBehind` steps behind: a longer lag is forgotten, so that it never has to be made up for.
 */
export class Pacer {
  static readonly mostBehind = 4;
  private last = 0;
  private stepsBehind = 1;

  /** Starts over: the first step is due now [ms]. */
  start(now: number): void {
    this.last = now;
    this.stepsBehind = 1;
  }

  /** How long to wait for the next step of length h [s]; 0 when it is due [ms]. */
  wait(now: number, h: number): number {
    this.stepsBehind = Math.min(this.stepsBehind + (now - this.last) / 1000 / h, Pacer.mostBehind);
    this.last = now;
    return this.stepsBehind >= 1 ? 0 : (1 - this.stepsBehind) * h * 1000;
  }

  /** Call after each step. */
  tookStep(): void {
    this.stepsBehind -= 1;
  }
}
