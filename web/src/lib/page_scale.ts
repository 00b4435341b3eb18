// How much larger than at a desk everything is drawn: the style sheet's root size over 10 px.
import { signal } from '@preact/signals';

const measured = (): number =>
  parseFloat(getComputedStyle(document.documentElement).fontSize) / 10 || 1;

export const pageScale = signal(measured());
addEventListener('resize', () => (pageScale.value = measured()));
