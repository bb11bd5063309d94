// kinemend stream: cleans frames as they arrive.

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "kinemend/extend/sessions.hpp"
#include "kinemend/io.hpp"
#include "kinemend/methods.hpp"
#include "live_loop.hpp"
#include "live_output.hpp"
#include "live_vmc.hpp"
#include "method_options.hpp"
#include "stream_plan.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

// The option that names the source of frames; empty: standard input.
std::string source_option(const Arguments& arguments) {
  std::string given;
  for (const char* const option : {"tcp", "udp", "neuron", "vmc"}) {
    if (!arguments.given(option)) continue;
    if (!given.empty())
      throw Error(ErrorKind::usage,
                  fmt::format("stream: --{} and --{} exclude each other", given, option));
    given = option;
  }
  return given;
}

LivePlan plan_of(const Arguments& arguments) {
  LivePlan plan;
  const std::string option = source_option(arguments);
  const bool udp = option == "udp";
  if (!option.empty()) {
    plan.from = parse_address("--" + option, arguments.text(option));
    const bool listens = plan.from.host.empty();
    if (udp && !listens)
      throw Error(ErrorKind::usage, "stream: --udp takes a port; --bind names the address");
    if (!listens && arguments.given("bind"))
      throw Error(ErrorKind::usage,
                  fmt::format("stream: --bind is for --{0} PORT, not for --{0} HOST:PORT", option));
    plan.source = udp       ? LiveSource::udp
                  : listens ? LiveSource::tcp_listen
                            : LiveSource::tcp_connect;
    if (listens) plan.from.host = arguments.text("bind");
  } else if (arguments.given("bind")) {
    throw Error(ErrorKind::usage,
                "stream: --bind needs --tcp PORT, --udp PORT, --neuron PORT or --vmc PORT");
  }
  if (arguments.given("reorder") && !(udp && arguments.flag("numbered")))
    throw Error(ErrorKind::usage, "stream: --reorder needs --udp and --numbered");
  plan.stall_s = static_cast<double>(arguments.whole("stall_ms")) / 1000;
  plan.holds = arguments.text("on_stall") == "hold";
  plan.once = arguments.flag("once");
  plan.quiet = arguments.flag("quiet");
  return plan;
}

LiveOptions options_of(const Arguments& arguments) {
  LiveOptions options = live_options(arguments);
  options.neuron = arguments.given("neuron");
  // Only datagrams can arrive out of order.
  options.datagrams = arguments.given("udp");
  if (options.datagrams)
    options.reorder_frames = static_cast<std::size_t>(arguments.whole("reorder"));
  return options;
}

std::unique_ptr<LiveOutput> live_output_of(const Arguments& arguments) {
  const bool tcp = arguments.given("to_tcp"), udp = arguments.given("to_udp");
  if (tcp && udp) throw Error(ErrorKind::usage, "stream: --to-tcp and --to-udp exclude each other");
  const auto queue = static_cast<std::size_t>(arguments.whole("queue"));
  if (!tcp && !udp) return std::make_unique<LiveOutput>(queue);
  const std::string option = tcp ? "to-tcp" : "to-udp";
  const Address address = parse_address("--" + option, arguments.text(tcp ? "to_tcp" : "to_udp"));
  if (address.host.empty())
    throw Error(ErrorKind::usage, fmt::format("stream: --{} needs HOST:PORT", option));
  return std::make_unique<LiveOutput>(address, tcp ? Transport::tcp : Transport::udp, queue);
}

void tell_summary(const LiveSession& session, const LiveOutput& output) {
  const LiveCounts& c = session.counts();
  say(fmt::format(
      "frames: {} in, {} out, {} lost, {} interpolated, {} held, {} late, {} duplicate, {} "
      "malformed, {} dropped",
      c.frames_in, c.frames_out, c.lost, c.made_up, c.held, c.late, c.doubled, c.malformed,
      output.dropped()));
  const auto tell_if = [](std::size_t count, std::string_view what) {
    if (count > 0) say(fmt::format("{}: {}", what, count));
  };
  tell_if(c.reordered, "frames that arrived out of order and were put in their place");
  tell_if(c.not_finite, "values that were not finite numbers");
  tell_if(c.restarts, "jumps of the frame number");
  tell_if(c.bad_headers, "unreadable headers");
  if (c.sessions > 1) tell_if(c.sessions, "skeletons");
  if (output.latency().empty()) return;
  const double delay_ms =
      1000 * static_cast<double>(session.latency_frames()) / session.frame_rate_hz();
  say(latency_text(output.latency(), delay_ms));
}

