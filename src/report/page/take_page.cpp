// Makes the page of a take's report.
#include <fmt/format.h>

#include <array>
#include <filesystem>

#include "kinemend/error.hpp"
#include "kinemend/experimental/page.hpp"
#include "report/page/channels.hpp"
#include "report/page/document.hpp"
#include "report/page/stage.hpp"
#include "report/page/take_json.hpp"

namespace kinemend {

namespace {

using page::Channels, page::Json, page::Stage;

void check_pair(std::size_t before_frames, std::size_t after_frames, std::size_t before_tracks,
                std::size_t after_tracks) {
  if (before_frames == after_frames && before_tracks == after_tracks) return;
  throw Error(ErrorKind::usage,
              fmt::format("report page: {} frames of {} tracks before, {} of {} after",
                          before_frames, before_tracks, after_frames, after_tracks));
}

void check_pair(const Clip& before, const Clip& after) {
  check_pair(before.frame_count(), after.frame_count(), before.joint_count(), after.joint_count());
  if (before.translated_joints != after.translated_joints)
    throw Error(ErrorKind::usage, "report page: other joints have positions before than after");
}
void check_pair(const MarkerClip& before, const MarkerClip& after) {
  check_pair(before.frame_count(), after.frame_count(), before.marker_count(),
             after.marker_count());
}

Stage stage_for(const Clip& clip, const Report& report) {
  Stage stage = page::stage_of(clip);
  const auto* clean = std::get_if<CleanOutcome>(&report.result);
  if (clean != nullptr && clean->report.feet)
    stage.contacts = page::contacts_of(*clean->report.feet, clip);
  return stage;
}
Stage stage_for(const MarkerClip& clip, const Report& /*report*/) { return page::stage_of(clip); }

// The motion in quanta as fine as they may be for a page of about two megabytes at most, of which
// its program takes a third.
template <class AnyTake>
Channels fine_channels(const AnyTake& before, const AnyTake* after, double body_height,
                       bool is_served) {
  constexpr double most_bytes = 1'000'000, least_share = 1.0 / 64, served_share = 1.0 / 16;
  // Nobody mails what is served, and somebody waits for it.
  if (is_served) return page::channels_of(before, after, body_height, served_share);
  double share = 1;
  Channels channels = page::channels_of(before, after, body_height, share);
  const std::size_t count = channels.samples.size();
  if (page::part_stride(channels.frames, count) > 1) return channels;
  const auto samples = static_cast<double>((after != nullptr ? 2 : 1) * count * channels.frames);
  while (share > least_share) {
    const auto size =
        static_cast<double>(page::deflated(page::first_part(channels.samples, 1)).size());
    // A quarter of the quantum is two bits a sample at most.
    if (size + samples / 4 > most_bytes) break;
    share /= 4;
    channels = page::channels_of(before, after, body_height, share);
  }
  return channels;
}

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

template <class AnyTake>
std::string take_page(const Report& report, const AnyTake& before, const AnyTake* after,
                      const PageSettings& settings) {
  page::check_is_built();
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
                       {"take", text_of(take)},
                       {"first", page::first_part(channels.samples, stride)}};
  if (stride > 1) parts.emplace_back("second", page::second_part(channels.samples, stride));
  for (const auto& [part, json] : settings.parts) parts.emplace_back(part, json);
  check();
  if (settings.is_served) return page::elements_of(parts);
  return page::document(fmt::format("{}: kinemend {}", name, settings.command),
                        fmt::format("{}: {}", name, verdict_of(report)), parts);
}

}  // namespace

std::string report_page(const Report& report, const Clip& before, const Clip* after,
                        const PageSettings& settings) {
  return take_page(report, before, after, settings);
}

std::string report_page(const Report& report, const MarkerClip& before, const MarkerClip* after,
                        const PageSettings& settings) {
  return take_page(report, before, after, settings);
}

}  // namespace kinemend
