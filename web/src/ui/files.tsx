// Files in and out.
import { useRef } from 'preact/hooks';

import { ask, type FieldError } from '../lib/api';

export function FilePicker(props: {
  label: string;
  accept: string;
  onFiles: (files: File[]) => void;
  multiple?: boolean;
  primary?: boolean;
}) {
  const input = useRef<HTMLInputElement>(null);
  return (
    <>
      <button
        type="button"
        class={props.primary ? 'primary' : ''}
        onClick={() => input.current?.click()}
      >
        {props.label}
      </button>
      <input
        ref={input}
        type="file"
        class="only-heard"
        tabIndex={-1}
        aria-label={props.label}
        accept={props.accept}
        multiple={props.multiple}
        onChange={(event) => {
          const files = [...(event.currentTarget.files ?? [])];
          if (files.length) props.onFiles(files);
          event.currentTarget.value = '';
        }}
      />
    </>
  );
}

export function saveFile(name: string, content: BlobPart, type = 'application/json'): void {
  const url = URL.createObjectURL(new Blob([content], { type }));
  const anchor = document.createElement('a');
  anchor.href = url;
  anchor.download = name;
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

// The parts of a family, as the service exports them.
export function ExportButton({ family, label }: { family: string; label: string }) {
  const save = async () => {
    const { body } = await ask<string>('GET', `/v1/parts/export?family=${family}`);
    saveFile(`${family}.csv`, body, 'text/csv');
  };
  return (
    <button type="button" onClick={() => void save().catch(() => undefined)}>
      {label}
    </button>
  );
}

const csvCell = (value: unknown): string => {
  const text = value === null || value === undefined ? '' : String(value);
  return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
};

export const csv = (rows: unknown[][]): string =>
  `${rows.map((row) => row.map(csvCell).join(',')).join('\n')}\n`;

// What the service finds wrong, each with its place in the document.
export const ErrorList = ({ errors }: { errors: FieldError[] }) =>
  errors.length === 0 ? null : (
    <ul>
      {errors.map((error) => (
        <li key={error.pointer + error.detail}>
          <code>{error.pointer || 'the request'}</code> {error.detail}
        </li>
      ))}
    </ul>
  );
