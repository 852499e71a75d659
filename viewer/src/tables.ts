// Rows of tables: grouped, or found in a sorted column.

/** Sort rows by group and keep their order within a group: those of group g are `rows[first[g]]` to `rows[first[g + 1] - 1]`. */
export function groupRows(
  groups: ArrayLike<number>,
  count: number,
): { first: Uint32Array; rows: Uint32Array } {
  const first = new Uint32Array(count + 1);
  for (let row = 0; row < groups.length; row += 1) first[groups[row] + 1] += 1;
  for (let group = 0; group < count; group += 1) first[group + 1] += first[group];
  const next = first.slice();
  const rows = new Uint32Array(groups.length);
  for (let row = 0; row < groups.length; row += 1) rows[next[groups[row]]++] = row;
  return { first, rows };
}

/** Return the first index from `low` on, and before `high`, that is not `isBefore`, by binary search; `high` if there is none. */
export function firstNot(isBefore: (index: number) => boolean, high: number, low = 0): number {
  while (low < high) {
    const middle = (low + high) >> 1;
    if (isBefore(middle)) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Return how many of the sorted times are until a time, this one included. */
export function countUntil(times: ArrayLike<number>, time: number): number {
  return firstNot((index) => times[index] <= time, times.length);
}
