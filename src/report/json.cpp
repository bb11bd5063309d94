// Writes a report as JSON, whole or in part. Makes the rows and sums of a batch, and reads rows
// back.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/pages.hpp"
#include "kinemend/extend/system.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/report.hpp"
#include "report/figures.hpp"
#include "report/texts.hpp"

namespace kinemend {

using Json = nlohmann::ordered_json;

namespace {

// Returns the JSON as text, on one line for an `indent` of -1. Invalid UTF-8 is replaced.
std::string text_of(const Json& json, int indent = 2) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

// The amount of detail of a report: without lists, without the changed spans of `clean`, or all.
enum class Depth { row, summary, all };

Json text_or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }
Json positive_or_null(double value) { return value > 0 ? Json(value) : Json(); }

Json number(double value, bool is_count) {
  return is_count ? Json(static_cast<std::uint64_t>(value)) : Json(value);
}
Json number(const std::optional<double>& value, bool is_count = false) {
  return value ? number(*value, is_count) : Json();
}

Json json_of(const OptionValues& options) {
  Json json = Json::object();
  for (const auto& [name, value] : options)
    json[name] = std::visit([](const auto& v) { return Json(v); }, value);
  return json;
}

Json json_of(const Diagnostics& diagnostics, std::string_view format) {
  const char* const place = format == "c3d" ? "first_byte" : "first_line";
  Json list = Json::array();
  for (const Diagnostic& entry : diagnostics.entries()) {
    list.push_back({{"name", entry.name},
                    {"message", entry.message},
                    {place, entry.first_line},
                    {"count", entry.count}});
  }
  return list;
}

Json json_of(const ReportFinding& finding, std::int64_t first_frame) {
  Json json = {{"kind", finding.kind},
               {"verdict", finding.verdict},
               {"track", text_or_null(finding.track)},
               {"first_frame", frame_number(finding.first_frame, first_frame)},
               {"last_frame", frame_number(finding.last_frame, first_frame)},
               {"amount", number(finding.amount)},
               {"unit", text_or_null(finding.unit)},
               {"reason", text_or_null(finding.reason)}};
  // Only some commands have these values.
  if (finding.rms) json["rms"] = *finding.rms;
  if (!finding.quantity.empty()) json["quantity"] = finding.quantity;
  if (!finding.method.empty()) json["method"] = finding.method;
  return json;
}

Json figures_json(const Report& report) {
  Json json = Json::object();
  for (const ReportFigure& figure : figures_of(report))
    json[figure.name] = number(figure.value, figure.is_count);
  return json;
}

Json tracks_json(const ReportTracks& tracks) {
  Json list = Json::array();
  for (std::size_t i = 0; i < tracks.names.size(); ++i) {
    Json row = {{"name", tracks.names[i]}};
    for (const ReportColumn& column : tracks.columns)
      row[column.name] = number(column.values[i], column.is_count);
    list.push_back(std::move(row));
  }
  return list;
}

Json json_of(const FeetFigures& figures) {
  return {{"slide", figures.slide},
          {"most_slide", figures.most_slide},
          {"sink", figures.sink},
          {"knee_pop_deg", figures.knee_pop_deg}};
}

Json json_of(const StandingTime& time) {
  return {{"expected_s", time.expected_s},
          {"found_s", time.found_s},
          {"held_s", time.held_s},
          {"still_s", time.still_s},
          {"confidence", time.confidence}};
}

Json contact_json(const std::string& side, const FootContact& contact, std::int64_t first_frame) {
  return {{"side", side},
          {"part", to_string(contact.part)},
          {"first_frame", frame_number(contact.first_frame, first_frame)},
          {"last_frame", frame_number(contact.last_frame, first_frame)}};
}

Json contacts_json(const FeetReport& report, std::int64_t first_frame) {
  Json contacts = Json::array();
  for (std::size_t i = 0; i < report.contacts.size(); ++i) {
    const FootContact& contact = report.contacts[i];
    const bool is_held = report.held[i] != 0;
    Json json = contact_json(report.sides[contact.leg], contact, first_frame);
    json["confidence"] = contact.confidence;
    json["held"] = is_held;
    json["reason"] = is_held ? Json() : Json(report.reasons[i]);
    contacts.push_back(std::move(json));
  }
  return contacts;
}

Json feet_json(const FeetReport& report, std::int64_t first_frame, bool with_contacts) {
  // Without a contact, slide and sink are undefined.
  const bool has_contact = !report.contacts.empty();
  Json json = {{"metres_per_unit", positive_or_null(report.metres_per_unit)},
               {"time", json_of(report.time)},
               {"held", contacts_held(report)},
               {"frames_adjusted", frames_adjusted(report)},
               {"before", has_contact ? json_of(report.before) : Json()},
               {"after", has_contact ? json_of(report.after) : Json()}};
  if (with_contacts) json["contacts"] = contacts_json(report, first_frame);
  return json;
}

Json fall_backs_json(const CleanReport& report) {
  Json list = Json::array();
  for (const FallBack& fall_back : report.fall_backs) {
    Json tracks = Json::array();
    for (std::size_t i = 0; i < fall_back.tracks.size(); ++i) {
      tracks.push_back(
          {{"name", track_name(report, fall_back.tracks[i])}, {"share", fall_back.shares[i]}});
    }
    list.push_back(
        {{"method", fall_back.method}, {"reason", fall_back.reason}, {"tracks", tracks}});
  }
  return list;
}

Json leftovers_json(const TakeFacts& take, const std::vector<Leftover>& leftovers) {
  Json list = Json::array();
  for (const Leftover& leftover : leftovers)
    list.push_back({{"what", leftover.what}, {"mend", advice_of(leftover, take)}});
  return list;
}

Json noise_json(const std::vector<NoiseCharacter>& characters, double frame_rate_hz) {
  // The quantiles of the figures. By definition.
  constexpr double half = 0.5, nearly_all = 0.9;
  Json list = Json::array();
  for (const NoiseCharacter& noise : characters) {
    const auto below = [&](double share) {
      return noise.is_expected && noise.correlation == 0
                 ? Json()
                 : Json(noise.frequency_of_share(share, frame_rate_hz));
    };
    list.push_back({{"quantity", noise.space == Space::rotation ? "rotation" : "position"},
                    {"strength", noise.strength},
                    {"correlation", noise.correlation},
                    {"half_below_hz", below(half)},
                    {"ninety_percent_below_hz", below(nearly_all)},
                    {"is_expected", noise.is_expected},
                    {"samples", noise.frames_per_sample == 1 ? "every_frame"
                                : noise.is_interpolated      ? "interpolated"
                                                             : "held"},
                    {"sample_rate_hz", frame_rate_hz / noise.frames_per_sample}});
  }
  return list;
}

void add_source(const TakeSource& source, Json& json) {
  json["source"] = to_string(source.source);
  json["source_reason"] = source.reason;
}

Json subjects_json(const CheckReport& report) {
  Json list = Json::array();
  for (const SubjectHealth& subject : report.subjects) {
    list.push_back({{"name", subject.name},
                    {"markers", subject.markers},
                    {"slide_cm", number(subject.slide_cm)},
                    {"sink_cm", number(subject.sink_cm)}});
  }
  return list;
}

Json robot_json(const RobotFindings& robot, std::int64_t first_frame) {
  Json contacts = Json::array();
  for (const FootContact& contact : robot.contacts)
    contacts.push_back(contact_json(robot.sides[contact.leg], contact, first_frame));
  return {{"contacts", std::move(contacts)}};
}

Json stands_json(const CheckReport& report, std::int64_t first_frame) {
  const FootStands& stands = report.stands;
  Json contacts = Json::array(), ground = Json::array(), plates = Json::array();
  for (const FootContact& contact : stands.contacts) {
    Json json = contact_json(stands.sides[contact.leg], contact, first_frame);
    json["confidence"] = contact.confidence;
    contacts.push_back(std::move(json));
  }
  for (const GroundTime& time : stands.ground) {
    ground.push_back({{"side", stands.sides[time.leg]},
                      {"touch_down_s", number(time.touch_down_s)},
                      {"lift_off_s", number(time.lift_off_s)}});
  }
  for (const PlateStand& stand : report.plate_stands) {
    Json numbers = Json::array();
    for (const std::size_t plate : stand.plates) numbers.push_back(plate + 1);
    plates.push_back({{"side", stands.sides[stand.foot]},
                      {"plates", std::move(numbers)},
                      {"first_s", stand.first_s},
                      {"last_s", stand.last_s},
                      {"found", stand.is_found},
                      {"onset_ms", number(stand.onset_ms)},
                      {"offset_ms", number(stand.offset_ms)}});
  }
  return {{"expected_s", stands.time.expected_s}, {"found_s", stands.time.found_s},
          {"confidence", stands.time.confidence}, {"contacts", std::move(contacts)},
          {"ground", std::move(ground)},          {"loads", std::move(plates)}};
}

// Adds the entries of a single command, between the verdict and the figures.
void add_own(const TakeFacts& take, const CleanReport& report, Depth depth, Json& json) {
  json["method"] = report.method;
  add_source(report.source, json);
  if (depth != Depth::row) json["options"] = json_of(report.options);
  if (report.feet) {
    json["feet"] = feet_json(*report.feet, take.first_frame, depth != Depth::row);
  }
  json["noise"] = noise_json(report.noise, report.frame_rate_hz);
  if (depth == Depth::row) return;
  json["fall_backs"] = fall_backs_json(report);
  json["notes"] = report.notes;
  json["leftovers"] = leftovers_json(take, report.leftovers);
}
void add_own(const TakeFacts& take, const CheckReport& report, Depth /*depth*/, Json& json) {
  add_source(report.source, json);
  json["noise"] = noise_json(report.noise, report.frame_rate_hz);
  json["subjects"] = subjects_json(report);
  if (!report.stands.sides.empty()) json["stands"] = stands_json(report, take.first_frame);
  if (report.robot) json["robot"] = robot_json(*report.robot, take.first_frame);
}
void add_own(const TakeFacts& /*take*/, const FillOutcome& /*outcome*/, Depth /*depth*/,
             Json& /*json*/) {}
void add_own(const TakeFacts& /*take*/, const CompareOutcome& outcome, Depth /*depth*/,
             Json& json) {
  json["reference"] = outcome.reference;
  if (!outcome.markers) return;
  json["fit"] = to_string(outcome.fit);
  json["unmatched"] = outcome.markers->unmatched;
}
void add_own(const TakeFacts& take, const FeetReport& report, Depth /*depth*/, Json& json) {
  json["feet"] = feet_json(report, take.first_frame, true);
}

const std::vector<std::string>* warnings_of(const Report& report) {
  if (const auto* clean = std::get_if<CleanReport>(&report.result)) return &clean->warnings;
  if (const auto* fill = std::get_if<FillOutcome>(&report.result)) return &fill->report.warnings;
  if (const auto* feet = std::get_if<FeetReport>(&report.result)) return &feet->warnings;
  return nullptr;
}

// Returns the number of calibration frames at the start; none if the command does not look for
// them.
std::optional<std::size_t> calibration_frames(const Report& report) {
  if (const auto* clean = std::get_if<CleanReport>(&report.result))
    return clean->calibration_frames;
  if (const auto* check = std::get_if<CheckReport>(&report.result))
    return check->calibration_frames;
  return std::nullopt;
}

double metres_per_unit_of(const Report& report) {
  // If the file states no unit, the check has found the one in which the body is of human size.
  const auto* check = std::get_if<CheckReport>(&report.result);
  return check != nullptr ? check->metres_per_unit : report.take.metres_per_unit;
}

// Indents every line of a text. A string in JSON contains no line break.
void append_indented(std::string_view text, std::size_t blanks, std::string& result) {
  result.append(blanks, ' ');
  for (const char c : text) {
    result += c;
    if (c == '\n') result.append(blanks, ' ');
  }
}

Json take_json(const Report& report, Depth depth) {
  const TakeFacts& take = report.take;
  const std::optional<std::size_t> calibration = calibration_frames(report);
  const ReportTracks tracks = tracks_of(report);
  Json json = {{"input", take.input},
               {"output", text_or_null(take.output)},
               {"kind", take.kind == TakeKind::markers ? "markers" : "joints"},
               {"format", text_or_null(take.format)},
               {"frames", take.frames},
               {"first_frame", take.first_frame},
               {"frame_rate_hz", take.frame_rate_hz},
               {"calibration_frames", calibration ? Json(*calibration) : Json()},
               {"unit", text_or_null(take.unit)},
               {"metres_per_unit", positive_or_null(metres_per_unit_of(report))},
               {"track_unit", text_or_null(tracks.unit)},
               {"verdict", text_or_null(verdict_of(report))}};
  if (!take.animation.empty()) json["animation"] = take.animation;
  std::visit([&](const auto& result) { add_own(take, result, depth, json); }, report.result);
  json["figures"] = figures_json(report);
  const std::vector<std::string>* const warnings = warnings_of(report);
  json["warnings"] = warnings != nullptr ? Json(*warnings) : Json::array();
  if (depth == Depth::row) return json;
  json["diagnostics"] = json_of(take.diagnostics, take.format);
  json["findings"] = Json::array();
  for (const ReportFinding& finding : findings_of(report, depth == Depth::all))
    json["findings"].push_back(json_of(finding, take.first_frame));
  json["tracks"] = tracks_json(tracks);
  return json;
}

Json failure_entry(std::string_view input, std::string_view error, int exit_code) {
  return {{"input", input}, {"error", error}, {"exit_code", exit_code}};
}

}  // namespace

