// Says that a scene is being opened, once that takes a while.
import { byId } from './dom';

/** What is there sooner says nothing [ms]. */
const patience = 400;

export class Loading {
  private readonly box = byId('loading', HTMLParagraphElement);
  private readonly text = byId('loading-text', HTMLSpanElement);
  private readonly button = byId('give-up', HTMLButtonElement);
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(giveUp: () => void) {
    this.button.addEventListener('click', giveUp);
  }

  begin(name: string): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      this.text.textContent = `Opening ${name.replaceAll('_', ' ')}…`;
      this.box.hidden = this.button.hidden = false;
    }, patience);
  }

  end(): void {
    clearTimeout(this.timer);
    this.box.hidden = true;
  }
}
