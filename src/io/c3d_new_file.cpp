#include "io/c3d_new_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "io/c3d_analog.hpp"
#include "io/c3d_events.hpp"
#include "io/c3d_new_parameters.hpp"
#include "io/c3d_parameter_writer.hpp"
#include "io/c3d_source_frames.hpp"

namespace kinemend {

namespace {

using Words = C3dWords<C3dProcessor::intel>;

constexpr std::size_t most_in_a_word = 65535;
// Integers made of the file shall not use all of their range.
constexpr double scale_steps = 32000;
constexpr double scale_when_still = 0.01;

class NewFile {
 public:
  NewFile(const MarkerClip& clip, const C3dDocument* source) : clip_(clip), source_(source) {
    if (clip.marker_count() > most_in_a_word) {
      throw Error(ErrorKind::usage,
                  fmt::format("{} markers; C3D files have room for 65,535", clip.marker_count()));
    }
    file_.frame_count = clip.frame_count();
    // A file of analog samples alone has frames, a clip without markers has none.
    if (source != nullptr && clip.marker_count() + source->layout.point_count == 0)
      file_.frame_count = source->layout.frame_count;
    const bool keeps_frames = source != nullptr && frames() == source->layout.frame_count;
    keeps_words_ = keeps_frames && clip.names == source->names;
    // Values that a damaged source does not tell the channels of mean nothing.
    if (keeps_frames && source->layout.analog_count * source->layout.analog_instants() ==
                            source->layout.analog_values) {
      analog_values_ = source->layout.analog_values;
    }
    file_.scale = scale();
    if (analog_values_ > 0) {
      file_.analog_count = source->layout.analog_count;
      file_.analog_instants = source->layout.analog_instants();
    }
  }

  std::string write() {
    C3dParameters parameters = new_c3d_parameters(clip_, source_, file_);
    // Its length does not depend on the number that it holds.
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
    double largest = 0;
    for (std::size_t i = 0; i < clip_.positions.size(); ++i) {
      if (clip_.observed[i] == 0) continue;
      const Vec3 p = clip_.positions[i];
      largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    }
    if (largest > largest_c3d_real)
      throw Error(ErrorKind::usage, fmt::format("{:g} is too large for a C3D file", largest));
    const double least = largest / scale_steps;
    // A source's own scale keeps its residuals exact.
    const double given = source_ == nullptr ? 0 : source_->layout.scale;
    const double chosen = given > 0 && given * 32767 >= largest ? given : least;
    return static_cast<float>(chosen) > 0 ? chosen : scale_when_still;
  }

  std::string header() const {
    std::string block(c3d_block_bytes, '\0');
    const auto place = [&](std::size_t word) { return block.data() + 2 * (word - 1); };
    const auto put = [&](std::size_t word, std::size_t value) {
      Words::put_word(place(word), static_cast<std::uint16_t>(std::min(value, most_in_a_word)));
    };
    const auto first =
        static_cast<std::size_t>(std::clamp<std::int64_t>(clip_.first_frame, 0, 0xFFFFFFFF));
    block[0] = 2;
    block[1] = 0x50;
    put(2, clip_.marker_count());
    put(3, analog_values_);
    put(4, first);
    put(5, first + frames() - (first + frames() > 0 ? 1 : 0));
    put(6, 10);  // longest gap that was interpolated
    Words::put_real(place(7), static_cast<float>(-file_.scale));
    put(9, data_block_);
    put(10, file_.analog_instants);
    Words::put_real(place(11), static_cast<float>(clip_.frame_rate_hz));
    put(c3d_event_key_word, c3d_event_key);
    put_events(block);
    return block;
  }

  // As many as there is room for; the parameters have them all.
  void put_events(std::string& block) const {
    const auto place = [&](std::size_t word) { return block.data() + 2 * (word - 1); };
    const std::size_t count = std::min(clip_.events.size(), c3d_most_header_events);
    Words::put_word(place(c3d_event_count_word), static_cast<std::uint16_t>(count));
    for (std::size_t i = 0; i < count; ++i) {
      const MarkerEvent& event = clip_.events[i];
      Words::put_real(place(c3d_event_times_word) + 4 * i, static_cast<float>(event.time_s));
      place(c3d_event_flags_word)[i] = 1;
      std::string label = event.label.substr(0, 4);
      label.resize(4, ' ');
      label.copy(place(c3d_event_labels_word) + 4 * i, 4);
    }
  }

  void write_frames() {
    const std::size_t points = clip_.marker_count();
    const std::size_t frame_bytes = 4 * (4 * points + analog_values_);
    std::size_t at = out_.size();
    out_.resize(at + frames() * frame_bytes);
    std::optional<C3dSourceFrames> source;
    if (keeps_words_) source.emplace(*source_);
    if (analog_values_ > 0) analog_.emplace(*source_);
    std::size_t block_end = 0;
    for (std::size_t f = 0; f < frames(); ++f, at += frame_bytes) {
      if (source && f == block_end && source->next()) block_end = source->first() + source->count();
      for (std::size_t m = 0; m < points; ++m) {
        const std::int32_t before =
            source ? source->word(f - source->first(), m) : missing_point_word;
        write_sample(out_.data() + at + 16 * m, f * points + m, before);
      }
      if (analog_values_ > 0) write_analog(out_.data() + at + 16 * points, f);
    }
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

  // Values as they were stored; offset and scale stay with the parameters.
  void write_analog(char* place, std::size_t frame) {
    analog_->stored(frame, analog_row_);
    for (const double value : analog_row_) {
      Words::put_real(place, static_cast<float>(value));
      place += 4;
    }
  }

  const MarkerClip& clip_;
  const C3dDocument* source_;
  bool keeps_words_ = false;
  std::size_t analog_values_ = 0;
  std::size_t data_block_ = 0;
  std::optional<C3dAnalogDecoder> analog_;
  std::vector<double> analog_row_;
  C3dNewFile file_;
  std::string out_;
};

}  // namespace

std::string new_c3d(const MarkerClip& clip, const C3dDocument* source) {
  return NewFile(clip, source).write();
}

}  // namespace kinemend
