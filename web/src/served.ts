// Data that the `kinemend view` page reads from its server: the session, the parts of a result, gap plans, curves of one gap.

import type { Parts } from './codec';
import type { Option, Value } from './option_control';

/** The page's data before there is a take, written by cli/view_session.cpp. */
export interface Session {
  input: string;
  other: string;
  kind: 'joints' | 'markers';
  cleaned: string;
  filled: string;
  contacts: string;
  plan: string;
  gaps: string;
  with_gaps: boolean;
  /** The default method if neither a flag nor a preset names one. */
  default_method: string;
  /** The source of the take if no flag names one. */
  source: string;
  controls: ViewControls;
}

/** Settings that the page may change, with defaults and ranges, written by cli/view_controls.cpp. */
export interface ViewControls {
  flags: Record<'clean' | 'fill', Option[]>;
  methods: { name: string; summary: string; options: Option[] }[];
  fill_methods: { name: string; summary: string; joints: boolean; markers: boolean }[];
  /** `values` are a preset's values of the controls; `options` are those of method options. */
  presets: { name: string; summary: string; values: Record<string, Value>; options: Record<string, Record<string, Value>> }[];
}

/** Why each method cannot clean the take, by name. */
export type WhyNot = Record<string, string>;

/** A row in the form of `kinemend.gap-plan/1` (docs/methods/gap-plan.md). */
export interface PlannedGap {
  name: string;
  quantity: string;
  first_frame: number;
  last_frame: number;
  length_frames: number;
  length_s: number;
  verdict: string;
  method: string;
  donor: string;
  filled_by: string;
  evidence: string[];
  expected_error: number | null;
  unit: string;
  reason: string;
  previews?: { method: string; filled: boolean; distance: number | null; reason: string }[];
}
export interface GapPlan {
  schema: string;
  gaps: PlannedGap[];
}

/** Curves as written by cli/view_session.cpp; frames are counted from 0. */
export interface GapCurves {
  first: number;
  last: number;
  axes: string[];
  curves: { method: string; filled: boolean; reason: string; distance: number | null; expected_error: number | null; values: (number | null)[][] }[];
}

/** The parts of a result, as combined by `joined` of src/report/page/document.hpp. */
export function partsOf(answer: ArrayBuffer): Parts {
  const bytes = new Uint8Array(answer);
  let at = bytes.indexOf(10) + 1;
  const parts = new Map<string, Uint8Array>();
  for (const [name, size] of JSON.parse(new TextDecoder().decode(bytes.subarray(0, at))) as [string, number][]) {
    parts.set(name, bytes.subarray(at, at + size));
    at += size;
  }
  return (name) => Promise.resolve(parts.get(name) ?? null);
}
