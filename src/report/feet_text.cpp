// Writes the changes that `clean` made to the feet as text.
#include <fmt/format.h>

#include "kinemend/experimental/frame_numbers.hpp"
#include "kinemend/experimental/text.hpp"
#include "report/clean_counts.hpp"
#include "report/texts.hpp"

namespace kinemend {

namespace {

std::string contact_text(const FeetReport& report, const FootContact& contact,
                         std::int64_t first_frame) {
  return fmt::format("{} {}, frames {} to {}", printable_name(report.sides[contact.leg]),
                     to_string(contact.part), frame_number(contact.first_frame, first_frame),
                     frame_number(contact.last_frame, first_frame));
}

// Contacts that were already still are not listed.
std::string left_alone_text(const FeetReport& report, std::int64_t first_frame, bool all_rows) {
  // Chosen by hand.
  constexpr std::size_t short_list = 8;
  std::string text;
  std::size_t listed = 0;
  for (std::size_t i = 0; i < report.contacts.size(); ++i) {
    const bool is_news = report.held[i] == 0 && report.still[i] == 0;
    if (!is_news && !(all_rows && report.held[i] == 0)) continue;
    if (++listed > short_list && !all_rows) continue;
    text += fmt::format("    {}: {}\n", contact_text(report, report.contacts[i], first_frame),
                        report.reasons[i]);
  }
  if (listed == 0) return text;
  text = fmt::format("  {} left alone:\n", counted(listed, "contact")) + text;
  if (listed > short_list && !all_rows)
    text += fmt::format("    and {} more (--verbose lists them)\n", listed - short_list);
  return text;
}

}  // namespace

std::string feet_text(const FeetReport& report, std::int64_t first_frame, bool all) {
  const std::size_t held = contacts_held(report);
  std::string text =
      fmt::format("  feet: {} of {} held", held, counted(report.contacts.size(), "contact"));
  const bool in_cm = report.metres_per_unit > 0;
  const double scale = in_cm ? 100 * report.metres_per_unit : 1;
  const std::string unit = in_cm ? "cm" : "units";
  const FeetFigures &a = report.before, &b = report.after;
  // A held slide leaves rounding errors, which are shown as 0.
  const auto length = [&](double units) {
    // In the unit that is shown. Chosen by hand.
    constexpr double least = 1e-5;
    return figure(scale * units < least ? 0 : scale * units);
  };
  if (held > 0) text += fmt::format(", {} adjusted", counted(frames_adjusted(report), "frame"));
  if (!report.contacts.empty()) {
    text += fmt::format(
        "; slide {} to {} {} a frame, {} to {} {} at most, sink {} to {} {}, knee pop {} to {} deg",
        length(a.slide), length(b.slide), unit, length(a.most_slide), length(b.most_slide), unit,
        length(a.sink), length(b.sink), unit, figure(a.knee_pop_deg), figure(b.knee_pop_deg));
  }
  return text + "\n" + left_alone_text(report, first_frame, all);
}

}  // namespace kinemend
