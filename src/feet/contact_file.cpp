// Reads and writes contacts as text, with the names of the parts of a foot.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>

#include "base/text.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/feet.hpp"

namespace kinemend {

namespace {

constexpr std::string_view heading =
    "# Times in which a foot stands: side, heel or toe, first and last frame, numbered as in the "
    "take.\n"
    "# What is listed is held in place; lines that start with # are not. Behind # is how likely "
    "the foot stands.\n";

std::string line_of(std::string side, const FootContact& contact, std::int64_t first_frame) {
  const auto number = [&](std::size_t frame) {
    return static_cast<std::int64_t>(frame) + first_frame;
  };
  // The spaces are replaced, because a name with a space would be read as two fields.
  std::replace_if(
      side.begin(), side.end(), [](char c) { return c == ' ' || c == '\t' || c == '#'; }, '_');
  return fmt::format("{} {} {} {}", side, to_string(contact.part), number(contact.first_frame),
                     number(contact.last_frame));
}

std::vector<Leg> legs_of(Skeleton skeleton, const KnownNames& names) {
  skeleton.names = known_names(skeleton.names, names);
  return find_legs(skeleton);
}

class ContactReader {
 public:
  ContactReader(std::string_view name, const Take& clip, const KnownNames& names)
      : name_(name),
        frames_(static_cast<std::int64_t>(clip.frame_count())),
        first_frame_(first_frame_number(clip)),
        legs_(legs_of(clip.skeleton, names)) {}

  void read(std::string_view line, std::size_t number) {
    number_ = number;
    rest_ = line.substr(0, line.find('#'));
    const std::string_view side = word();
    if (side.empty()) return;
    FootContact contact;
    contact.leg = leg(side);
    contact.part = part(word());
    contact.first_frame = frame(word(), "first frame");
    contact.last_frame = frame(word(), "last frame");
    if (contact.last_frame < contact.first_frame) {
      fail(fmt::format("expected a last frame from {} on, found {}", numbered(contact.first_frame),
                       numbered(contact.last_frame)));
    }
    if (const std::string_view more = word(); !more.empty())
      fail(fmt::format("expected the end of the line, found {}", quote(more)));
    lines_.push_back({contact, number});
  }

  std::vector<FootContact> finish() {
    std::sort(lines_.begin(), lines_.end(), [](const Line& a, const Line& b) {
      return std::tie(a.contact.leg, a.contact.part, a.contact.first_frame, a.number) <
             std::tie(b.contact.leg, b.contact.part, b.contact.first_frame, b.number);
    });
    std::vector<FootContact> contacts;
    for (const Line& line : lines_) {
      if (!contacts.empty()) {
        const FootContact& before = contacts.back();
        if (before.leg == line.contact.leg && before.part == line.contact.part &&
            line.contact.first_frame <= before.last_frame) {
          number_ = line.number;
          fail(fmt::format("expected frames of their own, found some of {} to {} again",
                           numbered(before.first_frame), numbered(before.last_frame)));
        }
      }
      contacts.push_back(line.contact);
    }
    return contacts;
  }

 private:
  struct Line {
    FootContact contact;
    std::size_t number = 0;
  };

  [[noreturn]] void fail(const std::string& message) const {
    throw Error::at_line(name_, number_, message);
  }

  std::string_view word() {
    constexpr std::string_view blanks = " \t\r,;";
    const std::size_t first = rest_.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    const std::size_t last = std::min(rest_.find_first_of(blanks, first), rest_.size());
    const std::string_view found = rest_.substr(first, last - first);
    rest_.remove_prefix(last);
    return found;
  }

  std::size_t leg(std::string_view side) const {
    std::string names;
    for (std::size_t l = 0; l < legs_.size(); ++l) {
      const std::string line = line_of(legs_[l].side, {l, FootPart::heel, 0, 0}, 1);
      const std::string own = line.substr(0, line.find(' '));
      if (same_but_for_case(side, own)) return l;
      names += (l == 0 ? "" : " or ") + own;
    }
    if (legs_.empty()) fail("expected no contact: the skeleton has no legs");
    fail(fmt::format("expected {}, found {}", names, quote(side)));
  }

  FootPart part(std::string_view name) const {
    if (same_but_for_case(name, "heel")) return FootPart::heel;
    if (same_but_for_case(name, "toe")) return FootPart::toe;
    fail(fmt::format("expected heel or toe, found {}", quote(name)));
  }

  std::size_t frame(std::string_view text, std::string_view what) const {
    std::int64_t found = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), found);
    const std::int64_t last = first_frame_ + frames_ - 1;
    const bool is_number = error == std::errc{} && end == text.data() + text.size();
    if (!is_number || found < first_frame_ || found > last)
      fail(fmt::format("expected a {} of {} to {}, found {}", what, first_frame_, last,
                       quote(text)));
    return static_cast<std::size_t>(found - first_frame_);
  }

  std::int64_t numbered(std::size_t frame) const {
    return static_cast<std::int64_t>(frame) + first_frame_;
  }

  std::string_view name_;
  std::int64_t frames_, first_frame_;
  std::vector<Leg> legs_;
  std::size_t number_ = 0;
  std::string_view rest_;
  std::vector<Line> lines_;
};

}  // namespace

std::string contacts_text(const Take& clip, const std::vector<FootContact>& contacts) {
  const std::vector<Leg> legs = find_legs(clip.skeleton);
  std::string text(heading);
  for (const FootContact& contact : contacts)
    text += line_of(legs[contact.leg].side, contact, first_frame_number(clip)) + "\n";
  return text;
}

std::string contacts_text(const Take& clip, const FeetReport& report) {
  std::string text(heading);
  for (std::size_t i = 0; i < report.contacts.size(); ++i) {
    const std::string line =
        line_of(report.sides[report.contacts[i].leg], report.contacts[i], first_frame_number(clip));
    const bool is_listed = report.held[i] != 0 || report.still[i] != 0;
    text += fmt::format("{}{}  # {:.2f}{}{}\n", is_listed ? "" : "# ", line,
                        report.contacts[i].confidence, is_listed ? "" : "  ",
                        is_listed ? "" : report.reasons[i]);
  }
  return text;
}

std::vector<std::vector<double>> contact_curves(const FeetReport& report, std::size_t frames) {
  std::vector<std::vector<double>> curves(report.sides.size(), std::vector<double>(frames));
  for (const FootContact& contact : report.contacts) {
    std::vector<double>& curve = curves[contact.leg];
    std::fill(curve.begin() + static_cast<std::ptrdiff_t>(contact.first_frame),
              curve.begin() + static_cast<std::ptrdiff_t>(contact.last_frame + 1), 1.0);
  }
  return curves;
}

std::string contact_curve_name(std::string_view side) {
  if (side == "left") return "contact_l";
  if (side == "right") return "contact_r";
  return fmt::format("contact_{}", side);
}

std::vector<FootContact> parse_contacts(std::string_view text, std::string_view name,
                                        const Take& clip, const KnownNames& names) {
  text = without_byte_order_mark(text);
  ContactReader reader(name, clip, names);
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    reader.read(text.substr(0, end), number);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return reader.finish();
}

std::string_view to_string(FootPart part) { return part == FootPart::heel ? "heel" : "toe"; }

}  // namespace kinemend
