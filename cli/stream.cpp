// kinemend stream: cleans frames as they arrive.

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "kinemend/experimental/live.hpp"
#include "kinemend/io.hpp"
#include "live_loop.hpp"
#include "live_output.hpp"
#include "method_options.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

constexpr std::string_view default_method = "median";

std::string live_name(const LiveMethod& method) {
  std::string name = method.name;
  for (const auto& [option, value] : method.options)
    name += fmt::format(" --{}{}", std::get<bool>(value) ? "" : "no-", dashed(option));
  return name;
}

bool has_live_form(const Method& method) {
  return std::any_of(method.options.begin(), method.options.end(),
                     [](const OptionSpec& spec) { return spec.name == "live"; });
}

// Whether a method runs live: as it is, with an option, or with its model.
bool may_run_live(const Method& method) {
  static const std::vector<LiveMethod> list = live_methods();
  return has_live_form(method) || std::any_of(list.begin(), list.end(), [&](const LiveMethod& m) {
           return m.name == method.name;
         });
}

// For a learned method that has a live form. Errors: those of the model.
std::unique_ptr<Cleaner> live_with_model(const Method& method, OptionValues values) {
  values.try_emplace("live", true);
  return make_cleaner(method.name, values);
}

// A cleaner that runs live: an option without which the method does not is set, unless the user
// has set it.
std::unique_ptr<Cleaner> live_cleaner(const Method& method, OptionValues values) {
  const std::vector<LiveMethod> list = live_methods();
  const auto found = std::find_if(list.begin(), list.end(),
                                  [&](const LiveMethod& m) { return m.name == method.name; });
  bool runs = found != list.end();
  if (runs) {
    for (const auto& [option, value] : found->options)
      runs = values.try_emplace(option, value).first->second == value && runs;
  }
  if (runs) return make_cleaner(method.name, values);
  if (has_live_form(method)) return live_with_model(method, std::move(values));
  std::vector<std::string> names;
  names.reserve(list.size());
  for (const LiveMethod& m : list) names.push_back(live_name(m));
  throw Error(ErrorKind::usage,
              fmt::format("stream: {} needs the whole take; methods that run live: {}", method.name,
                          fmt::join(names, ", ")));
}

LivePlan plan_of(const Arguments& arguments) {
  LivePlan plan;
  const bool tcp = arguments.given("tcp"), udp = arguments.given("udp");
  if (tcp && udp) throw Error(ErrorKind::usage, "stream: --tcp and --udp exclude each other");
  if (tcp || udp) {
    const std::string option = tcp ? "tcp" : "udp";
    plan.from = parse_address("--" + option, arguments.text(option));
    const bool listens = plan.from.host.empty();
    if (udp && !listens)
      throw Error(ErrorKind::usage, "stream: --udp takes a port; --bind names the address");
    if (!listens && arguments.given("bind"))
      throw Error(ErrorKind::usage, "stream: --bind is for --tcp PORT, not for --tcp HOST:PORT");
    plan.source = udp       ? LiveSource::udp
                  : listens ? LiveSource::tcp_listen
                            : LiveSource::tcp_connect;
    if (listens) plan.from.host = arguments.text("bind");
  } else if (arguments.given("bind")) {
    throw Error(ErrorKind::usage, "stream: --bind needs --tcp PORT or --udp PORT");
  }
  if (arguments.given("reorder") && !(udp && arguments.flag("numbered")))
    throw Error(ErrorKind::usage, "stream: --reorder needs --udp and --numbered");
  plan.stall_s = static_cast<double>(arguments.whole("stall_ms")) / 1000;
  plan.holds = arguments.text("on_stall") == "hold";
  plan.once = arguments.flag("once");
  plan.quiet = arguments.flag("quiet");
  return plan;
}

LiveOptions options_of(const Arguments& arguments, const Method& method) {
  LiveOptions options;
  options.format = arguments.text("format") == "jsonl" ? LiveFormat::jsonl : LiveFormat::bvh;
  options.strength = arguments.number("strength");
  // This method only repairs spikes, and a repair is made in full at any strength.
  if (method.name == "hampel" && options.strength > 0) options.strength = 1;
  options.frame_rate_hz = arguments.given("fps") ? arguments.number("fps") : 0;
  options.numbered = arguments.flag("numbered");
  // Only datagrams overtake one another.
  options.datagrams = arguments.given("udp");
  if (options.datagrams)
    options.reorder_frames = static_cast<std::size_t>(arguments.whole("reorder"));
  options.skipped_words = static_cast<std::size_t>(arguments.whole("skip_words"));
  options.body_height = arguments.number("body_height");
  options.longest_gap_s = arguments.number("longest_gap_s");
  if (const std::string path = arguments.text("skeleton"); !path.empty())
    options.skeleton = read_file(path);
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
  say(
      fmt::format("latency: {:.3g} ms median, {:.3g} ms at the 99th percentile, {:.3g} ms maximum, "
                  "plus {:.3g} ms of delay",
                  1000 * output.latency().quantile_s(0.5), 1000 * output.latency().quantile_s(0.99),
                  1000 * output.latency().most_s(), delay_ms));
}

