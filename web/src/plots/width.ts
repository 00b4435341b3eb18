import { useSignal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';

import { pageScale } from '../lib/page_scale';

// The width of an element as the page lays it out, in units of `pageScale` pixels.
export function useWidth() {
  const ref = useRef<HTMLDivElement>(null);
  const width = useSignal(0);
  useEffect(() => {
    const element = ref.current;
    if (!element) return;
    const observer = new ResizeObserver(() => {
      width.value = Math.floor(element.clientWidth / pageScale.peek());
    });
    observer.observe(element);
    return () => observer.disconnect();
  }, []);
  return { ref, width: width.value };
}
