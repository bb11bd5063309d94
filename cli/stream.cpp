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
#include "live_vmc.hpp"
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

// The option that says where frames come from; empty: from standard input.
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

LiveOptions options_of(const Arguments& arguments, const Method& method) {
  LiveOptions options;
  options.format = arguments.text("format") == "jsonl" ? LiveFormat::jsonl : LiveFormat::bvh;
  options.strength = arguments.number("strength");
  // This method only repairs spikes, and a repair is made in full at any strength.
  if (method.name == "hampel" && options.strength > 0) options.strength = 1;
  options.frame_rate_hz = arguments.given("fps") ? arguments.number("fps") : 0;
  options.neuron = arguments.given("neuron");
  options.feet = arguments.flag("feet");
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
  plan.options.bones = arguments.list("bones");
  plan.options.strength = arguments.number("strength");
  plan.options.feet = arguments.flag("feet");
  if (arguments.given("fps")) plan.options.frame_rate_hz = arguments.number("fps");
  plan.stall_s = static_cast<double>(arguments.whole("stall_ms")) / 1000;
  plan.quiet = arguments.flag("quiet");
  return plan;
}

int run_vmc_stream(const Arguments& arguments, const Method& method, const Cleaner& cleaner) {
  VmcPlan plan = vmc_plan_of(arguments);
  plan.cleaner = &cleaner;
  if (method.name == "hampel" && plan.options.strength > 0) plan.options.strength = 1;
  const auto status = status_of(arguments);
  plan.status = status.get();
  run_vmc(plan);
  return 0;
}

int run_stream(const Arguments& arguments) {
  const Method& method = find_method(arguments.text("method"));
  const auto cleaner = live_cleaner(method, parse_method_options(method, arguments.group_texts));
  if (source_option(arguments) == "vmc") return run_vmc_stream(arguments, method, *cleaner);
  for (const char* const vmc : {"to_vmc", "bones"}) {
    if (arguments.given(vmc))
      throw Error(ErrorKind::usage, fmt::format("stream: --{} needs --vmc", dashed(vmc)));
  }
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
  const auto status = status_of(arguments);
  plan.status = status.get();
  if (status) status->start([&] { return stream_report(method.name, session, *output); });
  try {
    run_live(plan);
  } catch (const ClosedPipe&) {
    // The reader has closed the pipe, which is not an error.
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
  Flag bind = text_flag("bind", "ADDRESS", "Input",
                        "address that --tcp, --udp, --neuron and --vmc listen at",
                        "0.0.0.0 accepts senders from every network; the default accepts only "
                        "those on this machine.");
  bind.spec.default_value = std::string("127.0.0.1");
  bind.has_default = true;
  Flag skeleton =
      text_flag("skeleton", "FILE", "Input",
                "BVH file with skeleton and frame rate, for a sender that sends no header");
  skeleton.completion = Completion::file;
  Flag bones = text_flag("bones", "A,B,...", "Cleaning", "with --vmc: bones to clean (default all)",
                         "Names are those of the messages, such as Head, or root. Others pass "
                         "unchanged, with the same delay.");
  bones.takes = Takes::list;
  Flag status =
      whole_flag("status", 0, 0, 65535, "Output", "serve a status page on 127.0.0.1 at this port",
                 "It shows latency, loss and noise by joint; /status.json has the same. "
                 "Port 0 takes any free port, which is printed.");
  status.has_default = false;
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
      endpoint_flag("neuron", "[HOST:]PORT", "Input",
                    "receive the BVH broadcast of Axis Neuron over TCP; HOST:PORT connects to it",
                    "Its lines have no header: --skeleton names the joints, and --fps the rate, "
                    "where they are not the usual ones."),
      endpoint_flag("vmc", "PORT", "Input", "receive VMC (OSC over UDP), and send it to --to-vmc",
                    "Bones and root are cleaned. Every other message passes unchanged and in "
                    "order."),
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
      switch_flag(
          "feet", "Cleaning", "hold feet that stand where they are",
          "For joints. It moves legs only, and adds no delay. Knees may move less smoothly."),
      bones,
      endpoint_flag("to_tcp", "HOST:PORT", "Output", "send cleaned frames to a TCP server"),
      endpoint_flag("to_udp", "HOST:PORT", "Output",
                    "send cleaned frames over UDP, one line per datagram"),
      endpoint_flag("to_vmc", "HOST:PORT", "Output", "with --vmc: where its datagrams go"),
      status,
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
                       "receive from a sender that sends no header"},
                      {"kinemend stream --vmc 39540 --to-vmc 127.0.0.1:39539 --status 8080",
                       "stand between a VMC sender and its receiver, with a status page"},
                      {"kinemend stream --neuron 192.168.0.7:7001", "connect to Axis Neuron"}};
  command.run = run_stream;
  return command;
}

}  // namespace kinemend::cli
