// Writes header, parameters, points and analog samples as Intel floats.
#include "io/c3d/c3d.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "io/c3d/c3d_document.hpp"
#include "io/c3d/c3d_parameters.hpp"

namespace kinemend {

namespace {

using Words = C3dWords<C3dProcessor::intel>;

// Programs that convert the file to integers need a margin of their range. Chosen by hand.
constexpr double scale_steps = 32000;
constexpr double scale_when_still = 0.01;
// The largest value of an integer, with a small tolerance for rounding. By definition of the
// format.
constexpr double most_steps = 32768.01;
// Header word with the longest gap that was interpolated.
constexpr std::size_t interpolated_gap_word = 6;

class NewFile {
 public:
  NewFile(const Take& clip, const C3dOrigin& origin)
      : clip_(clip),
        origin_(origin),
        source_(origin.document),
        carried_(c3d_carried(clip, origin)) {
    if (clip.marker_count() > most_in_a_word) {
      throw Error(ErrorKind::usage,
                  fmt::format("{} markers; C3D files can hold 65,535", clip.marker_count()));
    }
    file_.frame_count = c3d_frame_count(clip, origin);
    file_.scale = scale();
    file_.analog_count = carried_.analog_count;
    file_.analog_instants = carried_.analog_instants;
  }

  std::string write() {
    C3dParameters parameters = new_c3d_parameters(clip_, origin_, file_);
    // The section's length does not depend on the value of DATA_START.
    data_block_ = 2 + c3d_parameter_section(parameters).size() / c3d_block_bytes;
    set_parameter(parameters, "POINT", c3d_integer("DATA_START", static_cast<double>(data_block_)));
    out_ = header() + c3d_parameter_section(parameters);
    write_frames();
    const std::size_t blocks = (out_.size() + c3d_block_bytes - 1) / c3d_block_bytes;
    out_.resize(blocks * c3d_block_bytes);
    return std::move(out_);
  }

 private:
  std::size_t frames() const { return file_.frame_count; }

  double scale() const {
    double largest = 0, farthest = 0;  // largest of all values, and of positions
    for (std::size_t i = 0; i < clip_.positions.size(); ++i) {
      if (clip_.observed[i] == 0) continue;
      const Vec3 p = clip_.positions[i];
      const double most = std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
      largest = std::max(largest, most);
      if (clip_.holds_positions(i % clip_.marker_count())) farthest = std::max(farthest, most);
    }
    if (largest > static_cast<double>(std::numeric_limits<float>::max()))
      throw Error(ErrorKind::usage, fmt::format("{:g} is too large for a C3D file", largest));
    // The source's scale keeps its residuals exact. In a file of reals the scale need not suit
    // integers.
    double chosen = largest / scale_steps;
    if (source_ != nullptr) {
      const double given = source_->layout.scale * origin_.change.length_factor;
      if (source_->layout.is_float || given * most_steps >= farthest) chosen = given;
    }
    const bool usable = static_cast<float>(chosen) > 0 && std::isfinite(static_cast<float>(chosen));
    return usable ? chosen : scale_when_still;
  }

  std::string header() const {
    std::string block(c3d_block_bytes, '\0');
    const auto place = [&](std::size_t word) { return block.data() + c3d_word_offset(word); };
    const auto put = [&](std::size_t word, std::size_t value) {
      Words::put_word(place(word), static_cast<std::uint16_t>(std::min(value, most_in_a_word)));
    };
    const auto first =
        static_cast<std::size_t>(std::clamp<std::int64_t>(clip_.first_frame, 0, 0xFFFFFFFF));
    block[0] = 2;
    block[1] = 0x50;
    put(2, clip_.marker_count());
    put(3, analog_values());
    put(4, first);
    put(5, first + frames() - (first + frames() > 0 ? 1 : 0));
    put(interpolated_gap_word, source_ != nullptr ? source_word(interpolated_gap_word) : 10);
    Words::put_real(place(7), static_cast<float>(-file_.scale));
    put(9, data_block_);
    put(10, file_.analog_instants);
    Words::put_real(place(11), static_cast<float>(clip_.frame_rate_hz));
    put(c3d_event_key_word, c3d_event_key);
    put_events(block);
    return block;
  }

  // Returns the place of a word in the source's header.
  const char* source_place(std::size_t number) const {
    return source_->bytes.data() + source_->layout.header_begin + c3d_word_offset(number);
  }
  std::size_t source_word(std::size_t number) const {
    return with_words(source_->processor,
                      [&](auto words) -> std::size_t { return words.word(source_place(number)); });
  }

