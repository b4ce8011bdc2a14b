// What is told to the user, one below the other.
import { element } from './dom';

/** A note goes by itself [ms]; an error stays until it is closed, or another scene is opened. */
const noteTime = 7000;
const most = 4;

export class Messages {
  constructor(private readonly root: HTMLElement) {}

  note(text: string): void {
    const message = this.add(text, 'note');
    setTimeout(() => message.remove(), noteTime);
  }

  error(text: string): void {
    this.add(text, 'error');
  }

  /** With a button that does something about it; goes by itself as a note. */
  choice(text: string, label: string, act: () => void): void {
    const message = this.add(text, 'note');
    const button = element('button', {}, label);
    button.addEventListener('click', () => {
      message.remove();
      act();
    });
    message.firstElementChild?.after(button);
    setTimeout(() => message.remove(), 2 * noteTime);
  }

  clear(): void {
    this.root.replaceChildren();
  }

  private add(text: string, kind: 'note' | 'error'): HTMLElement {
    for (const old of [...this.root.children]) {
      if (old.firstElementChild?.textContent === text) old.remove();
    }
    const close = element('button', { title: 'Close', ariaLabel: 'Close' }, '×');
    const message = element('p', { className: kind }, element('span', {}, text), close);
    close.addEventListener('click', () => message.remove());
    this.root.append(message);
    while (this.root.children.length > most) this.root.firstElementChild?.remove();
    return message;
  }
}
