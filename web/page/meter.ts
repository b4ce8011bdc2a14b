// How fast a simulation runs, over the last half second.

interface Step {
  at: number;
  took: number;
  length: number;
}

export class Meter {
  static readonly span = 500;
  private steps: Step[] = [];

  /** A step that ended at `at`, took that long [ms], and is that long itself [s]. */
  add(at: number, took: number, length: number): void {
    this.steps.push({ at, took, length });
    this.forget(at);
  }

  clear(): void {
    this.steps = [];
  }

  /** At this time [ms]; all 0 where no step was taken lately. */
  rates(now: number): { stepMilliseconds: number; stepsPerSecond: number; speed: number } {
    this.forget(now);
    const first = this.steps[0];
    const last = this.steps[this.steps.length - 1];
    if (first === undefined || last === undefined) return { stepMilliseconds: 0, stepsPerSecond: 0, speed: 0 };
    const sum = (of: (step: Step) => number): number => this.steps.reduce((total, step) => total + of(step), 0);
    const stepMilliseconds = sum((step) => step.took) / this.steps.length;
    // From the end of the first step to that of the last.
    const seconds = (last.at - first.at) / 1000;
    if (!(seconds > 0)) return { stepMilliseconds, stepsPerSecond: 1 / last.length, speed: 1 };
    const simulated = sum((step) => step.length) - first.length;
    return { stepMilliseconds, stepsPerSecond: (this.steps.length - 1) / seconds, speed: simulated / seconds };
  }

  private forget(now: number): void {
    const from = now - Meter.span;
    // The last two stay, so that what is slower than the span has a rate too.
    while (this.steps.length > 2 && (this.steps[0]?.at ?? now) < from) this.steps.shift();
  }
}