std::string to_json(const Report& report, bool with_spans) {
  return text_of(take_json(report, with_spans ? Depth::all : Depth::summary));
}

std::string failure_json(std::string_view input, std::string_view error, int exit_code) {
  return text_of(failure_entry(input, error, exit_code));
}

std::string diagnostics_json(const Diagnostics& diagnostics, std::string_view format) {
  return text_of(json_of(diagnostics, format));
}

std::string report_document(std::string_view command, std::span<const std::string> takes) {
  std::string document = text_of(Json{{"schema", report_schema},
                                      {"kinemend", version()},
                                      {"command", command},
                                      {"takes", Json::array()}});
  if (takes.empty()) return document + "\n";
  // The entries are already text, and long for long takes: they are inserted without parsing.
  document.resize(document.rfind("[]"));
  document += "[\n";
  for (std::size_t i = 0; i < takes.size(); ++i) {
    append_indented(takes[i], 4, document);
    document += i + 1 < takes.size() ? ",\n" : "\n";
  }
  return document + "  ]\n}\n";
}

namespace {

// Rows are read from files, which may hold anything.
std::string word(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::size_t whole(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number_unsigned() ? found->get<std::size_t>() : 0;
}

double number(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number() ? found->get<double>() : 0.0;
}

std::vector<std::string> words(const Json& json, const char* key) {
  std::vector<std::string> list;
  const auto found = json.find(key);
  if (found == json.end() || !found->is_array()) return list;
  for (const Json& entry : *found) {
    if (entry.is_string()) list.push_back(entry.get<std::string>());
  }
  return list;
}

BatchRow row_of(const Json& json) {
  const auto found = json.find("figures");
  const Json figures = found != json.end() && found->is_object() ? *found : Json::object();
  BatchRow row;
  row.name = word(json, "name");
  row.status = word(json, "status");
  row.input = word(json, "input");
  row.verdict = word(json, "verdict");
  row.error = word(json, "error");
  row.warnings = words(json, "warnings");
  row.frames = whole(json, "frames");
  row.frames_repaired = whole(figures, "frames_repaired");
  row.spikes = whole(figures, "spikes");
  row.gaps = whole(figures, "gaps");
  row.frame_rate_hz = number(json, "frame_rate_hz");
  row.seconds = number(figures, "seconds");
  row.json = text_of(json, -1);
  return row;
}

Json heading(std::string_view name, std::string_view status) {
  return {{"schema", report_schema}, {"name", name}, {"status", status}};
}

}  // namespace

BatchRow plain_row(std::string_view name, std::string_view status) {
  return row_of(heading(name, status));
}

BatchRow cleaned_row(std::string_view name, const Report& report,
                     const std::vector<std::string>& warnings) {
  Json json = heading(name, "cleaned");
  json.update(take_json(report, Depth::row));
  json["warnings"] = warnings;
  return row_of(json);
}

BatchRow failed_row(std::string_view name, std::string_view input, std::string_view error,
                    int exit_code, const std::vector<std::string>& warnings) {
  Json json = heading(name, "failed");
  json.update(failure_entry(input, error, exit_code));
  if (!warnings.empty()) json["warnings"] = warnings;
  return row_of(json);
}

std::optional<BatchRow> parse_row(std::string_view json) {
  const Json parsed = parse_json<Json>(json, false);
  return parsed.is_object() ? std::optional(row_of(parsed)) : std::nullopt;
}

std::vector<BatchRow> worst_rows(std::span<const BatchRow> rows, std::size_t most) {
  const auto badness = [](const BatchRow& row) {
    const auto frames = static_cast<double>(std::max(row.frames, std::size_t{1}));
    return std::pair(row.warnings.size(), static_cast<double>(row.frames_repaired) / frames);
  };
  std::vector<BatchRow> worst;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(worst), [&](const BatchRow& row) {
    return row.status == "cleaned" && badness(row) > std::pair(std::size_t{0}, 0.0);
  });
  std::stable_sort(worst.begin(), worst.end(),
                   [&](const BatchRow& a, const BatchRow& b) { return badness(a) > badness(b); });
  if (worst.size() > most) worst.resize(most);
  return worst;
}

