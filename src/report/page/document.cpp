// Puts the program, the styles and the data of the page into one document, for the report of a take
// and for a batch.
#include "report/page/document.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <filesystem>

#include "kinemend/error.hpp"
#include "kinemend/extend/pages.hpp"
#include "kinemend/extend/system.hpp"
#include "kinemend/extend/text.hpp"
#include "report/page/codec.hpp"
#include "report/page/take_json.hpp"

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
