// What to do with a part that was added: see it, and rank with it.
import { useEffect } from 'preact/hooks';

import { added } from '../lib/catalogue';
import { pathOf, previousJob, useJob } from '../lib/jobs';
import { link } from '../lib/route';
import { Notice } from '../ui/controls';
import { RankAgainButton } from '../ui/job';

export function Added() {
  useEffect(() => () => void (added.value = null), []);
  const part = added.value;
  const id = previousJob.value;
  const answer = useJob(part && id ? pathOf(id) : null)?.job?.result;
  if (!part) return null;
  return (
    <Notice kind="good">
      Added{' '}
      <a href={link(['catalogue', part.family], { part: part.id })}>
        {part.manufacturer} {part.part_number}
      </a>
      . The next search takes it into account.{' '}
      {answer && (
        <RankAgainButton answer={answer} label={`Rank ${answer.name || 'the last search'} again`} />
      )}
    </Notice>
  );
}
