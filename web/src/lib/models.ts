// Saved model revisions that requirements may name.
import { signal } from '@preact/signals';

import { get } from './api';

export interface Model {
  name: string;
  version: number;
  at: string;
}

export const models = signal<Model[]>([]);

export async function refreshModels(): Promise<void> {
  try {
    models.value = (await get<{ models: Model[] }>('/v1/models')).models;
  } catch {
    models.value = [];
  }
}
