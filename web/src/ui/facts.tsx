// Numbers to see at once, each with its name and unit.
export type Fact = [name: string, value: string | number, unit?: string];

export const FactList = ({ facts, isLive }: { facts: Fact[]; isLive?: boolean }) => (
  <dl class="facts" aria-live={isLive ? 'polite' : undefined}>
    {facts.map(([name, value, unit]) => (
      <div key={name}>
        <dt>{name}</dt>
        <dd>
          {value} {unit && <small>{unit}</small>}
        </dd>
      </div>
    ))}
  </dl>
);
