// A drawing of width × height units, as large as the text around it.
import type { ComponentChildren } from 'preact';

import { pageScale } from '../lib/page_scale';

export const Picture = (props: { width: number; height: number; children: ComponentChildren }) => (
  <svg
    viewBox={`0 0 ${props.width} ${props.height}`}
    width={props.width * pageScale.value}
    height={props.height * pageScale.value}
  >
    {props.children}
  </svg>
);
