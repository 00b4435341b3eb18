// Units that a user can switch. Values in memory are always the contract's: kPa gauge, mL, L.
import { effect, signal } from '@preact/signals';

export type PressureUnit = 'kPa' | 'bar' | 'psi';
export type Reference = 'gauge' | 'abs';
export type VolumeUnit = 'mL' | 'L';

const stored = (localStorage.getItem('units') ?? '').split(' ');
const one = <T extends string>(value: string | undefined, allowed: readonly T[]): T =>
  allowed.find((name) => name === value) ?? allowed[0]!;

export const pressureUnits = ['kPa', 'bar', 'psi'] as const;
export const references = ['gauge', 'abs'] as const;
export const volumeUnits = ['mL', 'L'] as const;

export const pressureUnit = signal<PressureUnit>(one(stored[0], pressureUnits));
export const reference = signal<Reference>(one(stored[1], references));
export const volumeUnit = signal<VolumeUnit>(one(stored[2], volumeUnits));
export const ambientKpa = signal(100);

effect(() => {
  localStorage.setItem('units', `${pressureUnit} ${reference} ${volumeUnit}`);
});

const kpaPer: Record<PressureUnit, number> = { kPa: 1, bar: 100, psi: 6.894757293168 };

// What a number is, which decides how it is shown.
export type Kind = 'pressure' | 'absolute' | 'difference' | 'volume_ml' | 'volume_l' | 'plain';

export function unitOf(kind: Kind, plain = ''): string {
  switch (kind) {
    case 'pressure':
      return `${pressureUnit.value} ${reference.value}`;
    case 'absolute': // whatever the reference
      return `${pressureUnit.value} abs`;
    case 'difference': // of two pressures
      return pressureUnit.value;
    case 'volume_ml':
    case 'volume_l':
      return volumeUnit.value;
    default:
      return plain;
  }
}

export function toShown(kind: Kind, value: number): number {
  switch (kind) {
    case 'pressure':
      return (
        (value + (reference.value === 'abs' ? ambientKpa.value : 0)) / kpaPer[pressureUnit.value]
      );
    case 'absolute':
    case 'difference':
      return value / kpaPer[pressureUnit.value];
    case 'volume_ml':
      return volumeUnit.value === 'L' ? value / 1000 : value;
    case 'volume_l':
      return volumeUnit.value === 'mL' ? value * 1000 : value;
    default:
      return value;
  }
}

export const pressuresShown = (values: (number | null)[]): (number | null)[] =>
  values.map((value) => (value === null ? null : toShown('pressure', value)));

export function fromShown(kind: Kind, shown: number): number {
  switch (kind) {
    case 'pressure':
      return (
        clean(shown * kpaPer[pressureUnit.value]) -
        (reference.value === 'abs' ? ambientKpa.value : 0)
      );
    case 'absolute':
    case 'difference':
      return clean(shown * kpaPer[pressureUnit.value]);
    case 'volume_ml':
      return volumeUnit.value === 'L' ? clean(shown * 1000) : shown;
    case 'volume_l':
      return volumeUnit.value === 'mL' ? clean(shown / 1000) : shown;
    default:
      return shown;
  }
}

// Rids a product of the last bits: 0.1 bar is 10 kPa and not 10.000000000000002.
const clean = (value: number): number => Number(value.toPrecision(12));
