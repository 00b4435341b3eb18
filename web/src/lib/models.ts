// What the service can do, and its saved model revisions.
import { signal } from '@preact/signals';

import { get } from './api';

export interface Model {
  name: string;
}

export const models = signal<Model[]>([]);
// "POST /v1/diagnoses" and the like; null until known.
export const routes = signal<Set<string> | null>(null);

export const serves = (route: string): boolean => routes.value?.has(route) ?? false;

export async function refreshModels(): Promise<void> {
  try {
    const table = await get<{ routes: { method: string; path: string }[] }>('/v1');
    routes.value = new Set(table.routes.map((route) => `${route.method} ${route.path}`));
    if (!serves('GET /v1/models')) return;
    const answer = await get<{ models?: Model[] }>('/v1/models');
    models.value = (answer.models ?? []).filter((model) => model.name !== 'nominal');
  } catch {
    models.value = [];
  }
}
