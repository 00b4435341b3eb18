// Parts of the catalogue: families, single parts by id, whole families.
import { signal } from '@preact/signals';

import { ask, get } from './api';
import type { Family, Part } from './types';

export const families = signal<Family[]>([]);
export const familyCounts = signal<Record<string, number>>({});
export const revision = signal<{ number: number; hash: string } | null>(null);

interface Page {
  parts: Part[];
  next_cursor: string | null;
  total: number;
  facets?: { texts: Record<string, Record<string, number>> };
  catalogue_revision: { number: number; hash: string };
}

export async function loadFamilies(): Promise<void> {
  if (families.value.length === 0)
    families.value = (await get<{ families: Family[] }>('/v1/families')).families;
  const page = await get<Page>('/v1/parts?limit=1&facets=true');
  familyCounts.value = page.facets?.texts.family ?? {};
  revision.value = page.catalogue_revision;
}

export async function loadFamily(family: string): Promise<Part[]> {
  const parts: Part[] = [];
  let cursor = '';
  for (;;) {
    const page = await get<Page>(
      `/v1/parts?family=${encodeURIComponent(family)}&limit=1000${cursor && `&cursor=${encodeURIComponent(cursor)}`}`,
    );
    parts.push(...page.parts);
    revision.value = page.catalogue_revision;
    if (!page.next_cursor) return parts;
    cursor = page.next_cursor;
  }
}

export const partPath = (id: string): string => `/v1/parts/${encodeURIComponent(id)}`;

export async function loadPart(id: string): Promise<{ part: Part; etag: string }> {
  const { body, headers } = await ask<Part>('GET', partPath(id));
  return { part: body, etag: headers.get('ETag') ?? '' };
}

export const numberOf = (part: Part, field: string): number | null => {
  const value = part[field];
  return typeof value === 'number' ? value : null;
};

export const provenanceWord = {
  datasheet: 'data sheet',
  third_party: 'third party',
  derived: 'derived',
  estimated: 'estimated',
  measured: 'measured',
} as const;

// "± 5 %" of a number that says how uncertain it is.
export const uncertaintyText = (share: number | undefined): string =>
  share === undefined ? '' : `± ${Number((100 * share).toPrecision(3))} %`;