void BatchSums::add(std::string_view name, const BatchRow* row) {
  ++takes;
  if (row == nullptr) {
    ++to_do;
  } else if (row->status == "failed") {
    ++failed;
    failures.emplace_back(name, row->error);
  } else {
    ++cleaned;
    frames += row->frames;
    spikes += row->spikes;
    gaps += row->gaps;
    if (row->frame_rate_hz > 0) duration_s += static_cast<double>(row->frames) / row->frame_rate_hz;
    seconds += row->seconds;
  }
}

std::string to_json(const BatchSums& sums, std::string_view options_hash) {
  Json failures = Json::array();
  for (const auto& [name, error] : sums.failures)
    failures.push_back({{"name", name}, {"error", error}});
  return text_of(Json{{"schema", report_schema},
                      {"kinemend", version()},
                      {"command", "batch"},
                      {"options_hash", options_hash},
                      {"figures",
                       {{"takes", sums.takes},
                        {"cleaned", sums.cleaned},
                        {"failed", sums.failed},
                        {"to_do", sums.to_do},
                        {"frames", sums.frames},
                        {"duration_s", sums.duration_s},
                        {"seconds", sums.seconds},
                        {"spikes", sums.spikes},
                        {"gaps", sums.gaps}}},
                      {"failures", std::move(failures)}}) +
         "\n";
}

