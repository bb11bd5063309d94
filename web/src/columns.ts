// Describes the columns of tables and figures of a report in plain words with units. Only this file of the page knows their names.

/** Columns without a unit: counts, and those whose name states it. */
const withoutUnit = /filled|refused|count|frames|gap|spikes|frozen|bridged|swaps|flips|percent|samples|above_6_hz|_s$|_s2$|_hz$|_deg$|_cm$|missing/;

/** `{unit}` is the unit of the tracks, `{track}` a joint or marker. */
const meanings: Record<string, string> = {
  // Tracks of `clean`.
  noise: 'How strongly the {track} trembles before cleaning: standard deviation on each axis, in {unit}.',
  expected_noise: 'How much noise the model of the method expects in the {track} and takes out: standard deviation on each axis, in {unit}.',
  rms_change: 'How much cleaning changed the {track}: root mean square over all frames, in {unit}.',
  max_change: 'The largest change in any frame, in {unit}.',
  frames_changed: 'Number of frames in which the {track} was changed.',
  frames_repaired: 'Number of frames in which a spike was repaired or a gap filled.',
  peak_speed_before: 'The highest speed before cleaning, in {unit} per second, spikes left out.',
  peak_speed_after: 'The highest speed after cleaning, in {unit} per second. Much less than before: real motion may be lost.',
  peak_frames: 'Number of frames for which the peak of speed lasts. A short one is more likely to be lost.',
  left: 'The error that is expected to be left after cleaning: standard deviation on each axis, in {unit}.',
  gaps_left: 'Number of gaps that stay open.',
  frames_missing: 'Number of frames in which the {track} is still missing.',
  // Tracks of `check`.
  gaps: 'Number of gaps: spans of frames in which samples are missing.',
  longest_gap: 'Length of the longest gap, in frames.',
  missing_frames: 'Number of frames in which the {track} is missing.',
  spikes: 'Number of spikes: leaps away from the motion and back within a few frames.',
  frozen: 'Number of spans in which the {track} does not change at all while others move.',
  bridged: 'Number of spans that another program seems to have filled by a straight line.',
  swaps: 'Number of spans in which two markers have each other\u2019s label.',
  flips: 'Number of frames at which Euler angles leap although the rotation does not.',
  peak_speed_deg_s: 'The highest speed, in degrees per second.',
  peak_acceleration_deg_s2: 'The largest acceleration, in degrees per second squared.',
  // Tracks of `fill`, counted on the page.
  filled: 'Number of gaps that were filled.',
  'filled frames': 'Number of frames that were filled.',
  refused: 'Number of gaps that stay open, because a fill would be a guess.',
  'refused frames': 'Number of frames in these gaps.',
  // Tracks of `compare`.
  geodesic_rms_deg: 'Angle between the rotations of the two takes: root mean square over all frames, in degrees.',
  geodesic_max_deg: 'The largest angle between the two takes in any frame, in degrees.',
  peak_speed_reference_deg_s: 'The highest speed in the reference, in degrees per second.',
  peak_speed_other_deg_s: 'The highest speed in the other take, in degrees per second.',
  samples: 'Number of frames in which both takes have the {track}.',
  rms_distance: 'Distance between the two takes: root mean square over all frames, in {unit}.',
  max_distance: 'The largest distance between the two takes in any frame, in {unit}.',
  rms_axis: 'Difference along one axis: root mean square over all frames and axes, in {unit}.',
  velocity_rms: 'Difference of velocities: root mean square over all frames, in {unit} per second.',
  above_6_hz: 'How much of the motion faster than 6 Hz the other take has, as a share of the reference; 1: the same.',
};

/** Figures of the whole take that are about feet; they are shown together. */
const feetFigures: Record<string, [label: string, unit: string, meaning: string]> = {
  slide_cm: ['slide of a standing foot', 'cm', 'The farthest that a foot travels over the floor while it should stand.'],
  sink_cm: ['depth below the floor', 'cm', 'How far a standing foot is below the floor at most.'],
  foot_slide: ['slide a frame, of the other take', '', 'Mean distance that a standing foot travels over the floor from one frame to the next, in units of the file.'],
  foot_slide_reference: ['slide a frame, of the reference', '', 'The same in the reference.'],
};

export function isFeetFigure(name: string): boolean { return name in feetFigures; }
export function feetFigure(name: string): [label: string, unit: string, meaning: string] { return feetFigures[name]; }

/** The tooltip of a column heading; empty for an unknown column. */
export function meaningOf(column: string, noun: string, unit: string | null): string {
  return (meanings[column] ?? '').replaceAll('{track}', noun).replaceAll('{unit}', unit === 'deg' ? 'degrees' : unit || 'units of the file');
}

/** The unit shown after a column's heading, such as "deg" or "mm/s"; empty if there is none. */
export function unitOf(column: string, unit: string | null): string {
  if (!unit || withoutUnit.test(column)) return '';
  return /^(peak_speed|velocity)/.test(column) ? `${unit}/s` : unit;
}

/** The initial sort column, worst rows on top: the first of these that the table has. */
export const worstFirst = ['rms_change', 'geodesic_rms_deg', 'rms_distance', 'noise', 'gaps', 'filled frames'];
