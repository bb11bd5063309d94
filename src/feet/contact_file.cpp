#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>
#include <tuple>

#include "base/quote.hpp"
#include "kinemend/error.hpp"
#include "kinemend/feet.hpp"

namespace kinemend {

namespace {

constexpr std::string_view heading =
    "# Times in which a foot stands: side, heel or toe, first and last frame (from 1).\n"
    "# What is listed is held in place; lines that start with # are not.\n";

std::string line_of(const std::vector<Leg>& legs, const FootContact& contact) {
  // A name with a space would be two words.
  std::string side = legs[contact.leg].side;
  std::replace_if(
      side.begin(), side.end(), [](char c) { return c == ' ' || c == '\t' || c == '#'; }, '_');
  return fmt::format("{} {} {} {}", side, to_string(contact.part), contact.first_frame + 1,
                     contact.last_frame + 1);
}

class ContactReader {
 public:
  ContactReader(std::string_view name, const Clip& clip)
      : name_(name), frames_(clip.frame_count()), legs_(find_legs(clip.skeleton)) {}

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
      fail(fmt::format("expected a last frame from {} on, found {}", contact.first_frame + 1,
                       contact.last_frame + 1));
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
                           before.first_frame + 1, before.last_frame + 1));
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
      const std::string line = line_of(legs_, {l, FootPart::heel, 0, 0});
      const std::string own = line.substr(0, line.find(' '));
      if (side == own) return l;
      names += (l == 0 ? "" : " or ") + own;
    }
    if (legs_.empty()) fail("expected no contact: the skeleton has no legs");
    fail(fmt::format("expected {}, found {}", names, quote(side)));
  }

  FootPart part(std::string_view name) const {
    if (name == "heel") return FootPart::heel;
    if (name == "toe") return FootPart::toe;
    fail(fmt::format("expected heel or toe, found {}", quote(name)));
  }

  std::size_t frame(std::string_view text, std::string_view what) const {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size() || number < 1 || number > frames_)
      fail(fmt::format("expected a {} of 1 to {}, found {}", what, frames_, quote(text)));
    return number - 1;
  }

  std::string_view name_;
  std::size_t frames_;
  std::vector<Leg> legs_;
  std::size_t number_ = 0;
  std::string_view rest_;
  std::vector<Line> lines_;
};

}  // namespace

std::string contacts_text(const Clip& clip, const std::vector<FootContact>& contacts) {
  const std::vector<Leg> legs = find_legs(clip.skeleton);
  std::string text(heading);
  for (const FootContact& contact : contacts) text += line_of(legs, contact) + "\n";
  return text;
}

std::string contacts_text(const Clip& clip, const FeetReport& report) {
  const std::vector<Leg> legs = find_legs(clip.skeleton);
  std::string text(heading);
  for (std::size_t i = 0; i < report.contacts.size(); ++i) {
    const std::string line = line_of(legs, report.contacts[i]);
    text += report.held[i] != 0 || report.still[i] != 0
                ? line + "\n"
                : fmt::format("# {}  {}\n", line, report.reasons[i]);
  }
  return text;
}

std::vector<FootContact> parse_contacts(std::string_view text, std::string_view name,
                                        const Clip& clip) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.substr(0, byte_order_mark.size()) == byte_order_mark)
    text.remove_prefix(byte_order_mark.size());
  ContactReader reader(name, clip);
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    reader.read(text.substr(0, end), number);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return reader.finish();
}

}  // namespace kinemend
