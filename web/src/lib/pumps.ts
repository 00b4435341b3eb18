// Which actuators pumps without a reservoir feed: all, a group, or one each.
import type { PumpFeed, Requirements } from './types';

export const feedOf = (requirements: Requirements): PumpFeed =>
  requirements.supply?.pumps ?? 'shared';

// Whether all designs are to be without a reservoir.
export const onlyDirect = (requirements: Requirements): boolean =>
  feedOf(requirements) !== 'shared' || requirements.supply?.hold_on === true;

export const actuatorsOf = (requirements: Requirements): number =>
  requirements.actuators.reduce((sum, group) => sum + (group.count ?? 1), 0);

// How many times a design has the pumps of one feed.
export const feedsOf = (requirements: Requirements): number => {
  switch (feedOf(requirements)) {
    case 'shared':
      return 1;
    case 'per_group':
      return requirements.actuators.length;
    case 'per_actuator':
      return actuatorsOf(requirements);
  }
};
