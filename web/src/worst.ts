// Selects where a report opens: at the worst finding, in the frame with the largest error or change.

import type { Finding } from './report';
import type { Take } from './take';

/** Kinds of findings, worst first; other kinds come before noise. It is also the order of the lanes. */
const order = ['warning', 'gap', 'spike', 'swap', 'frozen', 'bridged', 'slide', 'sink', 'length', 'euler_flip', 'repeated_frames', 'zero_frames', 'noise'];

export function rankOf(kind: string): number {
  const place = order.indexOf(kind);
  return place < 0 ? order.length - 1.5 : place;
}

/** Number of frames checked in long spans. Chosen by hand. */
const mostLookedAt = 400;

/**
 * The worst finding: among those of the worst kind, refused ones first, then the largest amount, then the longest. Warnings are used only if there
 * is nothing else, because most are about the whole take.
 */
export function worstOf(findings: Finding[]): Finding | null {
  const known = findings.filter(({ kind }) => kind !== 'warning');
  const length = (finding: Finding): number => finding.last_frame - finding.first_frame;
  const [first, ...rest] = known.length > 0 ? known : findings;
  return rest.reduce((worst, one) => {
    const by = rankOf(worst.kind) - rankOf(one.kind)
      || Number(one.verdict === 'refused') - Number(worst.verdict === 'refused')
      || (one.unit === worst.unit ? Math.abs(one.amount ?? 0) - Math.abs(worst.amount ?? 0) : 0)
      || length(one) - length(worst);
    return by > 0 ? one : worst;
  }, first) ?? null;
}

/** The stored frame of a finding in which the two takes are farthest apart, or its middle if there is one take or no change. */
export function worstFrame(take: Take, finding: Finding): number {
  const first = take.frameOf(finding.first_frame), last = take.frameOf(finding.last_frame);
  let worst = Math.floor((first + last) / 2), most = 0;
  if (!take.data.two || last - first < 1) return worst;
  // The remaining frames of a long take may not be loaded yet.
  const every = Math.max(take.whole ? 1 : take.data.stride, Math.ceil((last - first) / mostLookedAt));
  for (let f = first; f <= last; f += every) {
    const way = take.distance(f);
    if (way <= most) continue;
    most = way;
    worst = f;
  }
  return worst;
}
