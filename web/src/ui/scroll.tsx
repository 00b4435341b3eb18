// A box that scrolls where a table does not fit: its first column stays, and a shade at an edge says
// that there is more beyond it. The keyboard reaches it only then.
import { useSignal } from '@preact/signals';
import type { ComponentChildren } from 'preact';
import { useEffect, useRef } from 'preact/hooks';

const edges = ['left', 'right', 'below'] as const;

export function Scroll(props: {
  label: string;
  class?: string;
  onScroll?: (event: Event) => void;
  aside?: ComponentChildren; // over its upper right corner
  children: ComponentChildren;
}) {
  const box = useRef<HTMLDivElement>(null);
  const beyond = useSignal('');
  const scrolls = useSignal(false);
  const look = (at: Element) => {
    const { scrollLeft, scrollWidth, clientWidth, scrollTop, scrollHeight, clientHeight } = at;
    const more = {
      left: scrollLeft,
      right: scrollWidth - clientWidth - scrollLeft,
      below: scrollHeight - clientHeight - scrollTop,
    };
    beyond.value = edges.filter((edge) => more[edge] > 4).join(' ');
    scrolls.value = scrollWidth > clientWidth + 1 || scrollHeight > clientHeight + 1;
  };
  useEffect(() => {
    const at = box.current!;
    const observer = new ResizeObserver(() => look(at));
    observer.observe(at);
    for (const child of at.children) observer.observe(child);
    return () => observer.disconnect();
  }, []);
  return (
    <div class="scroll-frame" data-beyond={beyond.value}>
      <div
        ref={box}
        class={`scroll ${props.class ?? ''}`}
        role="region"
        aria-label={props.label}
        tabIndex={scrolls.value ? 0 : undefined}
        onScroll={(event) => {
          look(event.currentTarget);
          props.onScroll?.(event);
        }}
      >
        {props.children}
      </div>
      {props.aside}
      {edges.map((edge) => (
        <i key={edge} class={`edge ${edge}`} />
      ))}
    </div>
  );
}
