// VMC between a sender and a receiver of the package node-osc.
// Usage: node_osc_test.mjs PROGRAM FOLDER_WITH_NODE_MODULES
import { spawn } from "node:child_process";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";

const [program, folder] = process.argv.slice(2);
const require = createRequire(path.resolve(folder, "package.json"));
const { Client, Server, Bundle } = require("node-osc");
const version = JSON.parse(readFileSync(path.join(folder, "node_modules/node-osc/package.json"))).version;

const frames = 90;
const wait = ms => new Promise(done => setTimeout(done, ms));
function fail(text) {
  console.error(text);
  process.exit(1);
}

const received = [];
const receiver = new Server(0, "127.0.0.1", () => run().catch(error => fail(error.stack)));
receiver.on("message", message => received.push(message));
receiver.on("bundle", bundle => bundle.elements.forEach(element => received.push(element)));

function pose(turn) {
  return [0, 1, 0, Math.sin(turn / 2), 0, 0, Math.cos(turn / 2)].map(value => ({ type: "float", value }));
}

let seed = 1;
function noise() {
  seed = (seed * 48271) % 2147483647;
  return seed / 2147483647 - 0.5;
}

function frame(f) {
  const turn = 0.4 * Math.sin(f / 12);
  return [
    ["/VMC/Ext/Root/Pos", "root", ...pose(0)],
    ...["Hips", "Spine", "Head"].map(bone => ["/VMC/Ext/Bone/Pos", bone, ...pose(turn + 0.1 * noise())]),
    ["/VMC/Ext/Blend/Val", "Joy", { type: "float", value: 0.5 }],
    ["/VMC/Ext/OK", 1],
  ];
}

function roughness(turns) {
  let sum = 0;
  for (let i = 2; i < turns.length; ++i) sum += (turns[i] - 2 * turns[i - 1] + turns[i - 2]) ** 2;
  return sum;
}

const value = argument => (typeof argument === "object" ? argument.value : argument);
const turns = messages => messages.filter(m => m[1] === "Head").map(m => 2 * Math.atan2(value(m[5]), value(m[8])));

async function run() {
  const port = receiver._sock.address().port;
  const child = spawn(program, ["stream", "--vmc", "0", "--to-vmc", `127.0.0.1:${port}`]);
  let said = "";
  child.stderr.on("data", text => { said += text; });
  while (!/waiting for VMC at 127\.0\.0\.1:\d+/.test(said)) await wait(10);
  const client = new Client("127.0.0.1", Number(/VMC at 127\.0\.0\.1:(\d+)/.exec(said)[1]));
  const sent = [];
  for (let f = 0; f < frames; ++f) {
    const messages = frame(f);
    if (f % 2 === 0) client.send(new Bundle(...messages), () => {});
    else for (const message of messages) client.send(message, () => {});
    sent.push(...messages);
    await wait(16);
  }
  child.kill("SIGINT");
  const code = await new Promise(done => child.on("exit", done));
  await wait(200);
  if (code !== 0) fail(`exit code ${code}: ${said}`);
  const names = list => list.map(m => `${m[0]} ${value(m[1])}`).join("\n");
  if (names(sent) !== names(received)) fail(`${received.length} of ${sent.length} messages in order\n${said}`);
  const before = roughness(turns(sent)), after = roughness(turns(received));
  if (!(after < 0.5 * before)) fail(`roughness ${before} became ${after}`);
  console.log(`node-osc ${version}: ${received.length} messages in order`);
  process.exit(0);
}
