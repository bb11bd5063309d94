// What the page of `kinemend view` reads from its server: the session, the parts of a result, gap plans, curves of one gap.

import type { Parts } from './codec';
import type { Option, Value } from './option_control';

/** What the page of `kinemend view` holds before there is a take: cli/view_session.cpp writes it. */
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
  /** The method of the program, where neither a flag nor a preset names one. */
  default_method: string;
  /** What recorded the take, where no flag says another. */
  source: string;
  controls: ViewControls;
}

/** What the program lets the page set, with defaults and ranges: cli/view_controls.cpp writes it. */
export interface ViewControls {
  flags: Record<'clean' | 'fill', Option[]>;
  methods: { name: string; summary: string; options: Option[] }[];
  fill_methods: { name: string; summary: string; joints: boolean; markers: boolean }[];
  /** `values`: what a preset sets of the controls; `options`: of the options of methods. */
  presets: { name: string; summary: string; values: Record<string, Value>; options: Record<string, Record<string, Value>> }[];
}

/** Why methods cannot clean the take, by name. */
export type WhyNot = Record<string, string>;

/** As `kinemend.gap-plan/1` has it (docs/methods/gap-plan.md). */
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

/** As cli/view_session.cpp writes it; frames count from 0. */
export interface GapCurves {
  first: number;
  last: number;
  axes: string[];
  curves: { method: string; filled: boolean; reason: string; distance: number | null; expected_error: number | null; values: (number | null)[][] }[];
}

/** The parts of a result, as `joined` of src/report/page/document.hpp puts them together. */
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
