// Short names of joints or markers for places with little space. The full name is shown on hover.

/** Maximum length; longer names lose their middle. */
const longest = 18;
const ellipsis = '\u2026';

/** The beginning that all names share, up to a sign that ends a prefix: "mixamorig:", "Subject_1|". */
function commonPrefix(names: string[]): string {
  if (names.length < 2) return '';
  let length = names[0].length;
  for (const name of names) {
    let same = 0;
    while (same < Math.min(length, name.length) && name[same] === names[0][same]) ++same;
    length = same;
  }
  const prefix = /^.*[:|_.\-/ ]/s.exec(names[0].slice(0, length))?.[0] ?? '';
  return names.every((name) => name.length > prefix.length) ? prefix : '';
}

function withoutMiddle(name: string): string {
  const letters = Array.from(name);
  if (letters.length <= longest) return name;
  const end = Math.ceil((longest - 1) / 2);
  return letters.slice(0, longest - 1 - end).join('') + ellipsis + letters.slice(-end).join('');
}

/** A shorter name for each name. Different names are never shortened to the same one. */
export function shortNames(names: string[]): string[] {
  const prefix = commonPrefix(names);
  const without = names.map((name) => name.slice(prefix.length));
  const short = without.map(withoutMiddle);
  const owners = new Map<string, Set<string>>();
  short.forEach((name, i) => owners.set(name, (owners.get(name) ?? new Set()).add(names[i])));
  return short.map((name, i) => ((owners.get(name)?.size ?? 0) > 1 ? without[i] : name));
}
