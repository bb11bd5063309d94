// How the `kinemend view` page requests work: from the program that serves it, or from a worker in the same page (worker_transport.ts).

/** The tab's own name: a run stops the earlier one of the same tab. */
const tab = Array.from(crypto.getRandomValues(new Uint32Array(4)), (word) => word.toString(16)).join('-');

/** The part of an answer that the page reads; a `Response` has it. */
export type Answer = Pick<Response, 'ok' | 'status' | 'json' | 'text' | 'arrayBuffer'>;

export interface ViewTransport {
  /** Answers as described in cli/view_session.hpp: `action` is run, curves, save, contacts, gaps or progress. */
  ask(action: string, asked?: object): Promise<Answer>;
  /** Ends the current run; its request is answered with 409. */
  stop(): void;
  /** Call it when the page is closed. */
  leave(): void;
  /** States where a file saved beside `folder` goes (the folder of the proposed file; may be missing). */
  placeOf(folder: string | undefined): string;
  /** States why no answer comes. */
  inWords(error: unknown): string;
}

export const serverTransport: ViewTransport = {
  ask: (action, asked = {}) => fetch(action, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify({ tab, ...asked }) }),
  stop: () => void serverTransport.ask('leave').catch(() => undefined),
  leave: () => void navigator.sendBeacon('leave', new Blob([JSON.stringify({ tab })], { type: 'application/json' })),
  placeOf: (folder) => (folder === undefined || folder === './' ? 'In the folder in which kinemend view was started.' : `In the folder ${folder}`),
  inWords: (error) => (error instanceof TypeError ? 'kinemend view has ended' : error instanceof Error ? error.message : String(error)),
};
