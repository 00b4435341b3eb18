// Of a list that is older than the catalogue: that it is, and by which parts.
import { ranksInWords, ranksWith } from '../lib/list_changes';
import { useHead } from '../lib/revisions';
import type { Answer } from '../lib/types';
import { Notice } from '../ui/controls';
import { RankAgainButton } from '../ui/job';
import { PartsChanged, useCatalogueChanges } from './list_changes';

export function MovedOn({ answer }: { answer: Answer }) {
  const head = useHead();
  const mine = answer.catalogue_revision;
  const isOld = head !== null && mine !== undefined && head.hash !== mine.hash;
  const changes = useCatalogueChanges(
    isOld ? mine.number : undefined,
    isOld ? head.number : undefined,
  );
  if (!isOld) return null;
  const uses = ({ id }: { id: string }) => {
    const ranks = ranksWith(answer.designs, id);
    return ranks.length > 0 ? `part of ${ranksInWords(ranks)}` : '';
  };
  return (
    <Notice kind="warn">
      The catalogue has moved on: this list is of revision {mine.number}, the catalogue is at
      revision {head.number}. What is said here holds for the parts as they were.{' '}
      <RankAgainButton answer={answer} label="Rank with the catalogue as it is" />
      {changes && <PartsChanged changes={changes} uses={uses} />}
    </Notice>
  );
}
