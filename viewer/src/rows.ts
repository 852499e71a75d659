// Keeps the elements of a list while its items change, so that a click hits what it was meant for.

/** Make `container` have an element for each item; `update` fills it. */
export function showRows<T, E extends HTMLElement>(
  container: HTMLElement,
  items: readonly T[],
  create: () => E,
  update: (element: E, item: T) => void,
): void {
  while (container.children.length > items.length) container.lastElementChild?.remove();
  while (container.children.length < items.length) container.append(create());
  for (const [index, item] of items.entries()) update(container.children[index] as E, item);
}

/** Set the text of an element if it differs: what is selected stays selected. */
export function setText(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}
