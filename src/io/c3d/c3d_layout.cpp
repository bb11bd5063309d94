// Finds the layout on which the header, the parameters and the file's size agree.
#include "io/c3d/c3d_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "io/reading_limits.hpp"
#include "kinemend/extend/frames.hpp"

namespace kinemend {

namespace {

constexpr std::size_t up_to_the_end = std::numeric_limits<std::size_t>::max();

// The number of frames according to one place in the file.
struct FrameClaim {
  std::size_t count = 0;
  std::int64_t first = 1;
};

// Adds a claim if it is new. Claims are in the order of trust.
template <class T>
void add_claim(std::vector<T>& claims, std::optional<T> claim) {
  if (claim && std::find(claims.begin(), claims.end(), *claim) == claims.end())
    claims.push_back(*claim);
}

void add_frames(std::vector<FrameClaim>& claims, std::int64_t first, double count) {
  if (count >= 0 && count <= 4294967295.0)
    claims.push_back({static_cast<std::size_t>(count), first});
}

std::size_t claimed(std::size_t count) { return count; }
std::size_t claimed(const FrameClaim& claim) { return claim.count; }

// Puts the claim that most others agree with first, and otherwise keeps the order.
template <class Claim>
void sort_by_agreement(std::vector<Claim>& claims) {
  std::vector<Claim> sorted = claims;
  const auto agreeing = [&](const Claim& claim) {
    return std::count_if(claims.begin(), claims.end(),
                         [&](const Claim& other) { return claimed(other) == claimed(claim); });
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Claim& a, const Claim& b) { return agreeing(a) > agreeing(b); });
  claims = std::move(sorted);
}

class LayoutFinder {
 public:
  LayoutFinder(const C3dSource& source, const C3dHeader& header, const C3dParameters& parameters)
      : source_(source), header_(header), parameters_(parameters) {
    layout_.header_begin = header.begin;
    layout_.parameters_begin = header.parameters_begin;
  }

  C3dLayout find() {
    find_scale();
    find_rate();
    collect_claims();
    choose();
    layout_.analog_count = analog_count();
    return layout_;
  }

 private:
  void note(std::string_view kind, std::size_t word, std::string_view message) const {
    source_.note(kind, header_.place_of(word), message);
  }

  void find_scale() {
    const auto parameter = parameters_.number("POINT", "SCALE");
    const double in_header = header_.scale;
    const auto usable = [](double scale) { return std::isfinite(scale) && scale != 0; };
    double scale = parameter && usable(*parameter) ? *parameter : in_header;
    if (!usable(scale)) {
      scale = 1;
      if (header_.point_count > 0)
        note("scale_assumed", 7, "the file has no scale: a scale of 1 is assumed");
    } else if (parameter && usable(*parameter) && usable(in_header) &&
               std::fabs(std::fabs(*parameter) - std::fabs(in_header)) >
                   1e-4 * std::fabs(in_header)) {
      note("scale_mismatch", 7,
           fmt::format(
               "the scale of the header is {:.6g}, POINT:SCALE is {:.6g}: the latter is used",
               in_header, *parameter));
    }
    layout_.scale = std::fabs(scale);
    floats_.push_back(scale < 0);
    add_claim(floats_, std::optional<bool>(in_header < 0));
  }

  void find_rate() {
    double unusable = 0;
    for (const double rate :
         {parameters_.number("POINT", "RATE").value_or(0), static_cast<double>(header_.rate_hz),
          parameters_.number("TRIAL", "CAMERA_RATE").value_or(0)}) {
      if (is_usable_frame_rate(rate)) {
        layout_.rate_hz = rate;
        return;
      }
      if (rate > 0 && unusable == 0) unusable = rate;
    }
    if (unusable > 0) note("frame_rate_unusable", 11, unusable_rate_text(unusable));
  }

  std::optional<std::size_t> data_begin(std::size_t block) const {
    const std::size_t begin = header_.begin + (block - 1) * c3d_block_bytes;
    if (block < 2 || begin <= header_.parameters_begin || begin > source_.bytes.size())
      return std::nullopt;
    return begin;
  }

  std::size_t analog_count() const {
    const auto used = parameters_.count("ANALOG", "USED");
    if (used) return *used;
    return header_.analog_values / std::max<std::size_t>(header_.analog_instants, 1);
  }

  void collect_claims() {
    add_claim(begins_, data_begin(parameters_.count("POINT", "DATA_START").value_or(0)));
    add_claim(begins_, data_begin(header_.data_block));
    add_claim(points_, parameters_.count("POINT", "USED"));
    add_claim(points_, std::optional(header_.point_count));
    collect_analog_claims();
    collect_frame_claims();
    if (begins_.empty()) {
      throw source_.error_at(
          header_.place_of(9),
          fmt::format("the data would start in block {}, which is not in the file",
                      header_.data_block));
    }
  }

  void collect_analog_claims() {
    const std::size_t used = analog_count();
    std::vector<std::size_t> claims{header_.analog_values, used * header_.analog_instants};
    const double ratio = parameters_.number("ANALOG", "RATE").value_or(0) / layout_.rate_hz;
    if (ratio >= 1 && ratio < most_in_a_word)
      claims.push_back(used * static_cast<std::size_t>(std::lround(ratio)));
    sort_by_agreement(claims);
    for (const std::size_t claim : claims) add_claim(analog_, std::optional(claim));
  }

