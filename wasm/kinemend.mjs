// Cleans motion capture in Node 18 or later and in browsers. `await load()` returns the functions; a call works on bytes and never on files.

import makeModule from './kinemend_module.mjs';

const decoder = new TextDecoder();

// Emscripten 3.1 expects globals of Node that its modules no longer have.
async function settingsForNode(settings) {
  const {createRequire} = await import('module');
  const {fileURLToPath} = await import('url');
  const {readFile} = await import('fs/promises');
  globalThis.require ??= createRequire(import.meta.url);
  globalThis.__dirname ??= fileURLToPath(new URL('.', import.meta.url));
  const place = fileURLToPath(new URL('./kinemend_module.wasm', import.meta.url));
  return {wasmBinary: await readFile(place), ...settings};
}

/** Loads the module. `settings` is handed to the module's loader, such as {wasmBinary} or {locateFile}. */
export async function load(settings = {}) {
  const isNode = typeof process === 'object' && typeof process.versions?.node === 'string';
  const module = await makeModule(isNode ? await settingsForNode(settings) : settings);

  const copied = (bytes) => {
    const place = module._malloc(bytes.length || 1);
    module.HEAPU8.set(bytes, place);
    return place;
  };
  const text = (words) => copied(new TextEncoder().encode(`${words}\0`));
  const answer = (what) => {
    const place = module[`_kinemend_${what}`]();
    return module.HEAPU8.slice(place, place + module[`_kinemend_${what}_size`]());
  };

  /**
   * Runs a command on the bytes of a take. The ending of `name` gives the format if the content does not. Returns {code, bytes, report, messages}:
   * the program's exit code, the written take, and what the program prints on standard output (JSON) and on standard error.
   */
  function run(command, bytes, name, options = {}, output = '') {
    const places = [text(command), text(name), copied(bytes), text(output), text(JSON.stringify(options))];
    try {
      const code = module._kinemend_run(places[0], places[1], places[2], bytes.length, places[3], places[4]);
      return {code, bytes: answer('bytes'), report: decoder.decode(answer('report')), messages: decoder.decode(answer('messages'))};
    } finally {
      places.forEach((place) => module._free(place));
    }
  }

  /** Keeps a file beside the takes: the skeleton of an AMC file, for the option asf. */
  function putFile(name, bytes) {
    const places = [text(name), copied(bytes)];
    module._kinemend_put_file(places[0], places[1], bytes.length);
    places.forEach((place) => module._free(place));
  }

  const withText = (words, call) => {
    const places = words.map(text);
    try {
      return call(...places);
    } finally {
      places.forEach((place) => module._free(place));
    }
  };

  /** The bytes of a file given to `putFile`, or saved by the page. */
  function readFile(name) {
    if (withText([name], module._kinemend_read_file) !== 0) throw new Error(decoder.decode(answer('messages')).trim());
    return answer('bytes');
  }

  /** The page of `kinemend view` without a server: a session on a take given to `putFile` answers its requests (cli/view_session.hpp). */
  const view = {
    open(name) {
      const code = withText([name], module._kinemend_view_open);
      return {code, report: decoder.decode(answer('report')), messages: decoder.decode(answer('messages'))};
    },
    ask(action, body) {
      const status = withText([action, body], module._kinemend_view_ask);
      return {status, body: answer('report')};
    },
  };

  /**
   * Begins a live stream, as `kinemend stream` does: it takes text as it arrives and returns cleaned frames as text, with a constant delay in
   * frames. Throws if the options do not fit.
   */
  function stream(options = {}) {
    const id = withText([JSON.stringify(options)], module._kinemend_stream_open);
    if (id === 0) throw new Error(decoder.decode(answer('messages')).trim());
    const live = {
      messages: [],
      get delayFrames() { return module._kinemend_stream_delay(id); },
      push(piece) {
        const bytes = typeof piece === 'string' ? new TextEncoder().encode(piece) : piece;
        const place = copied(bytes);
        try {
          return given(module._kinemend_stream_push(id, place, bytes.length));
        } finally {
          module._free(place);
        }
      },
      finish: () => given(module._kinemend_stream_finish(id)),
      close: () => module._kinemend_stream_close(id),
    };
    const given = (code) => {
      const words = decoder.decode(answer('messages')).trim();
      if (code !== 0) throw new Error(words);
      if (words !== '') live.messages.push(...words.split('\n'));
      return decoder.decode(answer('report'));
    };
    return live;
  }

  return {
    run,
    stream,
    putFile,
    readFile,
    removeFile: (name) => withText([name], module._kinemend_remove_file),
    view,
    clean: (bytes, name, options = {}) => run('clean', bytes, name, options, name),
    fill: (bytes, name, options = {}) => run('fill', bytes, name, options, name),
    check: (bytes, name, options = {}) => run('check', bytes, name, options),
    info: (bytes, name, options = {}) => run('info', bytes, name, options),
    convert: (bytes, name, output, options = {}) => run('convert', bytes, name, options, output),
  };
}
