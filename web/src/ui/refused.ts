// Where a form is sent back to: the field that is wrong.
const openAround = (element: Element): void => {
  const closed = element.closest('details:not([open])');
  if (!closed) return;
  (closed as HTMLDetailsElement).open = true;
  openAround(closed.parentElement!);
};

function focus(element: HTMLElement | null | undefined): boolean {
  if (!element) return false;
  openAround(element);
  element.focus();
  return true;
}

// The field at a pointer of the document; of a part of it that has no field of its own the first
// field within.
export const focusOn = (pointer: string): boolean =>
  focus(
    document.querySelector<HTMLElement>(`[data-pointer="${pointer}"]`) ??
      document.querySelector<HTMLElement>(`[data-pointer^="${pointer}/"]`),
  );

// The first field that is marked as wrong; where none is, what the errors name.
export function focusFirstWrong(within: ParentNode, pointers: string[]): boolean {
  return (
    focus(within.querySelector<HTMLElement>('[aria-invalid="true"]')) || pointers.some(focusOn)
  );
}
