// A share as a bar with its number beside it.
import type { ComponentChildren } from 'preact';

export const ShareBar = (props: {
  share: number; // 0 to 1
  mark?: 'least' | 'binding' | '';
  children: ComponentChildren;
}) => (
  <span class="share-bar">
    <span class="track">
      <span
        class={props.mark}
        style={{ width: `${100 * Math.min(1, Math.max(0, props.share))}%` }}
      />
    </span>
    {props.children}
  </span>
);