  // Writes as many events as the header can hold; the parameters hold all of them.
  void put_events(std::string& block) const {
    const auto place = [&](std::size_t word) { return block.data() + c3d_word_offset(word); };
    const std::size_t count = std::min(clip_.events.size(), c3d_most_header_events);
    Words::put_word(place(c3d_event_count_word), static_cast<std::uint16_t>(count));
    const bool has_flags = source_ != nullptr && clip_.events.size() == source_->events.size() &&
                           source_word(c3d_event_key_word) == c3d_event_key &&
                           source_word(c3d_event_count_word) == count;
    for (std::size_t i = 0; i < count; ++i) {
      const MarkerEvent& event = clip_.events[i];
      Words::put_real(place(c3d_event_times_word) + 4 * i, static_cast<float>(event.time_s));
      place(c3d_event_flags_word)[i] = has_flags ? source_place(c3d_event_flags_word)[i] : 1;
      std::string label = event.label.substr(0, 4);
      label.resize(4, ' ');
      label.copy(place(c3d_event_labels_word) + 4 * i, 4);
    }
  }

  std::size_t analog_values() const { return file_.analog_count * file_.analog_instants; }

  void write_frames() {
    const std::size_t points = clip_.marker_count();
    const std::size_t frame_bytes = 4 * (4 * points + analog_values());
    std::size_t at = out_.size();
    out_.resize(at + frames() * frame_bytes);
    if (carried_.keeps_words && points > 0) words_.emplace(*source_);
    if (file_.analog_count > 0) analog_.emplace(*source_);
    for (std::size_t f = 0; f < frames(); ++f, at += frame_bytes) {
      for (std::size_t m = 0; m < points; ++m)
        write_sample(out_.data() + at + 16 * m, f * points + m, word_before(f, m));
      if (analog_) write_analog(out_.data() + at + 16 * points, f);
    }
  }

  // Returns the fourth word of a sample in the source. Frames must be requested in order.
  std::int32_t word_before(std::size_t frame, std::size_t marker) {
    if (!words_) return missing_point_word;
    const std::size_t from = carried_.source_frame(frame, source_->layout.frame_count);
    while (from >= words_->first() + words_->count() && words_->next()) {
    }
    return words_->word(from - words_->first(), marker);
  }

  void write_sample(char* place, std::size_t sample, std::int32_t before) const {
    if (clip_.observed[sample] == 0) {
      Words::put_real(place + 12, static_cast<float>(missing_point_word));
      return;
    }
    const Vec3 p = clip_.positions[sample];
    Words::put_real(place, static_cast<float>(p.x));
    Words::put_real(place + 4, static_cast<float>(p.y));
    Words::put_real(place + 8, static_cast<float>(p.z));
    const bool known = !clip_.residuals.empty();
    const std::int32_t word = known ? c3d_point_word(clip_.residuals[sample], file_.scale, before)
                              : before >= 0 ? before
                                            : 0;
    Words::put_real(place + 12, static_cast<float>(word));
  }

  // Writes values as stored; offset and scale stay in the parameters. The values continue evenly
  // across frames, even if the source has a different number per frame.
  void write_analog(char* place, std::size_t frame) {
    const std::size_t instants = source_->layout.analog_instants();
    const std::size_t last = source_->layout.frame_count * instants - 1;
    for (std::size_t i = 0; i < file_.analog_instants; ++i) {
      const std::size_t instant = std::min(frame * file_.analog_instants + i, last);
      if (const std::size_t from = instant / instants; from != analog_frame_) {
        analog_->stored(from, analog_row_);
        analog_frame_ = from;
      }
      for (std::size_t c = 0; c < file_.analog_count; ++c, place += 4) {
        const double value = analog_row_[instant % instants * file_.analog_count + c];
        Words::put_real(place, static_cast<float>(value));
      }
    }
  }

  const Take& clip_;
  const C3dOrigin& origin_;
  const C3dDocument* source_;
  C3dCarried carried_;
  std::size_t data_block_ = 0;
  std::optional<C3dSourceFrames> words_;
  std::optional<C3dAnalogDecoder> analog_;
  std::vector<double> analog_row_;
  std::size_t analog_frame_ = std::numeric_limits<std::size_t>::max();  // the frame of the row
  C3dNewFile file_;
  std::string out_;
};

}  // namespace

std::string new_c3d(const Take& clip, const C3dOrigin& origin) {
  return NewFile(clip, origin).write();
}

}  // namespace kinemend
