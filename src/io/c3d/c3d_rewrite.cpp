// Replaces the changed samples and the rate, and keeps every other byte.
#include "io/c3d/c3d.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/c3d/c3d_document.hpp"
#include "kinemend/extend/frames.hpp"

namespace kinemend {

namespace {

class C3dRewriter {
 public:
  C3dRewriter(const Take& clip, const C3dDocument& document)
      : clip_(clip), document_(document), source_(document), out_(document.bytes) {}

  std::optional<std::string> rewrite() {
    if (clip_.frame_rate_hz != document_.frame_rate_hz) replace_rate();
    while (source_.next()) {
      if (block_is_same()) continue;
      with_words(document_.processor, [&](auto words) { rewrite_block<decltype(words)>(); });
    }
    if (changed_) {
      with_words(document_.processor, [&](auto words) { mark_zero_gaps<decltype(words)>(); });
    }
    if (!fits_) return std::nullopt;
    return std::move(out_);
  }

 private:
  const C3dLayout& layout() const { return document_.layout; }
  std::size_t clip_sample(std::size_t block_frame) const {
    return (source_.first() + block_frame) * layout().point_count;
  }

  bool block_is_same() const {
    const std::size_t first = clip_sample(0), count = source_.count() * layout().point_count;
    const C3dPoints& before = source_.points();
    const auto same = [&](const auto& now, const auto& then) {
      return std::memcmp(now.data() + first, then.data(), count * sizeof(then[0])) == 0;
    };
    return same(clip_.observed, before.observed) && same(clip_.positions, before.positions) &&
           (clip_.residuals.empty() || same(clip_.residuals, before.residuals));
  }

  template <class Words>
  void rewrite_block() {
    for (std::size_t f = 0; f < source_.count(); ++f) rewrite_frame<Words>(f);
  }

  template <class Words>
  void rewrite_frame(std::size_t f) {
    const std::size_t points = layout().point_count;
    for (std::size_t p = 0; p < points; ++p) {
      const std::size_t now = clip_sample(f) + p, before = f * points + p;
      const bool here = clip_.observed[now] != 0, was_here = source_.points().observed[before] != 0;
      if (!here && !was_here) continue;
      char* const place = out_.data() + source_.frame_begin(f) + 4 * p * layout().value_bytes();
      if (here) {
        write_sample<Words>(place, f, p);
      } else {
        write_missing<Words>(place);
      }
    }
  }

  template <class Words>
  void write_missing(char* place) {
    for (std::size_t i = 0; i < 3; ++i) write_value<Words>(place, i, 0);
    write_value<Words>(place, 3, missing_point_word);
  }

  // Zeros that were recognised as gaps by the samples around them are marked as missing, because
  // these samples may change.
  template <class Words>
  void mark_zero_gaps() {
    for (const ZeroGap& gap : document_.zero_gaps) {
      for (std::size_t f = gap.first; f < gap.last; ++f) {
        if (clip_.is_observed(f, gap.marker)) continue;
        write_missing<Words>(out_.data() + layout().data_begin + f * layout().frame_bytes() +
                             4 * gap.marker * layout().value_bytes());
      }
    }
  }

  template <class Words>
  void write_sample(char* place, std::size_t f, std::size_t p) {
    const std::size_t now = clip_sample(f) + p, before = f * layout().point_count + p;
    const bool was_here = source_.points().observed[before] != 0;
    const Vec3 position = clip_.positions[now], old = source_.points().positions[before];
    const double scale = layout().is_float ? 1 : layout().scale;
    if (!was_here || position.x != old.x) write_value<Words>(place, 0, position.x / scale);
    if (!was_here || position.y != old.y) write_value<Words>(place, 1, position.y / scale);
    if (!was_here || position.z != old.z) write_value<Words>(place, 2, position.z / scale);
    const float old_residual = source_.points().residuals[before];
    const float residual = !clip_.residuals.empty() ? clip_.residuals[now] : old_residual;
    if (was_here && residual == old_residual) return;
    write_value<Words>(place, 3, c3d_point_word(residual, layout().scale, source_.word(f, p)));
  }

  // Writes a value, in steps of the scale if the file holds integers.
  template <class Words>
  void write_value(char* sample, std::size_t index, double value) {
    changed_ = true;
    char* const place = sample + index * layout().value_bytes();
    const double whole = layout().is_float ? value : std::round(value);
    if (!(std::fabs(whole) <= (layout().is_float ? largest_c3d_real : 32767.0))) {
      fits_ = false;
    } else if (layout().is_float) {
      Words::put_real(place, static_cast<float>(value));
    } else {
      Words::put_word(place, static_cast<std::uint16_t>(static_cast<std::int16_t>(whole)));
    }
  }

  void put_real(std::size_t offset, double value) {
    with_words(document_.processor, [&](auto words) {
      words.put_real(out_.data() + offset, static_cast<float>(value));
    });
  }

  // Replaces the rate in all places; the number of analog samples per frame is kept.
  void replace_rate() {
    const double before = document_.frame_rate_hz, now = clip_.frame_rate_hz;
    put_real(layout().header_begin + 20, now);
    const auto replace = [&](std::string_view group, std::string_view name, double per_frame) {
      const C3dParameter* const parameter = document_.parameters.find(group, name);
      if (parameter == nullptr || parameter->type != C3dType::real || parameter->numbers.empty())
        return;
      const double old = parameter->numbers[0];
      // If the reader assumed the rate, the file states no usable rate.
      const bool follows =
          layout().rate_hz > 0 && old > 0 && (group == "ANALOG" || is_usable_frame_rate(old));
      put_real(parameter->data_begin, follows ? old / before * now : per_frame * now);
    };
    replace("POINT", "RATE", 1);
    replace("ANALOG", "RATE", static_cast<double>(layout().analog_instants()));
    replace("TRIAL", "CAMERA_RATE", 1);
  }

  const Take& clip_;
  const C3dDocument& document_;
  C3dSourceFrames source_;
  std::string out_;
  bool fits_ = true;
  bool changed_ = false;
};

}  // namespace

bool same_c3d_events(const std::vector<MarkerEvent>& a, const std::vector<MarkerEvent>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const MarkerEvent& x, const MarkerEvent& y) {
                      return x.label == y.label && x.context == y.context && x.time_s == y.time_s;
                    });
}

bool keeps_c3d_layout(const Take& clip, const C3dDocument& document) {
  const bool same_frames = clip.names.empty() || clip.frame_count() == document.layout.frame_count;
  return same_frames && document.event_times_finite && clip.names == document.names &&
         clip.unit == document.unit && clip.first_frame == document.layout.first_frame &&
         same_c3d_events(clip.events, document.events);
}

std::optional<std::string> rewrite_c3d(const Take& clip, const C3dDocument& document) {
  return C3dRewriter(clip, document).rewrite();
}

}  // namespace kinemend
