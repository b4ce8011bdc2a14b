/** How large a canvas is on the page, in CSS pixels, and when that changes. */
export class CanvasSize {
  width = 1;
  height = 1;
  private readonly observer: ResizeObserver;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly changed: () => void) {
    this.measure();
    this.observer = new ResizeObserver(() => {
      this.measure();
      this.changed();
    });
    this.observer.observe(canvas);
  }

  dispose(): void {
    this.observer.disconnect();
  }

  private measure(): void {
    this.width = Math.max(this.canvas.clientWidth, 1);
    this.height = Math.max(this.canvas.clientHeight, 1);
  }
}
