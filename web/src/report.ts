// The data of the page: kinemend.report/1 (docs/report.md), and the output of src/report/page/take_json.cpp.

export interface Finding {
  kind: string;
  verdict: string;
  track: string | null;
  first_frame: number;
  last_frame: number;
  amount: number | null;
  unit: string | null;
  reason: string | null;
  rms?: number;
  quantity?: string;
  method?: string;
}

export type TrackRow = Record<string, string | number | null>;

export interface FeetFigures {
  slide: number;
  most_slide: number;
  sink: number;
  knee_pop_deg: number;
}

export interface Contact {
  side: string;
  part: string;
  first_frame: number;
  last_frame: number;
  confidence: number;
  held: boolean;
  reason: string | null;
}

/** Seconds in which feet stand, summed over feet. */
export interface StandingTime {
  expected_s: number;
  found_s: number;
  held_s: number;
  still_s: number;
  confidence: number;
}

/** Lengths in units of the file. */
export interface Feet {
  metres_per_unit: number | null;
  time: StandingTime;
  held: number;
  frames_adjusted: number;
  before: FeetFigures | null;
  after: FeetFigures | null;
  contacts?: Contact[];
}

export interface TakeEntry {
  input: string;
  output: string | null;
  kind: string;
  format: string | null;
  frames: number;
  first_frame: number;
  frame_rate_hz: number;
  calibration_frames: number | null;
  unit: string | null;
  metres_per_unit: number | null;
  track_unit: string | null;
  verdict: string | null;
  method?: string;
  source?: string;
  source_reason?: string;
  reference?: string;
  options?: Record<string, unknown>;
  fall_backs?: { method: string; reason: string; tracks: { name: string; share: number }[] }[];
  notes?: string[];
  feet?: Feet;
  leftovers?: { what: string; mend: string }[];
  figures: Record<string, number | null>;
  findings: Finding[];
  tracks: TrackRow[];
  warnings: string[];
  diagnostics: { name: string; message: string; count: number }[];
}

export interface ReportDocument {
  schema: string;
  kinemend: string;
  command: string;
  takes: TakeEntry[];
}

type Gap = [track: number, first: number, last: number];
export interface Gaps {
  own: Gap[];
  positions: Gap[];
}

export interface Skeleton {
  parents: number[];
  offsets: [number, number, number][];
  rests: [number, number, number, number][];
  orders: string[];
  ends: { parent: number; offset: [number, number, number] }[];
  translated: number[];
}

/** A time in which a part of a foot stands; frames of the whole take, from 0. */
export interface StageContact {
  points: number[];
  first: number;
  last: number;
  /** "left heel" */
  foot: string;
  confidence: number;
}

export interface TakeData {
  kind: 'joints' | 'markers';
  names: string[];
  frames: number;
  told: number;
  step: number;
  stride: number;
  first_frame: number;
  rate: number;
  unit: string;
  two: boolean;
  quanta: number[];
  stage: {
    up: 'x' | 'y' | 'z';
    sign: number;
    floor: number;
    height: number;
    contacts: StageContact[];
  };
  gaps: { before: Gaps; after: Gaps | null };
  skeleton?: Skeleton;
  shown?: boolean[];
  /** Pairs of markers between which a line is drawn. */
  links?: [number, number][];
  command_line: string;
  labels: [string, string];
}
