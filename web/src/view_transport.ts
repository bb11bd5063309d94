// How the page of `kinemend view` asks for work: of the program that serves it, or of a worker in the same page (worker_transport.ts).

/** What this tab calls itself: a run stops the one before it of the same tab. */
const tab = Array.from(crypto.getRandomValues(new Uint32Array(4)), (word) => word.toString(16)).join('-');

/** What the page reads of an answer: a `Response` has it. */
export type Answer = Pick<Response, 'ok' | 'status' | 'json' | 'text' | 'arrayBuffer'>;

export interface ViewTransport {
  /** Answers as cli/view_session.hpp says: `action` is run, curves, save, contacts, gaps or progress. */
  ask(action: string, asked?: object): Promise<Answer>;
  /** Ends the run that is under way; its request is answered with 409. */
  stop(): void;
  /** The page is closed. */
  leave(): void;
  /** Says where a file goes that is saved beside `folder` (the folder of the file that was proposed; may be missing). */
  placeOf(folder: string | undefined): string;
  /** Says why no answer comes. */
  inWords(error: unknown): string;
}

export const serverTransport: ViewTransport = {
  ask: (action, asked = {}) => fetch(action, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify({ tab, ...asked }) }),
  stop: () => void serverTransport.ask('leave').catch(() => undefined),
  leave: () => void navigator.sendBeacon('leave', new Blob([JSON.stringify({ tab })], { type: 'application/json' })),
  placeOf: (folder) => (folder === undefined || folder === './' ? 'In the folder in which kinemend view was started.' : `In the folder ${folder}`),
  inWords: (error) => (error instanceof TypeError ? 'kinemend view has ended' : error instanceof Error ? error.message : String(error)),
};
