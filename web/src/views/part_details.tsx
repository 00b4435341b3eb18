// What a part carries beside its numbers: series, aliases, offers; its documents in the form.
import { isAddress } from '../lib/catalogue';
import type { Document, Offer, Part } from '../lib/types';
import { Chip } from '../ui/controls';
import { number, Table } from '../ui/table';

// A text of the catalogue as a link, only where it is an address of the web.
export function Address({ text }: { text: string }) {
  return isAddress(text) ? (
    <a href={text} target="_blank" rel="noopener noreferrer">
      {text}
    </a>
  ) : (
    <>{text}</>
  );
}

export function OrderableChip({ part }: { part: Part }) {
  if (part.orderable === null) return null;
  return part.orderable ? (
    <Chip kind="good">can be ordered</Chip>
  ) : (
    <Chip>no product to order</Chip>
  );
}

export function PartDetails({ part }: { part: Part }) {
  return (
    <>
      {part.series && (
        <p>
          Series <b>{part.series}</b>
        </p>
      )}
      {part.aliases.length > 0 && <p>Also {part.aliases.join(', ')}</p>}
      {part.offers.length > 0 && <Offers offers={part.offers} />}
    </>
  );
}

function Offers({ offers }: { offers: Offer[] }) {
  return (
    <Table
      label="Offers"
      class="sources"
      heads={['supplier', number('price'), number('pack'), 'date', 'link']}
    >
      {offers.map((offer, i) => (
        <tr key={i}>
          <th scope="row">{offer.supplier}</th>
          <td class="num">
            {offer.price} {offer.currency}
          </td>
          <td class="num">{offer.pack}</td>
          <td class="nowrap">{offer.date || '–'}</td>
          <td class="source">
            <Address text={offer.link} />
          </td>
        </tr>
      ))}
    </Table>
  );
}

// The same lists as text for the form, one item a line, its members between bars.
export const offersText = (offers: Offer[] | undefined): string =>
  (offers ?? [])
    .map((o) =>
      [o.supplier, o.price, o.currency, o.pack, o.date, o.link].join(' | ').replace(/[ |]+$/, ''),
    )
    .join('\n');

export const documentsText = (documents: Document[] | undefined): string =>
  (documents ?? []).map((d) => (d.sha256 ? `${d.link} | ${d.sha256}` : d.link)).join('\n');

const linesOf = (text: string): string[] =>
  text
    .split('\n')
    .map((line) => line.trim())
    .filter(Boolean);

const membersOf = (line: string): string[] => line.split('|').map((member) => member.trim());

// A member that is left out stays out, so that the service names it where it is required; what is
// no number is sent as it stands and refused with its place.
const numberOrText = (text: string | undefined): unknown => {
  if (!text) return undefined;
  const value = Number(text);
  return Number.isFinite(value) ? value : text;
};

export const readOffers = (text: string): unknown[] =>
  linesOf(text).map((line) => {
    const [supplier, price, currency, pack, date, link, ...rest] = membersOf(line);
    return {
      supplier,
      price: numberOrText(price),
      currency,
      pack: numberOrText(pack),
      date,
      link: link === undefined ? undefined : [link, ...rest].join('|'),
    };
  });

export const readDocuments = (text: string): unknown[] =>
  linesOf(text).map((line) => {
    const members = membersOf(line);
    const last = members[members.length - 1]!;
    const hasDigest = members.length > 1 && /^[0-9a-f]{64}$/.test(last);
    return {
      link: (hasDigest ? members.slice(0, -1) : members).join('|'),
      sha256: hasDigest ? last : '',
    };
  });

export const readAliases = (text: string): string[] => linesOf(text);