int run_stream(const Arguments& arguments) {
  const Method& method = find_method(arguments.text("method"));
  const auto cleaner = live_cleaner(method, parse_method_options(method, arguments.group_texts));
  LivePlan plan = plan_of(arguments);
  const LiveOptions options = options_of(arguments, method);
  const auto output = live_output_of(arguments);
  std::optional<LiveClock::time_point> came = LiveClock::now();
  if (!plan.quiet) say(fmt::format("method {}", method.name));
  LiveSession session(*cleaner, options, [&](const LivePiece& piece) {
    output->add(piece.is_header, piece.text, came);
  });
  plan.session = &session;
  plan.output = output.get();
  plan.came = &came;
  try {
    run_live(plan);
  } catch (const ClosedPipe&) {
    // The reader has closed the pipe, which is not an error.
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

Flag endpoint_flag(std::string name, std::string value, std::string group, std::string help,
                   std::string details = {}) {
  return text_flag(std::move(name), std::move(value), std::move(group), std::move(help),
                   std::move(details));
}

std::vector<Flag> stream_flags() {
  Flag method =
      text_flag("method", "NAME", "Cleaning", "how to clean: a method that runs live",
                "An option that a method needs to run live, such as --causal, is set for you.");
  method.spec.default_value = std::string(default_method);
  method.spec.choices = method_names();
  for (const Method& known : methods()) {
    if (may_run_live(known)) method.offered.push_back(known.name);
  }
  method.has_default = true;
  method.letter = 'm';
  Flag format = text_flag("format", "", "Output", "how to write cleaned frames");
  format.spec.default_value = std::string("bvh");
  format.spec.choices = {"bvh", "jsonl"};
  format.has_default = true;
  Flag on_stall = text_flag("on_stall", "", "Trouble", "what to do while no frames arrive",
                            "wait: write nothing. hold: repeat the last frame at the frame rate.");
  on_stall.spec.default_value = std::string("wait");
  on_stall.spec.choices = {"wait", "hold"};
  on_stall.has_default = true;
  Flag bind =
      text_flag("bind", "ADDRESS", "Input", "address that --tcp PORT and --udp PORT listen at",
                "0.0.0.0 accepts senders from every network; the default accepts only "
                "those on this machine.");
  bind.spec.default_value = std::string("127.0.0.1");
  bind.has_default = true;
  Flag skeleton =
      text_flag("skeleton", "FILE", "Input",
                "BVH file with skeleton and frame rate, for a sender that sends no header");
  skeleton.completion = Completion::file;
  Flag fps =
      number_flag("fps", "Hz", 0, 0.1, 100000, "Input", "frame rate; overrides that of the header");
  fps.has_default = false;
  Flag quiet = switch_flag("quiet", "Output", "print warnings and errors only");
  quiet.letter = 'q';
  return {
      endpoint_flag("tcp", "[HOST:]PORT", "Input",
                    "receive over TCP: PORT waits for a sender, HOST:PORT connects to one",
                    "Port 0 takes any free port, which is printed."),
      endpoint_flag("udp", "PORT", "Input", "receive over UDP; each datagram holds whole lines",
                    "Datagrams that are not frames are counted and ignored."),
      bind,
      skeleton,
      fps,
      switch_flag("numbered", "Input", "each line of values begins with its frame number",
                  "Lost, late and duplicate frames are recognised by it. Lost frames are "
                  "interpolated."),
      whole_flag("reorder", 4, 0, 1000, "Input",
                 "with --udp --numbered: frames that wait for a missing one",
                 "A frame that another one overtook is put back in its place. After so many more "
                 "frames it counts as lost. 0 never waits."),
      whole_flag("skip_words", 0, 0, 1000, "Input",
                 "words to skip at the start of each line of values"),
      number_flag("body_height", "", 1750, 1e-6, 1e9, "Input",
                  "markers: height of the person, in the units of the stream",
                  "Methods with settings in length scale them by it."),
      switch_flag("once", "Input", "exit when the first sender disconnects"),
      method,
      number_flag("strength", "", 1, 0, 1, "Cleaning",
                  "blend between the input (0) and the cleaned motion (1)"),
      endpoint_flag("to_tcp", "HOST:PORT", "Output", "send cleaned frames to a TCP server"),
      endpoint_flag("to_udp", "HOST:PORT", "Output",
                    "send cleaned frames over UDP, one line per datagram"),
      format,
      quiet,
      number_flag("longest_gap_s", "s", 1, 0, 3600, "Trouble",
                  "longest run of lost frames that is interpolated",
                  "The output then keeps its frame rate. A longer gap is a restart."),
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
  command.groups = method_groups();
  std::erase_if(command.groups,
                [](const OptionGroup& group) { return !may_run_live(find_method(group.name)); });
  command.groups_are_flags = true;
  command.examples = {{"kinemend stream < take.bvh > clean.bvh", "clean a file as if it were live"},
                      {"kinemend stream --tcp 7001 --to-udp 127.0.0.1:7002",
                       "wait for a suit to connect, and send the cleaned frames on"},
                      {"kinemend stream --tcp 192.168.0.7:7001 --numbered --format jsonl",
                       "connect to a server whose lines begin with frame numbers"},
                      {"kinemend stream --udp 7001 --skeleton suit.bvh --method kalman",
                       "receive from a sender that sends no header"}};
  command.run = run_stream;
  return command;
}

}  // namespace kinemend::cli
