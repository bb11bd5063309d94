// The self-contained status page of a live stream, which requests /status.json every second.
#pragma once

#include <string_view>

namespace kinemend::cli {

inline constexpr std::string_view live_status_page = R"html(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>Kinemend live</title>
<style>
  body { font: 15px/1.4 system-ui, sans-serif; margin: 1.5rem auto; max-width: 60rem; padding: 0 1rem; color: #212529; background: #f8f9fa }
  h1 { font-size: 1.3rem; margin: 0 } h2 { font-size: 1rem; margin: 1.5rem 0 .4rem }
  table { border-collapse: collapse } td { padding: .1rem .8rem .1rem 0 } td.n { text-align: right; font-variant-numeric: tabular-nums }
  .bar { background: #1864ab; height: .8rem; min-width: 1px } .some { color: #d9480f; font-weight: 600 }
  #gone { color: #d9480f } small { color: #5c636a }
</style>
<h1>Kinemend live</h1>
<p id="line"></p><p id="gone" role="status"></p>
<h2>Latency of the program</h2><p id="latency"></p><table id="bars"></table>
<div id="senders"></div>
<script>
"use strict";
const trouble = new Set(["lost", "late", "duplicate", "malformed", "not_finite", "restarts", "dropped", "missing", "not_osc"]);
const at = id => document.getElementById(id);
const number = x => x === 0 ? "0" : x >= 100 ? Math.round(x).toLocaleString("en") : x.toPrecision(3);
function row(table, cells, share) {
  const tr = table.insertRow();
  for (const [text, kind] of cells) {
    const td = tr.insertCell();
    td.textContent = text;
    td.className = kind;
  }
  if (share !== undefined) {
    const td = tr.insertCell(), bar = document.createElement("div");
    td.style.width = "24rem";
    bar.className = "bar";
    bar.style.width = 100 * share + "%";
    td.append(bar);
  }
}
function show(s) {
  at("line").textContent = `Method ${s.method}, ${s.delay_frames} frames (${number(s.delay_ms)} ms) of delay`;
  const l = s.latency;
  at("latency").textContent = l ? `${number(l.median_ms)} ms median, ${number(l.p99_ms)} ms at the 99th percentile, ` +
    `${number(l.most_ms)} ms maximum` : "no frame yet";
  const bars = at("bars");
  bars.replaceChildren();
  const most = Math.max(1, ...(l ? l.bars : []).map(b => b.count));
  for (const b of l ? l.bars : []) row(bars, [[`below ${number(b.below_ms)} ms`, ""], [b.count.toLocaleString("en"), "n"]], b.count / most);
  const all = at("senders");
  all.replaceChildren();
  for (const sender of s.senders) {
    const add = (kind, text) => Object.assign(all.appendChild(document.createElement(kind)), { textContent: text });
    add("h2", `Frames from ${sender.from}, ${number(sender.frame_rate_hz)} per second`);
    const counts = add("table", "");
    for (const [name, count] of Object.entries(sender.counts))
      row(counts, [[name.replace("_", " "), ""], [count.toLocaleString("en"), "n" + (trouble.has(name) && count > 0 ? " some" : "")]]);
    add("h2", `Noise by joint or marker, ${sender.unit}`);
    add("small", "How much each changes when it is cleaned: root mean square of the last 600 frames.");
    const tracks = add("table", ""), largest = Math.max(1e-9, ...sender.tracks.map(t => t.change));
    for (const t of [...sender.tracks].sort((a, b) => b.change - a.change))
      row(tracks, [[t.name, ""], [number(t.change), "n"]], t.change / largest);
  }
}
async function ask() {
  try {
    show(await (await fetch("/status.json")).json());
    at("gone").textContent = "";
  } catch { at("gone").textContent = "The stream has ended, or does not answer."; }
  setTimeout(ask, 1000);
}
ask();
</script>
</html>
)html";

}  // namespace kinemend::cli
