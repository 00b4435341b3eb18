// One tooltip for everything that carries data-tip, on hover and on focus; a popover, so that it is
// above a modal window, too.
import { signal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

const tip = signal<{ text: string; x: number; y: number; below: boolean } | null>(null);

function show(event: Event) {
  const target = (event.target as Element | null)?.closest?.('[data-tip]') as HTMLElement | null;
  const text = target?.dataset.tip;
  if (!target || !text) {
    tip.value = null;
    return;
  }
  const box = target.getBoundingClientRect();
  const below = box.top < 90;
  tip.value = { text, x: box.left + box.width / 2, y: below ? box.bottom + 6 : box.top - 6, below };
}

export function Tooltip() {
  useEffect(() => {
    const hide = () => {
      tip.value = null;
    };
    addEventListener('pointerover', show);
    addEventListener('focusin', show);
    addEventListener('scroll', hide, true);
    addEventListener('keydown', hide);
    return () => {
      removeEventListener('pointerover', show);
      removeEventListener('focusin', show);
      removeEventListener('scroll', hide, true);
      removeEventListener('keydown', hide);
    };
  }, []);
  const now = tip.value;
  if (!now) return null;
  const x = Math.min(Math.max(now.x, 150), Math.max(150, innerWidth - 150));
  return (
    <div
      class={`tooltip ${now.below ? 'below' : ''}`}
      role="tooltip"
      popover="manual"
      ref={(at: HTMLDivElement | null) => {
        if (at && !at.matches(':popover-open')) at.showPopover();
      }}
      style={{ left: `${x}px`, top: `${now.y}px` }}
    >
      {now.text}
    </div>
  );
}
