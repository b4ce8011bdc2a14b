// The panel: materials, and every option of the solver, constraints, forces, colliders and contact. Its rows are made
// from the lists that the simulation itself keeps.
import { element } from './dom';
import { type ParameterRow, parameterRow } from './parameter_row';
import type { BodyMaterial, PanelState, Parameter } from './protocol';

export interface PanelActions {
  set(key: string, value: number[], goesOn: boolean): void;
  setMaterial(body: string, material: string): void;
  addWind(): void;
}

/** How the headings begin, and the section that they stand in. */
const solver = 'Solver';
const titles: [prefix: string, title: string][] = [
  ['settings.', solver], ['force:', 'Forces'], ['group:', 'Constraints'], ['collider:', 'Colliders'], ['contact', 'Contact'],
];
const order = ['Forces', 'Constraints', 'Contact', 'Colliders', solver];

function titleOf(parameter: Parameter): string {
  return titles.find(([prefix]) => parameter.key.startsWith(prefix))?.[1] ?? solver;
}

function shapeOf(state: PanelState): string {
  return JSON.stringify([
    state.parameters.map((each) => [each.key, each.heading, each.kind, each.choices]),
    state.materials.map((each) => [each.body, each.choices.map((choice) => choice.name)]),
  ]);
}

export class Panel {
  private shape = '';
  private rows = new Map<string, ParameterRow>();
  private materials = new Map<string, HTMLSelectElement>();
  /** Which sections stand open, from scene to scene. */
  private readonly open = new Map<string, boolean>([['Materials', true], ['Forces', true]]);

  /** view: what of the picture can be chosen, below the materials. */
  constructor(private readonly root: HTMLElement, private readonly view: HTMLElement,
              private readonly actions: PanelActions) {}

  show(state: PanelState): void {
    const shape = shapeOf(state);
    if (shape !== this.shape) this.rebuild(state);
    this.shape = shape;
    for (const each of state.parameters) this.rows.get(each.key)?.show(each.value);
    for (const each of state.materials) {
      const menu = this.materials.get(each.body);
      if (menu !== undefined) menu.value = each.material;
    }
  }

  /** Rows begin anew, as with another scene. */
  reset(): void {
    this.shape = '';
  }

  private rebuild(state: PanelState): void {
    this.rows.clear();
    this.materials.clear();
    const sections: HTMLElement[] = [];
    if (state.materials.length > 0) sections.push(this.materialSection(state.materials));
    sections.push(this.view);
    for (const title of order) {
      const parameters = state.parameters.filter((each) => titleOf(each) === title);
      if (parameters.length > 0 || title === 'Forces') sections.push(this.parameterSection(title, parameters));
    }
    const focused = document.activeElement?.getAttribute('aria-label');
    const { scrollTop } = this.root;
    this.root.replaceChildren(...sections);
    this.root.scrollTop = scrollTop;
    const again = [...this.root.querySelectorAll<HTMLElement>('[aria-label]')].find((each) => each.ariaLabel === focused);
    if (focused !== null && focused !== undefined) again?.focus({ preventScroll: true });
  }

  private section(title: string, content: HTMLElement[], key = title): HTMLElement {
    const details = element('details', { className: 'section' }, element('summary', {}, title), ...content);
    details.open = this.open.get(key) ?? false;
    details.addEventListener('toggle', () => this.open.set(key, details.open));
    return details;
  }

  private materialSection(materials: BodyMaterial[]): HTMLElement {
    const rows = materials.map((each) => {
      const menu = element('select', { title: 'What this body is made of', ariaLabel: `Material of ${each.body}` });
      if (each.material === '') menu.append(element('option', { value: '' }, 'its own constraints'));
      for (const choice of each.choices) {
        menu.append(element('option', { value: choice.name, title: choice.description }, choice.name));
      }
      menu.value = each.material;
      menu.addEventListener('change', () => {
        if (menu.value !== '') this.actions.setMaterial(each.body, menu.value);
      });
      this.materials.set(each.body, menu);
      return element('label', { className: 'row' }, element('span', { className: 'name' }, each.body), menu);
    });
    return this.section('Materials', rows);
  }

  private parameterSection(title: string, parameters: Parameter[]): HTMLElement {
    const content: HTMLElement[] = [];
    const owners = new Map<string, Parameter[]>();
    for (const each of parameters) owners.set(each.heading, [...(owners.get(each.heading) ?? []), each]);
    for (const [heading, own] of owners) {
      const rows = own.map((each) => {
        const row = parameterRow(each, (value, goesOn) => this.actions.set(each.key, value, goesOn));
        this.rows.set(each.key, row);
        return row.element;
      });
      const key = `${title}/${heading}`;
      if (owners.size === 1 && !this.open.has(key)) this.open.set(key, true);
      content.push(...(heading === '' ? rows : [this.section(heading, rows, key)]));
    }
    if (title === 'Forces' && !parameters.some((each) => each.heading.startsWith('wind'))) {
      const button = element('button', { className: 'wide', title: 'Adds a wind along x; the scene starts over' }, 'Add wind');
      button.addEventListener('click', () => this.actions.addWind());
      content.push(button);
    }
    return this.section(title, content);
  }
}