  // The numbers of the first and the last frame, each as low word, high word. Some writers multiply
  // the high word by 65,535, because of a misprint in the format's manual.
  void collect_trial_claims() {
    const auto begin = parameters_.numbers("TRIAL", "ACTUAL_START_FIELD");
    const auto end = parameters_.numbers("TRIAL", "ACTUAL_END_FIELD");
    if (begin.empty() || end.empty()) return;
    const auto word = [](const std::vector<double>& words, std::size_t i) {
      const double value = i < words.size() ? words[i] : 0;
      return value < 0 ? value + 65536 : value;
    };
    const bool has_high_word = word(begin, 1) > 0 || word(end, 1) > 0;
    for (const double high : {65536.0, 65535.0}) {
      if (high < 65536 && !has_high_word) return;
      const double first = word(begin, 0) + high * word(begin, 1);
      const double last = word(end, 0) + high * word(end, 1);
      if (first <= 4294967295.0)
        add_frames(frames_, static_cast<std::int64_t>(first), last - first + 1);
    }
  }

  void collect_frame_claims() {
    collect_trial_claims();
    const auto first = static_cast<std::int64_t>(header_.first_frame);
    add_frames(frames_, first, parameters_.number("POINT", "LONG_FRAMES").value_or(-1));
    const double frames = parameters_.number("POINT", "FRAMES").value_or(-1);
    if (frames > most_in_a_word || frames < -1) {
      add_frames(frames_, first, frames < 0 ? frames + 65536 : frames);
    } else if (frames < most_in_a_word) {
      add_frames(frames_, first, frames);
    }
    if (header_.last_frame < most_in_a_word) {
      add_frames(
          frames_, first,
          static_cast<double>(header_.last_frame) - static_cast<double>(header_.first_frame) + 1);
    }
    sort_by_agreement(frames_);
    if (!frames_.empty()) return;
    note("frame_count_assumed", 5,
         "the file does not state its number of frames: it is read to the end");
    frames_.push_back({up_to_the_end, first});
  }

  // Ranks a reading of the file: 2 if the data ends with the file, 1 if the data fits in it.
  int rank(const C3dLayout& layout) const {
    const std::size_t bytes = layout.frame_bytes();
    if (bytes > 0 && layout.frame_count > whole_frames(layout)) return 0;
    return source_.bytes.size() - layout.data_begin - layout.frame_count * bytes < c3d_block_bytes
               ? 2
               : 1;
  }

  // Returns all readings, the most trusted first.
  std::vector<C3dLayout> readings() const {
    std::vector<C3dLayout> all;
    for (const std::size_t begin : begins_)
      for (const bool is_float : floats_)
        for (const std::size_t points : points_)
          for (const std::size_t analog : analog_)
            for (const FrameClaim& claim : frames_) {
              C3dLayout& layout = all.emplace_back(layout_);
              layout.data_begin = begin;
              layout.is_float = is_float;
              layout.point_count = points;
              layout.analog_values = analog;
              layout.first_frame = claim.first;
              layout.frame_count =
                  claim.count == up_to_the_end ? whole_frames(layout) : claim.count;
            }
    return all;
  }

  void choose() {
    const std::vector<C3dLayout> all = readings();
    const auto worse = [&](const C3dLayout& a, const C3dLayout& b) { return rank(a) < rank(b); };
    layout_ = *std::max_element(all.begin(), all.end(), worse);
    note_choices(all[0]);
    if (rank(layout_) == 0) cut_to_file();
  }

  // Returns the number of whole frames that the file can hold.
  std::size_t whole_frames(const C3dLayout& layout) const {
    const std::size_t room = source_.bytes.size() - layout.data_begin;
    return layout.frame_bytes() == 0 ? 0 : room / layout.frame_bytes();
  }

  void cut_to_file() {
    const std::size_t whole = whole_frames(layout_);
    note("frames_missing", 5,
         fmt::format("the file states {} frames but holds {}", layout_.frame_count, whole));
    layout_.frame_count = whole;
  }

  void note_choices(const C3dLayout& first) const {
    if (layout_.data_begin != first.data_begin || begins_.size() > 1) {
      note(
          "data_start_mismatch", 9,
          fmt::format(
              "POINT:DATA_START differs from block {} of the header: the data is read from byte {}",
              header_.data_block, layout_.data_begin));
    }
    if (points_.size() > 1) {
      note("point_count_mismatch", 2,
           fmt::format("the header states {} points, POINT:USED {}: {} are read",
                       header_.point_count, points_[0], layout_.point_count));
    }
    if (floats_.size() > 1) {
      note("number_format_mismatch", 7,
           fmt::format("the signs of the scale in the header and of POINT:SCALE differ; the file "
                       "has the length "
                       "of {}",
                       layout_.is_float ? "reals" : "integers"));
    }
    if (layout_.analog_values != header_.analog_values) {
      note("analog_count_mismatch", 3,
           fmt::format("the header states {} analog values per frame, but there are {}",
                       header_.analog_values, layout_.analog_values));
    }
    if (layout_.frame_count != first.frame_count) {
      note("frame_count_mismatch", 5,
           fmt::format(
               "the file states {} frames in one place and other numbers elsewhere: {} are read",
               first.frame_count, layout_.frame_count));
    }
  }

  const C3dSource& source_;
  const C3dHeader& header_;
  const C3dParameters& parameters_;
  C3dLayout layout_;
  std::vector<bool> floats_;
  std::vector<std::size_t> begins_;
  std::vector<std::size_t> points_;
  std::vector<std::size_t> analog_;
  std::vector<FrameClaim> frames_;
};

}  // namespace

C3dLayout find_c3d_layout(const C3dSource& source, const C3dHeader& header,
                          const C3dParameters& parameters) {
  return LayoutFinder(source, header, parameters).find();
}

}  // namespace kinemend