std::unique_ptr<LiveStatus> status_of(const Arguments& arguments) {
  if (!arguments.given("status")) return nullptr;
  auto status = std::make_unique<LiveStatus>(static_cast<int>(arguments.whole("status")));
  if (!arguments.flag("quiet")) say(fmt::format("status: {}", status->address()));
  return status;
}

VmcPlan vmc_plan_of(const Arguments& arguments) {
  for (const char* const other :
       {"numbered", "reorder", "skip_words", "skeleton", "body_height", "once", "to_tcp", "to_udp",
        "format", "longest_gap_s", "on_stall", "queue"}) {
    if (arguments.given(other))
      throw Error(ErrorKind::usage, fmt::format("stream: --{} is not for --vmc", dashed(other)));
  }
  if (!arguments.given("to_vmc"))
    throw Error(ErrorKind::usage, "stream: --vmc needs --to-vmc HOST:PORT");
  VmcPlan plan;
  plan.from = parse_address("--vmc", arguments.text("vmc"));
  if (!plan.from.host.empty())
    throw Error(ErrorKind::usage, "stream: --vmc takes a port; --bind names the address");
  plan.from.host = arguments.text("bind");
  plan.to = parse_address("--to-vmc", arguments.text("to_vmc"));
  if (plan.to.host.empty()) throw Error(ErrorKind::usage, "stream: --to-vmc needs HOST:PORT");
  plan.options.bones = arguments.list("joints");
  plan.options.strength = arguments.number("strength");
  plan.options.feet = arguments.flag("feet");
  plan.options.source = parse_source(arguments.text("source"));
  if (arguments.given("fps")) plan.options.frame_rate_hz = arguments.number("fps");
  plan.stall_s = static_cast<double>(arguments.whole("stall_ms")) / 1000;
  plan.quiet = arguments.flag("quiet");
  return plan;
}

int run_vmc_stream(const Arguments& arguments, const Cleaner& cleaner) {
  VmcPlan plan = vmc_plan_of(arguments);
  plan.cleaner = &cleaner;
  const auto status = status_of(arguments);
  plan.status = status.get();
  run_vmc(plan);
  return 0;
}

int run_stream(const Arguments& arguments) {
  const Method& method = find_method(arguments.text("method"));
  const auto cleaner = live_cleaner(method, parse_method_options(method, arguments.group_texts));
  if (source_option(arguments) == "vmc") return run_vmc_stream(arguments, *cleaner);
  for (const char* const vmc : {"to_vmc", "joints"}) {
    if (arguments.given(vmc))
      throw Error(ErrorKind::usage, fmt::format("stream: --{} needs --vmc", dashed(vmc)));
  }
  LivePlan plan = plan_of(arguments);
  const LiveOptions options = options_of(arguments);
  const auto output = live_output_of(arguments);
  std::optional<LiveClock::time_point> came = LiveClock::now();
  if (!plan.quiet) say(fmt::format("method {}", method.name));
  LiveSession session(*cleaner, options, [&](const LivePiece& piece) {
    output->add(piece.is_header, piece.text, came);
  });
  plan.session = &session;
  plan.output = output.get();
  plan.came = &came;
  const auto status = status_of(arguments);
  plan.status = status.get();
  if (status) status->start([&] { return stream_report(method.name, session, *output); });
  try {
    run_live(plan);
  } catch (const ClosedPipe&) {
    // A closed pipe is not an error.
    if (status) status->stop();
    output->give_up();
  }
  if (plan.source == LiveSource::standard && !session.has_skeleton()) {
    for (const std::string& note : session.take_notes()) say_error(note);
    throw Error(
        ErrorKind::unreadable_input,
        "standard input: no header found; a stream begins with the hierarchy of a BVH file, "
        "or with MARKERS, the rate and the names");
  }
  if (!plan.quiet) tell_summary(session, *output);
  return 0;
}

