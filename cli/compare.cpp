// kinemend compare: every error figure of two takes, and limits on them.

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "commands.hpp"
#include "json.hpp"
#include "kinemend/io.hpp"
#include "kinemend/metrics.hpp"
#include "table.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

/// One figure, defined once for table, JSON and limit.
struct Figure {
  std::string name;  ///< as in JSON; `--max-rms-deg` limits `rms_deg`
  std::string unit;
  std::string meaning;
  bool more_is_better = false;
  std::optional<double> (*get)(const Comparison& comparison);
};

using Value = std::optional<double>;

/// None where no foot was found to stand.
Value slide_of(const FootSlide& slide) {
  return slide.contact_steps > 0 ? Value(slide.per_frame) : std::nullopt;
}

const std::vector<Figure>& figures() {
  static const std::vector<Figure> table = {
      {"rms_deg", "deg", "joint-angle channels, mean over frames (Mall et al.)", false,
       [](const Comparison& c) -> Value { return c.rms_deg; }},
      {"geodesic_rms_deg", "deg", "angle between local rotations, all joints", false,
       [](const Comparison& c) -> Value { return c.geodesic_rms_deg; }},
      {"geodesic_p99_deg", "deg", "its 99th percentile", false,
       [](const Comparison& c) -> Value { return c.geodesic_p99_deg; }},
      {"geodesic_max_deg", "deg", "its largest value", false,
       [](const Comparison& c) -> Value { return c.geodesic_max_deg; }},
      {"mpjpe", "units", "mean distance of joint positions, file units", false,
       [](const Comparison& c) -> Value { return c.mpjpe; }},
      {"mpjpe_cm", "cm", "the same where the unit is known", false,
       [](const Comparison& c) -> Value { return c.mpjpe_cm; }},
      {"accel_error", "units/s2", "difference of joint accelerations", false,
       [](const Comparison& c) -> Value { return c.accel_error; }},
      {"psnr_db", "dB", "peak signal to noise of the logarithms (Dean)", true,
       [](const Comparison& c) -> Value { return c.psnr_db; }},
      {"rmse_per_marker_m", "m", "distance of joint positions per frame, mean (Xiao et al.)", false,
       [](const Comparison& c) -> Value {
         return c.rmse_per_marker_m ? Value(c.rmse_per_marker_m->mean) : std::nullopt;
       }},
      {"rmse_per_marker_deviation_m", "m", "its standard deviation over frames", false,
       [](const Comparison& c) -> Value {
         return c.rmse_per_marker_m ? Value(c.rmse_per_marker_m->deviation) : std::nullopt;
       }},
      {"mse_rad2", "rad2", "squared angle, mean over joints (Courty)", false,
       [](const Comparison& c) -> Value { return c.mse_rad2; }},
      {"foot_slide", "units", "travel per frame of feet in contact, of OTHER", false,
       [](const Comparison& c) { return slide_of(c.foot_slide); }},
      {"foot_slide_reference", "units", "the same of REFERENCE, for comparison", false,
       [](const Comparison& c) { return slide_of(c.foot_slide_reference); }}};
  return table;
}

std::string limit_name(const Figure& figure) {
  return (figure.more_is_better ? "min_" : "max_") + figure.name;
}

std::string exact(double value) {
  return std::isinf(value) ? "equal" : fmt::format("{:.4g}", value);
}

std::string text_of(const Comparison& comparison, const Clip& reference, bool per_joint) {
  Table table({Align::left, Align::right, Align::left, Align::left});
  for (const Figure& entry : figures()) {
    const auto value = entry.get(comparison);
    table.add({entry.name, value ? exact(*value) : "-", value ? entry.unit : "", entry.meaning});
  }
  std::string text = fmt::format("  {} compared\n\n", counted(comparison.frames, "frame"));
  text += table.text();
  if (!per_joint) return text;
  Table joints({Align::left, Align::right, Align::right, Align::right, Align::right});
  joints.add({"joint", "rms deg", "max deg", "peak deg/s reference", "other"});
  for (std::size_t j = 0; j < comparison.joints.size(); ++j) {
    const JointComparison& joint = comparison.joints[j];
    joints.add({printable(reference.skeleton.names[j]), figure(joint.geodesic_rms_deg),
                figure(joint.geodesic_max_deg), figure(joint.peak_speed_reference_deg_s),
                figure(joint.peak_speed_other_deg_s)});
  }
  return text + "\n" + joints.text();
}

Json json_of_comparison(const Comparison& comparison, const Clip& reference) {
  Json json = {{"frames", comparison.frames}, {"psnr_peak", comparison.psnr_peak}};
  for (const Figure& entry : figures()) {
    const auto value = entry.get(comparison);
    json[entry.name] = value ? Json(*value) : Json();
  }
  json["joints"] = Json::array();
  for (std::size_t j = 0; j < comparison.joints.size(); ++j) {
    const JointComparison& joint = comparison.joints[j];
    json["joints"].push_back({{"name", reference.skeleton.names[j]},
                              {"geodesic_rms_deg", joint.geodesic_rms_deg},
                              {"geodesic_max_deg", joint.geodesic_max_deg},
                              {"peak_speed_reference_deg_s", joint.peak_speed_reference_deg_s},
                              {"peak_speed_other_deg_s", joint.peak_speed_other_deg_s},
                              {"peak_frames", joint.peak_frames}});
  }
  return json;
}

