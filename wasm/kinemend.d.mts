// Types of kinemend.mjs.

/** Options of the command line, with underscores for dashes: {method: 'butterworth', cutoff_hz: 6, despike: false}. */
export type Options = Record<string, string | number | boolean | (string | number)[]>;

/** The result of a command. */
export interface Result {
  /** The program's exit code: 0 for success. */
  code: number;
  /** The written file, in the format of its name; empty if none was written. */
  bytes: Uint8Array;
  /** What the program prints on standard output: JSON. */
  report: string;
  /** What the program prints on standard error. */
  messages: string;
}

/** The page of `kinemend view` without a server; for the app. */
export interface View {
  open(name: string): {code: number; report: string; messages: string};
  ask(action: string, body: string): {status: number; body: Uint8Array};
}

/** A live stream: the text of `kinemend stream`, in and out. */
export interface Live {
  /** Takes text or UTF-8 bytes in pieces of any size: a header, then one line per frame. Returns the cleaned lines that are ready. */
  push(piece: string | Uint8Array): string;
  /** Ends the stream and returns the remaining lines. Throws if no header came. */
  finish(): string;
  /** Ends the stream and discards the remaining lines. */
  close(): void;
  /** The delay of the output in frames; 0 before a header. */
  readonly delayFrames: number;
  /** Messages about the stream: a new skeleton with its delay, the first invalid line. */
  readonly messages: string[];
}

export interface Kinemend {
  /** Removes noise. The ending of `name` gives the format of the result. */
  clean(bytes: Uint8Array, name: string, options?: Options): Result;
  /** Fills gaps. */
  fill(bytes: Uint8Array, name: string, options?: Options): Result;
  /** Finds damage; `report` is `kinemend.report/1`. */
  check(bytes: Uint8Array, name: string, options?: Options): Result;
  /** Describes the contents of the take. */
  info(bytes: Uint8Array, name: string, options?: Options): Result;
  /** Writes the take in the format given by the ending of `output`. */
  convert(bytes: Uint8Array, name: string, output: string, options?: Options): Result;
  /** Begins a live stream. Options are those of `kinemend stream` except addresses; `skeleton` is the name of a file given to `putFile`. */
  stream(options?: Options): Live;
  /** Runs any of these commands. `output` is the name of the result; if it is empty, the command writes none. */
  run(command: string, bytes: Uint8Array, name: string, options?: Options, output?: string): Result;
  /** Keeps a file beside the takes: the skeleton of an AMC file, the buffer of a glTF file. */
  putFile(name: string, bytes: Uint8Array): void;
  /** Returns a file given to `putFile`. Throws if it does not exist. */
  readFile(name: string): Uint8Array;
  removeFile(name: string): void;
  view: View;
}

/** Loads the module. `settings` go to Emscripten's loader, such as {wasmBinary} or {locateFile}. Loading is slower than a call, so do it once. */
export function load(settings?: Record<string, unknown>): Promise<Kinemend>;
