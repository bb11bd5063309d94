// Builds the document of a page, and collects the data of a take that the page needs besides its
// channels. Lines between markers make them look like a body instead of a cloud of dots.
#include "report/page/document.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <numeric>
#include <string>
#include <tuple>

#include "base/bytes.hpp"
#include "base/quantiles.hpp"
#include "check/checks.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/pages.hpp"
#include "kinemend/extend/system.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/report.hpp"
#include "kinemend/take.hpp"
#include "report/page/codec.hpp"

namespace kinemend {

bool has_report_page() { return !page::script.empty(); }

namespace page {

namespace {

// Returns the parts as elements of a document.
std::string elements_of(const Parts& parts) {
  std::string html;
  for (const auto& [name, bytes] : parts) {
    html += fmt::format("<script type=\"application/octet-stream\" id=\"data-{}\">", name);
    html += base64(deflated(bytes));
    html += "</script>\n";
  }
  return html;
}

}  // namespace

void check_is_built() {
  if (has_report_page()) return;
  throw Error(ErrorKind::usage,
              "this kinemend was built without its report page: a report can be "
              "written as FILE.json");
}

std::string joined(const Parts& parts) {
  std::string result = "[";
  std::size_t size = 0;
  for (const auto& [name, bytes] : parts) {
    result += fmt::format("{}[\"{}\",{}]", result.size() > 1 ? "," : "", name, bytes.size());
    size += bytes.size();
  }
  result += "]\n";
  result.reserve(result.size() + size);
  for (const auto& part : parts) result += part.second;
  return result;
}

std::string document(std::string_view title, std::string_view summary, const Parts& parts,
                     bool is_served) {
  check_is_built();
  // The policy forbids loading from anywhere else, whatever the data contains.
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
      "script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:{}\">\n"
      "<meta name=\"generator\" content=\"kinemend {}\">\n<title>{}</title>\n<style>{}</style>\n"
      "</head>\n<body>\n<main id=\"page\"><p class=\"first\">{}</p>\n"
      "<noscript><p>This page needs JavaScript to show the motion.</p></noscript></main>\n",
      is_served ? "; connect-src 'self'" : "", version(), xml_escaped(title), style,
      xml_escaped(summary));
  html += elements_of(parts);
  html += "<script>";
  html += script;
  html += "</script>\n</body>\n</html>\n";
  return html;
}

}  // namespace page

std::string served_page(std::string_view title, std::string_view summary,
                        std::span<const std::pair<std::string, std::string>> parts) {
  return page::document(title, summary, {parts.begin(), parts.end()}, true);
}

