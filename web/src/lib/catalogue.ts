// Parts of the catalogue: families, single parts by id, whole families.
import { signal } from '@preact/signals';

import { ask, get } from './api';
import type { Family, Part, Provenance } from './types';

export const families = signal<Family[]>([]);
export const familyCounts = signal<Record<string, number>>({});
// The part that was added last in this visit, until it is no longer told of.
export const added = signal<Part | null>(null);
export const revision = signal<{ number: number; hash: string } | null>(null);

interface Page {
  parts: Part[];
  next_cursor: string | null;
  total: number;
  facets?: { texts: Record<string, Record<string, number>> };
  catalogue_revision: { number: number; hash: string };
}

// What the list knows of a part beside its fields, under the names that the service filters by.
export const derivedTexts = ['priced', 'documented'] as const;
export const estimatedShare = 'estimated_share';

function withDerived(part: Part): Part {
  const kinds = Object.values(part.provenance).map((from) => from.kind);
  const estimated = kinds.filter((kind) => kind === 'estimated').length;
  const hasPrice = Object.keys(part).some((field) => field.startsWith('price_eur'));
  return {
    ...part,
    priced: String(hasPrice),
    documented: String(part.documents.length > 0),
    [estimatedShare]: kinds.length ? estimated / kinds.length : undefined,
  };
}

// The first document that is an address of the web.
export const sheetOf = (part: Part): string | undefined =>
  part.documents.find(({ link }) => isAddress(link))?.link;

// Any other scheme could run a script or open a file.
export const isAddress = (text: string): boolean => /^https?:\/\/\S+$/i.test(text);

const searching = (words: string): string => (words ? `&q=${encodeURIComponent(words)}` : '');

// With how many parts of each have the words in any of their texts.
export async function loadFamilies(words = ''): Promise<void> {
  if (families.value.length === 0)
    families.value = (await get<{ families: Family[] }>('/v1/families')).families;
  const page = await get<Page>(`/v1/parts?limit=1&facets=true${searching(words)}`);
  familyCounts.value = page.facets?.texts.family ?? {};
  revision.value = page.catalogue_revision;
}

export async function loadFamily(family: string, words = ''): Promise<Part[]> {
  const parts: Part[] = [];
  let cursor = '';
  for (;;) {
    const page = await get<Page>(
      `/v1/parts?family=${encodeURIComponent(family)}&limit=1000${searching(words)}${cursor && `&cursor=${encodeURIComponent(cursor)}`}`,
    );
    parts.push(...page.parts.map(withDerived));
    revision.value = page.catalogue_revision;
    if (!page.next_cursor) return parts;
    cursor = page.next_cursor;
  }
}

export interface Comparison {
  parts: Part[];
  fields: {
    field: string;
    differs: boolean;
    values: unknown[];
    provenance: (Provenance['kind'] | null)[];
  }[];
}

export const loadComparison = (ids: string[]): Promise<Comparison> =>
  get<Comparison>(`/v1/parts/compare?ids=${ids.map(encodeURIComponent).join(',')}`);

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
