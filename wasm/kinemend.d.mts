// Types of kinemend.mjs.

/** Options of the command line, with underscores for dashes: {method: 'butterworth', cutoff_hz: 6, despike: false}. */
export type Options = Record<string, string | number | boolean | (string | number)[]>;

/** What a command has made. */
export interface Result {
  /** The exit code of the program: 0 for success. */
  code: number;
  /** The file that was written, in the format of its name; empty where nothing was. */
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
  /** Takes text or UTF-8 bytes as they arrive, in pieces of any size: a header, then a line a frame. Returns the cleaned lines that are ready. */
  push(piece: string | Uint8Array): string;
  /** Ends the stream and returns the remaining lines. Throws where no header came. */
  finish(): string;
  /** Ends the stream without them. */
  close(): void;
  /** How many frames the output is behind the input; 0 before a header. */
  readonly delayFrames: number;
  /** What there was to say: a new skeleton with its delay, the first line that is no frame. */
  readonly messages: string[];
}

export interface Kinemend {
  /** Removes noise. `name` tells the format of the result. */
  clean(bytes: Uint8Array, name: string, options?: Options): Result;
  /** Fills gaps. */
  fill(bytes: Uint8Array, name: string, options?: Options): Result;
  /** Finds damage; `report` is `kinemend.report/1`. */
  check(bytes: Uint8Array, name: string, options?: Options): Result;
  /** Says what the take holds. */
  info(bytes: Uint8Array, name: string, options?: Options): Result;
  /** Writes the take in the format of the name `output`. */
  convert(bytes: Uint8Array, name: string, output: string, options?: Options): Result;
  /** Begins a live stream. Options are those of `kinemend stream` that name no address; `skeleton` is a file that `putFile` keeps. */
  stream(options?: Options): Live;
  /** Runs any of these commands. `output`: the name of the result; empty: none. */
  run(command: string, bytes: Uint8Array, name: string, options?: Options, output?: string): Result;
  /** Keeps a file beside the takes: the skeleton of an AMC file, the buffer of a glTF file. */
  putFile(name: string, bytes: Uint8Array): void;
  /** Gives a kept file. Throws where there is none. */
  readFile(name: string): Uint8Array;
  removeFile(name: string): void;
  view: View;
}

/** Loads the module. `settings` go to Emscripten's loader, such as {wasmBinary} or {locateFile}. Loading takes longer than a call: do it once. */
export function load(settings?: Record<string, unknown>): Promise<Kinemend>;
