// What of the picture can be chosen: what colors show, with a legend, and the wireframe.
import { byId, element } from './dom';
import type { ColorMap, Frame } from './protocol';

const stops = 8;

export interface ViewActions {
  color(map: ColorMap | null): void;
  wireframe(on: boolean): void;
}

function nameOf(map: ColorMap): string {
  return map.title.replace(/ \[.*/, '');
}

function textOf(value: number): string {
  return String(Number(value.toPrecision(3)));
}

export class ViewSection {
  readonly element: HTMLDetailsElement;
  private readonly menu = element('select', { title: 'What the colors of the bodies show (C: the next)', ariaLabel: 'Color' });
  private readonly box = element('input', { type: 'checkbox', title: 'The edges of the triangles (W)', ariaLabel: 'Wireframe' });
  private readonly legend = byId('legend', HTMLDivElement);
  private maps: ColorMap[] = [];

  constructor(private readonly actions: ViewActions) {
    const row = (name: string, control: HTMLElement): HTMLElement =>
      element('label', { className: 'row' }, element('span', { className: 'name' }, name), control);
    this.element = element('details', { className: 'section' }, element('summary', {}, 'View'), row('color', this.menu),
                           row('wireframe', this.box));
    this.menu.append(element('option', { value: '' }, 'of the bodies'));
    this.menu.addEventListener('change', () => this.choose());
    this.box.addEventListener('change', () => actions.wireframe(this.box.checked));
  }

  fill(maps: ColorMap[]): void {
    if (this.maps.length > 0) return;
    this.maps = maps;
    for (const map of maps) this.menu.append(element('option', { value: map.name }, nameOf(map)));
  }

  nextColor(): void {
    this.menu.selectedIndex = (this.menu.selectedIndex + 1) % this.menu.options.length;
    this.choose();
  }

  toggleWireframe(): void {
    this.box.checked = !this.box.checked;
    this.actions.wireframe(this.box.checked);
  }

  /** The numbers at the ends of the legend; there is none where colors show nothing. */
  show(values: Frame['values']): void {
    const map = this.chosen;
    this.legend.hidden = values === null || map === null;
    if (values === null || map === null) return;
    const [low, high] = [values.low, values.high].map((value) => textOf(value * map.scale));
    const text = `${low} ${high} ${map.name}`;
    if (this.legend.dataset['shown'] === text) return;
    this.legend.dataset['shown'] = text;
    const count = map.tones.length / 3 - 1;
    const tones = Array.from({ length: stops }, (_, i) => {
      const at = 3 * Math.round((count * i) / (stops - 1));
      return `rgb(${map.tones.slice(at, at + 3).join(' ')})`;
    });
    const bar = element('i', {});
    bar.style.background = `linear-gradient(to right, ${tones.join(', ')})`;
    this.legend.replaceChildren(element('b', {}, map.title), bar, element('span', {}, low ?? ''), element('span', {}, high ?? ''));
  }

  private get chosen(): ColorMap | null {
    return this.maps.find((each) => each.name === this.menu.value) ?? null;
  }

  private choose(): void {
    this.actions.color(this.chosen);
  }
}
