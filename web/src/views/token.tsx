// What a service that others can reach asks for first.
import { useSignal } from '@preact/signals';

import { hasToken, takeToken } from '../lib/api';
import { Notice, Panel } from '../ui/controls';

export function TokenView() {
  const token = useSignal('');
  return (
    <Panel first title="This service asks for a token">
      {hasToken() && <Notice kind="bad">The token given is not known, or it has ended.</Notice>}
      <p>
        Whoever runs it makes one with <code>plenum token create</code>. It is kept until this
        window is closed.
      </p>
      <form
        class="toolbar"
        onSubmit={(event) => {
          event.preventDefault();
          takeToken(token.value.trim());
        }}
      >
        <label>
          Token{' '}
          <input
            type="password"
            autocomplete="off"
            value={token.value}
            onInput={(event) => (token.value = event.currentTarget.value)}
          />
        </label>
        <button type="submit" class="primary" disabled={token.value.trim() === ''}>
          Use it
        </button>
      </form>
    </Panel>
  );
}