namespace {

using page::Channels, page::Json, page::Stage;

void check_pair(const Take& before, const Take& after) {
  const std::size_t tracks = before.owner_count(), after_tracks = after.owner_count();
  if (before.frame_count() != after.frame_count() || tracks != after_tracks) {
    throw Error(ErrorKind::usage,
                fmt::format("report page: {} frames of {} tracks before, {} of {} after",
                            before.frame_count(), tracks, after.frame_count(), after_tracks));
  }
  if (before.translated_joints != after.translated_joints)
    throw Error(ErrorKind::usage, "report page: other joints have positions before than after");
}

Stage stage_for(const Take& take, const Report& report) {
  Stage stage = page::stage_of(take);
  const auto* clean = std::get_if<CleanReport>(&report.result);
  if (clean != nullptr && clean->feet) stage.contacts = page::contacts_of(*clean->feet, take);
  const auto* check = std::get_if<CheckReport>(&report.result);
  if (check != nullptr && !check->stands.sides.empty())
    stage.contacts = page::contacts_of(check->stands);
  return stage;
}

// Returns the motion with the finest quanta for a page of about two megabytes at most, a third of
// which is its program.
Channels fine_channels(const Take& before, const Take* after, double body_height, bool is_served) {
  // Chosen by hand, not swept.
  constexpr double most_bytes = 1'000'000, least_share = 1.0 / 64, served_share = 1.0 / 16;
  // The size of a served page is not limited: it is not sent by mail, and the user is waiting.
  if (is_served) return page::channels_of(before, after, body_height, served_share);
  double share = 1;
  Channels channels = page::channels_of(before, after, body_height, share);
  const std::size_t count = channels.samples.size();
  if (page::part_stride(channels.frames, count) > 1) return channels;
  const auto samples = static_cast<double>((after != nullptr ? 2 : 1) * count * channels.frames);
  while (share > least_share) {
    const auto size =
        static_cast<double>(page::deflated(page::first_part(channels.samples, 1)).size());
    // A quarter of the quantum adds two bits a sample at most.
    if (size + samples / 4 > most_bytes) break;
    share /= 4;
    channels = page::channels_of(before, after, body_height, share);
  }
  return channels;
}

std::string dumped(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string report_page(const Report& report, const Take& before, const Take* after,
                        const PageSettings& settings) {
  // A served take is shown by a page that is already open.
  if (!settings.is_served) page::check_is_built();
  if (after != nullptr) check_pair(before, *after);
  const auto check = [&] {
    if (settings.check) settings.check();
  };
  check();
  const Stage stage = stage_for(after != nullptr ? *after : before, report);
  check();
  const Channels channels = fine_channels(before, after, stage.height, settings.is_served);
  check();
  Json take = page::take_json(before, after, channels, stage);
  take["command_line"] = settings.command_line;
  take["labels"] = {settings.before_label, settings.after_label};
  const std::size_t stride = take["stride"].get<std::size_t>();
  const std::array<std::string, 1> entries = {to_json(report)};
  const std::string name = std::filesystem::path(report.take.input).filename().string();
  page::Parts parts = {{"report", report_document(settings.command, entries)},
                       {"take", dumped(take)},
                       {"first", page::first_part(channels.samples, stride)}};
  if (stride > 1) parts.emplace_back("second", page::second_part(channels.samples, stride));
  for (const auto& [part, json] : settings.parts) parts.emplace_back(part, json);
  check();
  if (settings.is_served) return page::joined(parts);
  return page::document(fmt::format("{}: kinemend {}", name, settings.command),
                        fmt::format("{}: {}", name, verdict_of(report)), parts);
}

namespace {

// Returns the text as a JSON string.
std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

std::string batch_page(std::span<const BatchPageRow> rows, const BatchSums& sums,
                       const PageSettings& settings) {
  page::check_is_built();
  // Rows and sums are already JSON.
  std::string text = "[";
  for (const BatchPageRow& entry : rows) {
    text += fmt::format("{}{{\"row\": {}, \"page\": {}, \"picture\": {}}}",
                        text.size() > 1 ? ",\n" : "", entry.row.json, quoted(entry.page),
                        quoted(entry.picture));
  }
  const std::string batch = fmt::format("{{\"command_line\": {}, \"summary\": {}, \"rows\": {}]}}",
                                        quoted(settings.command_line), to_json(sums, ""), text);
  const std::string verdict = fmt::format("{} of {} done, {} failed", grouped(sums.cleaned),
                                          counted(sums.takes, "take"), grouped(sums.failed));
  return page::document("kinemend batch", verdict, {{"batch", batch}});
}

}  // namespace kinemend

namespace kinemend::page {

namespace {

Json json_of(Vec3 v) { return {v.x, v.y, v.z}; }
Json json_of(Quat q) { return {q.w, q.x, q.y, q.z}; }

Json json_of(const std::vector<Gap>& gaps) {
  Json list = Json::array();
  for (const Gap& gap : gaps) list.push_back({gap.track, gap.first_frame, gap.last_frame});
  return list;
}

Json json_of(const Stage& stage) {
  static constexpr const char* axes[] = {"x", "y", "z"};
  Json contacts = Json::array();
  for (const StageContact& contact : stage.contacts) {
    contacts.push_back({{"points", contact.points},
                        {"first", contact.first_frame},
                        {"last", contact.last_frame},
                        {"foot", contact.foot},
                        {"confidence", contact.confidence}});
  }
  return {{"up", axes[static_cast<std::size_t>(stage.up.axis)]},
          {"sign", stage.up.sign},
          {"floor", stage.floor},
          {"height", stage.height},
          {"contacts", std::move(contacts)}};
}

Json skeleton_json(const Take& before, const Take* after) {
  const Skeleton& skeleton = before.skeleton;
  Json offsets = Json::array(), rests = Json::array(), ends = Json::array();
  Json orders = Json::array();
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    offsets.push_back(json_of(skeleton.offsets[j]));
    rests.push_back(json_of(skeleton.rest_rotations[j]));
    const RotationOrder order = told_order(before, after, j);
    orders.push_back(order.count > 0 ? to_string(order) : "");
  }
  for (const EndSite& end : skeleton.end_sites)
    ends.push_back({{"parent", end.parent}, {"offset", json_of(end.offset)}});
  return {{"parents", skeleton.parents},
          {"offsets", offsets},
          {"rests", rests},
          {"orders", orders},
          {"ends", ends},
          {"translated", before.translated_joints}};
}

Json gaps_json(const Take* take) {
  if (take == nullptr) return nullptr;
  return {{"own", json_of(find_gaps(*take))}, {"positions", json_of(find_position_gaps(*take))}};
}

}  // namespace

Json take_json(const Take& before, const Take* after, const Channels& channels,
               const Stage& stage) {
  const TakeFacts facts = take_facts(before);
  Json json = {{"kind", before.has_joints() ? "joints" : "markers"},
               {"names", facts.tracks},
               {"frames", facts.frames},
               {"told", channels.frames},
               {"step", channels.step},
               {"stride", part_stride(channels.frames, channels.samples.size())},
               {"first_frame", facts.first_frame},
               {"rate", facts.frame_rate_hz},
               {"unit", facts.unit},
               {"two", after != nullptr},
               {"quanta", channels.quanta},
               {"stage", json_of(stage)},
               {"gaps", {{"before", gaps_json(&before)}, {"after", gaps_json(after)}}}};
  if (before.has_joints()) {
    json["skeleton"] = skeleton_json(before, after);
    return json;
  }
  json["shown"] = Json::array();
  for (std::size_t m = 0; m < before.marker_count(); ++m)
    json["shown"].push_back(before.holds_positions(m));
  json["links"] = marker_links(before, stage.height);
  return json;
}

namespace {

using check::BodyPoints, feet::along, feet::Up;

// Returns the level above which nearly all of the body stays in nearly all inspected frames.
template <class PointAt>
double lowest_level(std::size_t frames, std::size_t points, Up up, const PointAt& at) {
  // Frames are spread evenly over the take: for speed, not swept.
  constexpr std::size_t looked_at = 500;
  std::vector<double> lowest;
  const std::size_t count = std::min(frames, looked_at);
  for (std::size_t i = 0; i < count; ++i) {
    std::optional<double> low;
    for (std::size_t p = 0; p < points; ++p) {
      const std::optional<Vec3> point = at(i * frames / count, p);
      if (point) low = std::min(low.value_or(along(*point, up)), along(*point, up));
    }
    if (low) lowest.push_back(*low);
  }
  return quantile_of(lowest, 0.05);
}

// Finds the contacts and their floor, for a body in metres. `points`: index in the take of each of
// its points.
void find_feet(const BodyPoints& body, const std::vector<std::size_t>& points,
               double metres_per_unit, Stage& stage) {
  if (body.feet.empty()) return;
  const auto up = find_up(body);
  if (!up) return;
  stage.up = *up;
  std::vector<double> levels;
  for (const check::Contact& contact : check::find_contacts(body, *up)) {
    StageContact& added = stage.contacts.emplace_back();
    added.first_frame = contact.span.first;
    added.last_frame = contact.span.last;
    for (const std::size_t point : body.feet[contact.foot].points)
      added.points.push_back(points[point]);
    added.foot = body.feet[contact.foot].name;
    levels.push_back(along(contact.place, *up) / metres_per_unit);
  }
  if (!levels.empty()) stage.floor = median_of(levels);
}

std::vector<std::size_t> counted_up(std::size_t count) {
  std::vector<std::size_t> result(count);
  std::iota(result.begin(), result.end(), std::size_t{0});
  return result;
}

void stand_joints(const Take& clip, Stage& stage) {
  if (const double scale = likely_metres_per_unit(clip); scale > 0) {
    find_feet(check::body_points(clip, scale),
              counted_up(clip.joint_count() + clip.skeleton.end_sites.size()), scale, stage);
  }
  if (!stage.contacts.empty()) return;
  Pose pose;
  std::size_t posed = clip.frame_count();
  stage.floor = lowest_level(clip.frame_count(), clip.joint_count(), stage.up,
                             [&](std::size_t frame, std::size_t joint) -> std::optional<Vec3> {
                               if (posed != frame) pose = forward_kinematics(clip, frame);
                               posed = frame;
                               return pose.positions[joint];
                             });
}

void stand_markers(const Take& clip, Stage& stage) {
  std::vector<std::size_t> markers;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    if (clip.holds_positions(m)) markers.push_back(m);
  }
  if (const double scale = likely_metres_per_unit(clip); scale > 0)
    find_feet(check::body_points(clip, markers, scale), markers, scale, stage);
  if (!stage.contacts.empty()) return;
  stage.floor = lowest_level(clip.frame_count(), markers.size(), stage.up,
                             [&](std::size_t frame, std::size_t i) -> std::optional<Vec3> {
                               if (!clip.is_observed(frame, markers[i])) return std::nullopt;
                               return clip.position(frame, markers[i]);
                             });
}

}  // namespace

Stage stage_of(const Take& take) {
  Stage stage;
  stage.height = take.has_joints()        ? body_height(take.skeleton)
                 : take.frame_count() > 0 ? body_height(take)
                                          : 1;
  if (!(stage.height > 0)) stage.height = 1;
  if (take.frame_count() == 0) return stage;
  stage.up = {guess_up_axis(take), 1};
  if (take.has_joints())
    stand_joints(take, stage);
  else
    stand_markers(take, stage);
  return stage;
}

namespace {

std::string part_of_foot(std::string_view side, FootPart part) {
  return fmt::format("{} {}", side, to_string(part));
}

}  // namespace

std::vector<StageContact> contacts_of(const FeetReport& report, const Take& clip) {
  const std::vector<Leg> legs = find_legs(clip.skeleton);
  std::vector<StageContact> contacts;
  for (const FootContact& contact : report.contacts) {
    if (contact.leg >= legs.size()) continue;
    const Leg& leg = legs[contact.leg];
    const bool is_toe = contact.part == FootPart::toe && leg.toe >= 0;
    contacts.push_back({{static_cast<std::size_t>(is_toe ? leg.toe : leg.ankle)},
                        contact.first_frame,
                        contact.last_frame,
                        part_of_foot(report.sides[contact.leg], contact.part),
                        contact.confidence});
  }
  return contacts;
}

std::vector<StageContact> contacts_of(const FootStands& stands) {
  std::vector<StageContact> contacts;
  for (const FootContact& contact : stands.contacts) {
    contacts.push_back({{stands.tracks[contact.leg][static_cast<std::size_t>(contact.part)]},
                        contact.first_frame,
                        contact.last_frame,
                        part_of_foot(stands.sides[contact.leg], contact.part),
                        contact.confidence});
  }
  return contacts;
}

namespace {

// For speed, not swept.
constexpr std::size_t most_frames = 120, fewest_frames = 24;
// The most distances measured, whatever the number of markers. For speed, not swept.
constexpr std::size_t most_distances = 4'000'000;
constexpr std::size_t most_markers = 1000;
// Share of the frames looked at in which both markers must be observed. Chosen by hand, not swept.
constexpr double least_together = 0.2;
// Limits of a line: its length as a share of the body height, and the variation of the distance as
// a share of itself. Chosen by hand, not swept.
constexpr double longest_line = 0.4, largest_change = 0.35;
// The cost of distance relative to that of variation; on a rigid body it prefers neighbours. Chosen
// by hand, not swept.
constexpr double weight_of_length = 0.25;

struct Candidate {
  double cost;
  std::size_t a, b;
};

// Sets of markers that are already connected.
class Groups {
 public:
  explicit Groups(std::size_t count) : parents_(count) {
    std::iota(parents_.begin(), parents_.end(), std::size_t{0});
  }
  // Returns false if both are already in one group.
  bool join(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    parents_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

 private:
  std::size_t root(std::size_t marker) {
    while (parents_[marker] != marker) marker = parents_[marker] = parents_[parents_[marker]];
    return marker;
  }
  std::vector<std::size_t> parents_;
};

std::vector<std::size_t> linked_markers(const Take& clip) {
  std::vector<std::size_t> markers;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    // A name with a star is a piece of an unlabelled trajectory.
    if (clip.holds_positions(m) && !clip.names[m].starts_with('*')) markers.push_back(m);
  }
  return markers;
}

std::vector<std::size_t> frames_to_look_at(std::size_t frames, std::size_t markers) {
  const std::size_t pairs = std::max<std::size_t>(1, markers * (markers - 1) / 2);
  const std::size_t count =
      std::min(frames, std::clamp(most_distances / pairs, fewest_frames, most_frames));
  std::vector<std::size_t> looked_at(count);
  for (std::size_t i = 0; i < count; ++i) looked_at[i] = i * frames / count;
  return looked_at;
}

}  // namespace

std::vector<std::array<std::size_t, 2>> marker_links(const Take& clip, double body_height) {
  const std::vector<std::size_t> markers = linked_markers(clip);
  if (markers.size() < 2 || markers.size() > most_markers) return {};
  const std::vector<std::size_t> frames = frames_to_look_at(clip.frame_count(), markers.size());
  const auto fewest = std::max<std::size_t>(
      1, static_cast<std::size_t>(least_together * static_cast<double>(frames.size())));
  std::vector<Candidate> candidates;
  std::vector<double> distances;
  for (std::size_t i = 0; i < markers.size(); ++i) {
    for (std::size_t k = i + 1; k < markers.size(); ++k) {
      const std::size_t a = markers[i], b = markers[k];
      distances.clear();
      for (const std::size_t f : frames) {
        if (clip.is_observed(f, a) && clip.is_observed(f, b))
          distances.push_back(norm(clip.position(f, a) - clip.position(f, b)));
      }
      if (distances.size() < fewest) continue;
      // Quantiles ignore swaps and spikes.
      const double usual = quantile_of(distances, 0.5);
      const double change = quantile_of(distances, 0.9) - quantile_of(distances, 0.1);
      if (!(usual > 0) || usual > longest_line * body_height || change > largest_change * usual)
        continue;
      candidates.push_back({change + weight_of_length * usual, a, b});
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& x, const Candidate& y) {
    return std::tie(x.cost, x.a, x.b) < std::tie(y.cost, y.a, y.b);
  });
  Groups groups(clip.marker_count());
  std::vector<std::array<std::size_t, 2>> links;
  for (const Candidate& candidate : candidates) {
    if (groups.join(candidate.a, candidate.b)) links.push_back({candidate.a, candidate.b});
  }
  return links;
}

}  // namespace kinemend::page