void BatchCounts::add(const BatchRow& row, bool is_new, int code) {
  exit_code = std::max(exit_code, code);
  if (code != 0) {
    ++failed;
    return;
  }
  with_warnings += row.warnings.empty() ? 0 : 1;
  if (row.status == "copied") {
    ++copied;
  } else {
    ++(is_new ? cleaned : kept);
  }
}

std::string to_text(const BatchCounts& counts, const BatchSums& sums,
                    std::span<const BatchRow> worst) {
  std::string text = fmt::format("{} {}, {} done already, {} failed", grouped(counts.cleaned),
                                 counts.work, grouped(counts.kept), grouped(counts.failed));
  if (counts.copied > 0) text += fmt::format(", {} copied", counted(counts.copied, "skeleton"));
  if (counts.with_warnings > 0)
    text += fmt::format(", {} with warnings", grouped(counts.with_warnings));
  if (counts.parts > 1) text += fmt::format(" (part {} of {})", counts.part, counts.parts);
  text += fmt::format("\n{}: {} of {} done, {} failed, {} to do; {:.1f} minutes of motion\n",
                      counts.parts > 1 ? "all parts" : "in total", grouped(sums.cleaned),
                      counted(sums.takes, "take"), grouped(sums.failed), grouped(sums.to_do),
                      sums.duration_s / 60);
  if (worst.empty()) return text;
  text += worst.size() == 1 ? "needs review:\n" : "needs review, worst first:\n";
  for (const BatchRow& row : worst) {
    text += fmt::format("  {}: {}", printable(row.name), printable(row.verdict));
    if (!row.warnings.empty()) text += "; " + printable(row.warnings.front());
    if (row.warnings.size() > 1) text += fmt::format(" (and {} more)", row.warnings.size() - 1);
    text += "\n";
  }
  return text;
}

}  // namespace kinemend
