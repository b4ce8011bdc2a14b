// One option in the panel: its name, a slider, a field, a menu or a box to tick, and its unit.
import { element } from './dom';
import type { Parameter } from './protocol';
import { rounded, scaleOf } from './range';

/** goesOn: with the change before it this is one, as of a slider that is dragged. */
export type Change = (value: number[], goesOn: boolean) => void;

export interface ParameterRow {
  element: HTMLElement;
  /** Shows these values, but for what the user is changing. */
  show(value: readonly number[]): void;
}

interface Control {
  elements: HTMLElement[];
  show(value: readonly number[]): void;
}

const steps = 1000;

function textOf(value: number): string {
  return String(Number(value.toPrecision(Math.abs(value) < 1 ? 4 : 6)));
}

function numberField(parameter: Parameter, at: number, change: (value: number) => void): HTMLInputElement {
  const field = element('input', { type: 'number', step: 'any' });
  field.addEventListener('input', () => field.classList.add('editing'));
  field.addEventListener('blur', () => field.classList.remove('editing'));
  if (Number.isFinite(parameter.min)) field.min = String(parameter.min);
  if (Number.isFinite(parameter.max)) field.max = String(parameter.max);
  field.setAttribute('aria-label', `${parameter.option.replaceAll('_', ' ')}${'xyz'[at] ?? ''}`);
  field.addEventListener('change', () => {
    field.classList.remove('editing');
    const value = field.valueAsNumber;
    if (Number.isFinite(value)) change(parameter.kind === 'integer' ? Math.round(value) : value);
  });
  return field;
}

function showIn(field: HTMLInputElement, value: number | undefined): void {
  if (value !== undefined && !field.classList.contains('editing')) field.value = textOf(value);
}

function numberControl(parameter: Parameter, change: Change): Control {
  const first = parameter.value[0] ?? 0;
  const field = numberField(parameter, 3, (value) => change([value], false));
  const scale = scaleOf(parameter, first);
  if (scale === null) return { elements: [field], show: (value) => showIn(field, value[0]) };
  const slider = element('input', { type: 'range', min: '0', max: String(steps), step: '1' });
  slider.setAttribute('aria-label', parameter.option.replaceAll('_', ' '));
  let isDragging = false;
  slider.addEventListener('input', () => {
    const at = scale.valueAt(slider.valueAsNumber / steps);
    const value = parameter.kind === 'integer' ? Math.round(at) : rounded(at);
    field.value = textOf(value);
    change([value], isDragging);
    isDragging = true;
  });
  const end = (): void => {
    isDragging = false;
  };
  slider.addEventListener('change', end);
  slider.addEventListener('pointerup', end);
  const show = (value: readonly number[]): void => {
    showIn(field, value[0]);
    if (!isDragging) slider.value = String(Math.round(steps * scale.placeOf(value[0] ?? 0)));
  };
  return { elements: [slider, field], show };
}

function vectorControl(parameter: Parameter, change: Change): Control {
  let now: readonly number[] = parameter.value;
  const fields: HTMLInputElement[] = [0, 1, 2].map((at) => numberField(parameter, at, () => {
    change(fields.map((field, i) => (Number.isFinite(field.valueAsNumber) ? field.valueAsNumber : now[i] ?? 0)), false);
  }));
  const show = (value: readonly number[]): void => {
    now = value;
    fields.forEach((field, i) => showIn(field, value[i]));
  };
  return { elements: fields, show };
}

function choiceControl(parameter: Parameter, change: Change): Control {
  const menu = element('select', {});
  parameter.choices.forEach((choice, i) => menu.append(element('option', { value: String(i) }, choice)));
  menu.addEventListener('change', () => change([Number(menu.value)], false));
  return { elements: [menu], show: (value) => { menu.value = String(value[0] ?? 0); } };
}

function flagControl(change: Change): Control {
  const box = element('input', { type: 'checkbox' });
  box.addEventListener('change', () => change([box.checked ? 1 : 0], false));
  return { elements: [box], show: (value) => { box.checked = value[0] === 1; } };
}

function controlOf(parameter: Parameter, change: Change): Control {
  switch (parameter.kind) {
    case 'vector': return vectorControl(parameter, change);
    case 'choice': return choiceControl(parameter, change);
    case 'flag': return flagControl(change);
    default: return numberControl(parameter, change);
  }
}

export function parameterRow(parameter: Parameter, change: Change): ParameterRow {
  const control = controlOf(parameter, change);
  control.show(parameter.value);
  const unit = parameter.unit === '' ? [] : [element('span', { className: 'unit' }, parameter.unit)];
  const name = element('span', { className: 'name' }, parameter.option.replaceAll('_', ' '));
  const row = element('div', { className: `row ${parameter.kind}`, title: parameter.doc.replaceAll('`', '') }, name,
                      ...control.elements, ...unit);
  return { element: row, show: control.show };
}