/// 1 with a line for each limit that is passed.
int check_limits(const Comparison& comparison, const Arguments& arguments) {
  int code = 0;
  for (const Figure& entry : figures()) {
    const std::string name = limit_name(entry);
    if (!arguments.given(name)) continue;
    const double limit = arguments.number(name);
    const auto value = entry.get(comparison);
    if (!value) {
      const bool is_of_feet = entry.name.starts_with("foot_slide");
      say_error(fmt::format("{} is unknown, for {}: --{} cannot hold", entry.name,
                            is_of_feet ? "no foot was found to stand" : "the unit of length is",
                            dashed(name)));
      code = 1;
    } else if (entry.more_is_better ? !(*value >= limit) : !(*value <= limit)) {
      say_error(fmt::format("{} {:.4g} is {} the limit {:.4g}", entry.name, *value,
                            entry.more_is_better ? "below" : "above", limit));
      code = 1;
    }
  }
  return code;
}

ComparisonSettings comparison_settings(const Arguments& arguments, const Clip& reference) {
  ComparisonSettings settings;
  settings.first_frame = leading_calibration_frames(reference);
  if (arguments.given("psnr_peak")) settings.psnr_peak = arguments.number("psnr_peak");
  if (arguments.given("metres_per_unit"))
    settings.metres_per_unit = arguments.number("metres_per_unit");
  const std::string up = arguments.text("up");
  settings.foot_slide.up = up == "x" ? Axis::x : up == "z" ? Axis::z : Axis::y;
  return settings;
}

int run(const Arguments& arguments) {
  const std::string reference_name = arguments.positionals[0];
  const std::string other_name = arguments.positionals[1];
  check_single_use({reference_name, other_name}, {}, false);
  const ReadResult reference =
      read_clip(std::filesystem::path(reference_name), read_options(arguments));
  const ReadResult other = read_clip(std::filesystem::path(other_name), read_options(arguments));
  warn_of_repairs(reference.clip.source, reference.diagnostics);
  warn_of_repairs(other.clip.source, other.diagnostics);
  const Comparison comparison =
      compare_clips(reference.clip, other.clip, comparison_settings(arguments, reference.clip));
  if (arguments.flag("json")) {
    Json json = {{"reference", reference_name}, {"other", other_name}};
    json.update(json_of_comparison(comparison, reference.clip));
    write_out(json_text(json));
  } else {
    write_out(text_of(comparison, reference.clip, arguments.flag("per_joint")));
  }
  return check_limits(comparison, arguments);
}

Flag number_without_default(std::string name, std::string unit, double minimum, double maximum,
                            std::string group, std::string help) {
  Flag flag = number_flag(std::move(name), std::move(unit), 0, minimum, maximum, std::move(group),
                          std::move(help));
  flag.has_default = false;
  return flag;
}

std::vector<Flag> flags() {
  Flag up = text_flag("up", "", "Figures", "vertical axis, for foot_slide (default y)");
  up.spec.choices = {"x", "y", "z"};
  std::vector<Flag> list = {
      json_flag("print JSON instead of text"),
      switch_flag("per_joint", "Output", "also list every joint"),
      number_without_default("metres_per_unit", "m", 1e-9, 1e6, "Figures",
                             "length of a file unit; found from the skeleton's height otherwise"),
      number_without_default("psnr_peak", "rad", 1e-9, 1e6, "Figures",
                             "peak of psnr_db (default pi / 2)"),
      up};
  append(list, reading_flags("what needs a repair becomes an error"));
  for (const Figure& entry : figures()) {
    Flag limit = number_without_default(
        limit_name(entry), entry.unit, entry.more_is_better ? -1e9 : 0, 1e12, "Limits",
        fmt::format("exit code 1 where {} is {}", entry.name,
                    entry.more_is_better ? "below this" : "above this"));
    // The range says nothing that the unit does not.
    limit.spec.maximum = std::numeric_limits<double>::infinity();
    limit.spec.minimum = -std::numeric_limits<double>::infinity();
    list.push_back(limit);
  }
  return list;
}

}  // namespace

Command compare_command() {
  Command command;
  command.name = "compare";
  command.summary = "print every error figure of a take against its reference";
  command.description =
      "Both takes have the same joints and frames. A calibration pose at the start of the "
      "reference "
      "is left out. Each --max and --min option sets a limit; where a figure passes one, the exit "
      "code is 1.";
  command.positionals = {{"REFERENCE", "the truth; - is standard input", 1, 1, {}},
                         {"OTHER", "the take to judge", 1, 1, {}}};
  command.flags = flags();
  command.examples = {{"kinemend compare truth.bvh cleaned.bvh", "all figures"},
                      {"kinemend compare truth.bvh cleaned.bvh --max-geodesic-rms-deg 1.2",
                       "as a check in a script"}};
  command.run = run;
  return command;
}

}  // namespace kinemend::cli
