import { describe, expect, it } from 'vitest';
import { Meter } from '../page/meter';
import { Pacer } from '../page/pacer';

const h = 1 / 60;

describe('the pacer', () => {
  it('lets as many steps be taken as time goes by', () => {
    const pacer = new Pacer();
    pacer.start(0);
    let steps = 0;
    for (let now = 0; now <= 1000; now += 1) {
      while (pacer.wait(now, h) === 0) {
        pacer.tookStep();
        steps += 1;
      }
    }
    expect(steps).toBe(61);
  });

  it('says how long to wait', () => {
    const pacer = new Pacer();
    pacer.start(100);
    expect(pacer.wait(100, h)).toBe(0);
    pacer.tookStep();
    expect(pacer.wait(100, h)).toBeCloseTo(1000 * h);
    expect(pacer.wait(110, h)).toBeCloseTo(1000 * h - 10);
  });

  it('forgets a long lag', () => {
    const pacer = new Pacer();
    pacer.start(0);
    let steps = 0;
    while (pacer.wait(60_000, h) === 0) {
      pacer.tookStep();
      steps += 1;
    }
    expect(steps).toBe(Pacer.mostBehind);
  });
});

describe('the meter', () => {
  it('knows the rates of steps in real time', () => {
    const meter = new Meter();
    for (let i = 1; i <= 100; ++i) meter.add(1000 * h * i, 5, h);
    const rates = meter.rates(100_000 * h);
    expect(rates.stepMilliseconds).toBeCloseTo(5);
    expect(rates.stepsPerSecond).toBeCloseTo(60);
    expect(rates.speed).toBeCloseTo(1);
  });

  it('knows those of steps that take longer than its span', () => {
    const meter = new Meter();
    for (let i = 1; i <= 3; ++i) meter.add(1000 * i, 1000, h);
    expect(meter.rates(3000)).toEqual({ stepMilliseconds: 1000, stepsPerSecond: 1, speed: h });
  });

  it('has none without steps', () => {
    expect(new Meter().rates(5)).toEqual({ stepMilliseconds: 0, stepsPerSecond: 0, speed: 0 });
  });
});
