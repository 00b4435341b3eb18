// What a service that others can reach asks for first.
import { useSignal } from '@preact/signals';

import { takeToken, wantsToken } from '../lib/api';
import { Notice, Panel } from '../ui/controls';

export function TokenView() {
  const token = useSignal('');
  return (
    <Panel first title="This service asks for a token">
      {wantsToken.value === 'refused' && (
        <Notice kind="bad">The token given is not known, or it has ended.</Notice>
      )}
      <p>
        Whoever runs it makes one with <code>plenum token create</code>: with{' '}
        <code>--scope read</code> one may look, with <code>--scope write</code> also search,
        diagnose and change the catalogue. It is kept until this window is closed.
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
        {wantsToken.value === 'change' && (
          <button type="button" onClick={() => (wantsToken.value = '')}>
            Back
          </button>
        )}
      </form>
    </Panel>
  );
}