std::vector<Flag> stream_flags() {
  const std::vector<Flag> live = live_flags();
  const auto live_flag = [&](std::string_view name) {
    return *std::find_if(live.begin(), live.end(),
                         [&](const Flag& flag) { return flag.spec.name == name; });
  };
  Flag on_stall =
      choice_flag("on_stall", "Trouble", "what to do while no frames arrive", {"wait", "hold"},
                  "wait", "wait: write nothing. hold: repeat the last frame at the frame rate.");
  Flag bind = text_flag("bind", "ADDRESS", "Input",
                        "address that --tcp, --udp, --neuron and --vmc listen at",
                        "0.0.0.0 accepts senders from every network; the default accepts only "
                        "those on this machine.");
  bind.spec.default_value = std::string("127.0.0.1");
  bind.has_default = true;
  Flag joints =
      joints_flags("Cleaning", "with --vmc: bones to clean (default all)", "bones").front();
  joints.details =
      "Names are those of the messages, such as Head, or root. Others pass unchanged, with the "
      "same "
      "delay.";
  Flag status =
      whole_flag("status", 0, 0, 65535, "Output", "serve a status page on 127.0.0.1 at this port",
                 "It shows latency, loss and noise by joint; /status.json has the same. "
                 "Port 0 takes any free port, which is printed.");
  status.has_default = false;
  status.value_name = "PORT";
  return {
      text_flag("tcp", "[HOST:]PORT", "Input",
                "receive over TCP: PORT waits for a sender, HOST:PORT connects to one",
                "Port 0 takes any free port, which is printed."),
      text_flag("udp", "PORT", "Input", "receive over UDP; each datagram holds whole lines",
                "Datagrams that are not frames are counted and ignored."),
      text_flag("neuron", "[HOST:]PORT", "Input",
                "receive the BVH broadcast of Axis Neuron over TCP; HOST:PORT connects to it",
                "Its lines have no header: --skeleton names the joints, and --fps the rate, "
                "where they are not the usual ones."),
      text_flag("vmc", "PORT", "Input", "receive VMC (OSC over UDP), and send it to --to-vmc",
                "Bones and root are cleaned. Every other message passes unchanged and in "
                "order."),
      bind,
      live_flag("skeleton"),
      live_flag("fps"),
      live_flag("numbered"),
      whole_flag("reorder", 4, 0, 1000, "Input",
                 "with --udp --numbered: frames that wait for a missing one",
                 "A frame that another one overtook is put back in its place. After so many more "
                 "frames it counts as lost. 0 never waits."),
      live_flag("skip_words"),
      live_flag("body_height"),
      switch_flag("once", "Input", "exit when the first sender disconnects"),
      live_flag("method"),
      live_flag("source"),
      live_flag("strength"),
      live_flag("feet"),
      joints,
      text_flag("to_tcp", "HOST:PORT", "Output", "send cleaned frames to a TCP server"),
      text_flag("to_udp", "HOST:PORT", "Output",
                "send cleaned frames over UDP, one line per datagram"),
      text_flag("to_vmc", "HOST:PORT", "Output", "with --vmc: where its datagrams go"),
      status,
      live_flag("format"),
      quiet_flag(),
      live_flag("longest_gap_s"),
      whole_flag("stall_ms", 1000, 0, 1e9, "Trouble",
                 "report when no frame arrives for so many milliseconds; 0: never"),
      on_stall,
      whole_flag("queue", 240, 1, 1e6, "Trouble",
                 "frames to keep for a client that does not read; then the oldest are dropped",
                 "From standard input to standard output nothing is dropped: reading waits.")};
}

}  // namespace

Command stream_command() {
  Command command;
  command.name = "stream";
  command.summary = "clean frames as they arrive, with a constant delay";
  command.description =
      "Reads a BVH header and then one line of channel values per frame, from standard input or a "
      "socket. Writes the same with cleaned values to standard output or a socket. A stream of "
      "markers begins with their names instead (see kinemend help live). Each frame is written as "
      "soon as the method has seen the frames that it needs after it; this delay is printed.\n\n"
      "Lost, late, duplicate and malformed frames are counted, and the stream continues. Senders "
      "may "
      "pause, disconnect and return. Clients that do not read lose the oldest frames.\n\n"
      "At the end of standard input, on SIGINT and on SIGTERM, the remaining frames are written "
      "and a summary is printed on standard error.";
  command.flags = stream_flags();
  command.group_heading = "With --method %";
  command.groups = live_groups();
  command.groups_are_flags = true;
  command.examples = {{"kinemend stream < take.bvh > clean.bvh", "clean a file as if it were live"},
                      {"kinemend stream --tcp 7001 --to-udp 127.0.0.1:7002",
                       "wait for a suit to connect, and send the cleaned frames on"},
                      {"kinemend stream --tcp 192.168.0.7:7001 --numbered --format jsonl",
                       "connect to a server whose lines begin with frame numbers"},
                      {"kinemend stream --udp 7001 --skeleton suit.bvh --method kalman",
                       "receive from a sender that sends no header"},
                      {"kinemend stream --vmc 39540 --to-vmc 127.0.0.1:39539 --status 8080",
                       "stand between a VMC sender and its receiver, with a status page"},
                      {"kinemend stream --neuron 192.168.0.7:7001", "connect to Axis Neuron"}};
  command.run = run_stream;
  return command;
}

}  // namespace kinemend::cli
