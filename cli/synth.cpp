// kinemend synth: writes a synthetic take, for tests and trials.

#include "kinemend/lab/synth.hpp"

#include <fmt/format.h>

#include "commands.hpp"
#include "kinemend/io.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

int run_synth(const Arguments& arguments) {
  const std::string output = arguments.text("output");
  if (output.empty())
    throw Error(ErrorKind::usage, "synth: --output is missing (see kinemend synth -h)");
  check_take_ending(output);
  check_free(output, arguments.flag("force"));
  SynthOptions options;
  options.motion = arguments.positionals[0];
  options.duration_s = arguments.number("duration_s");
  options.frame_rate_hz = arguments.number("frame_rate_hz");
  options.seed = static_cast<std::uint64_t>(arguments.whole("seed"));
  options.t_pose_first = arguments.flag("t_pose_first");
  const Take take = synthesize(options);
  const std::string format = format_for(output, {"", "bvh", nullptr});
  check_can_hold("synth", take, format);
  write_take_output(output, take, format, arguments.flag("force"));
  return 0;
}

}  // namespace

Command synth_command() {
  const SynthOptions defaults;
  Command command;
  command.name = "synth";
  command.summary = "write a synthetic take of a full humanoid";
  command.description =
      "Writes clean motion to test with. The joint curves follow published normative gait data. "
      "The "
      "same seed gives the same bytes.";
  Positional motion{"MOTION", "", 1, 1, {}};
  for (const std::string_view name : synth_motions()) motion.choices.emplace_back(name);
  motion.help = fmt::format("one of {}", fmt::join(motion.choices, ", "));
  command.positionals = {motion};
  command.flags = {
      output_flag("where to write; - is standard output"),
      force_flag(),
      number_flag("duration_s", "s", defaults.duration_s, 0.1, 600, "Work", "length of the take"),
      number_flag("frame_rate_hz", "Hz", defaults.frame_rate_hz, 1, 1000, "Work", "frame rate"),
      switch_flag("t_pose_first", "Work", "begin with a T-pose, as the CMU files do"),
      seed_flag("seed for the build of the performer and the strides")};
  command.examples = {
      {"kinemend synth walk -o walk.bvh", "write six seconds of walking at 120 Hz"}};
  command.run = run_synth;
  return command;
}

}  // namespace kinemend::cli
