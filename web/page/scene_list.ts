// The dialog in which a scene is chosen.
import { byId, element } from './dom';
import { allScenes, thumbnailOf } from './gallery';
import type { SceneEntry } from './protocol';

function cardOf(entry: SceneEntry, choose: (name: string) => void): HTMLButtonElement {
  const picture = element('img', { src: thumbnailOf(entry.name), alt: '', loading: 'lazy' });
  const card = element('button', { className: 'card', type: 'button', title: entry.description }, picture,
                       element('strong', {}, entry.name.replaceAll('_', ' ')), element('span', {}, entry.description));
  card.addEventListener('click', () => choose(entry.name));
  return card;
}

export class SceneList {
  private readonly dialog = byId('scenes', HTMLDialogElement);
  private readonly cards = byId('cards', HTMLDivElement);
  private readonly search = byId('search', HTMLInputElement);
  private entries: { name: string; words: string; card: HTMLButtonElement }[] = [];

  constructor(private readonly open: (name: string) => void, openFiles: (files: File[]) => void) {
    const files = byId('files', HTMLInputElement);
    files.addEventListener('change', () => {
      this.dialog.close();
      if (files.files !== null && files.files.length > 0) openFiles([...files.files]);
      files.value = '';
    });
    byId('open-file', HTMLButtonElement).addEventListener('click', () => files.click());
    this.search.addEventListener('input', () => this.filter());
    this.search.addEventListener('keydown', (event) => {
      if (event.key !== 'Enter') return;
      event.preventDefault();
      this.entries.find(({ card }) => !card.hidden)?.card.click();
    });
    this.dialog.addEventListener('click', (event) => {
      if (event.target === this.dialog) this.dialog.close();
    });
  }

  fill(builtin: SceneEntry[]): void {
    this.entries = allScenes(builtin).map((entry) => ({
      name: entry.name,
      words: `${entry.name.replaceAll('_', ' ')} ${entry.description}`.toLowerCase(),
      card: cardOf(entry, (name) => {
        this.dialog.close();
        this.open(name);
      }),
    }));
    this.cards.replaceChildren(...this.entries.map(({ card }) => card));
  }

  names(): string[] {
    return this.entries.map(({ name }) => name);
  }

  show(): void {
    this.search.value = '';
    this.filter();
    this.dialog.showModal();
  }

  private filter(): void {
    const words = this.search.value.toLowerCase().split(/\s+/);
    for (const entry of this.entries) entry.card.hidden = !words.every((word) => entry.words.includes(word));
  }
}
