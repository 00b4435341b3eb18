// Files in and out.
import { useRef } from 'preact/hooks';

export function FilePicker(props: { label: string; accept: string; onFile: (file: File) => void; primary?: boolean }) {
  const input = useRef<HTMLInputElement>(null);
  return (
    <>
      <button type="button" class={props.primary ? 'primary' : ''} onClick={() => input.current?.click()}>
        {props.label}
      </button>
      <input
        ref={input} type="file" class="only-heard" tabIndex={-1} aria-label={props.label} accept={props.accept}
        onChange={(event) => {
          const file = event.currentTarget.files?.[0];
          if (file) props.onFile(file);
          event.currentTarget.value = '';
        }}
      />
    </>
  );
}

export function saveFile(name: string, text: string, type = 'application/json'): void {
  const url = URL.createObjectURL(new Blob([text], { type }));
  const anchor = document.createElement('a');
  anchor.href = url;
  anchor.download = name;
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

export const csvCell = (value: unknown): string => {
  const text = value === null || value === undefined ? '' : String(value);
  return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
};

export const csv = (rows: unknown[][]): string => `${rows.map((row) => row.map(csvCell).join(',')).join('\n')}\n`;
