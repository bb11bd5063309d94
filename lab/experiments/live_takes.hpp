// Takes for experiments with live methods, and takes as a stream delivers them.
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "kinemend/extend/figures.hpp"
#include "kinemend/live.hpp"
#include "page.hpp"

namespace kinemend::papers {

/// Six CMU takes on which no setting was chosen; the quick form uses the first three.
inline std::vector<Take> live_takes(const Arguments& arguments) {
  std::vector<Take> truths;
  for (const auto& [name, motion] :
       std::array<std::pair<const char*, const char*>, 6>{{{"35_01", "walk"},
                                                           {"02_05", "punch"},
                                                           {"09_03", "run"},
                                                           {"05_01", "walk"},
                                                           {"16_21", "walk"},
                                                           {"08_02", "run"}}}) {
    if (arguments.quick && truths.size() == 3) break;
    truths.push_back(load_take(arguments, std::string(name) + ".bvh", {.motion = motion}).clip);
  }
  return truths;
}

inline Take streamed(const Take& clip, const Cleaner& cleaner) {
  const auto stream = make_stream(cleaner, clip);
  const TakeView view = view_of(clip);
  Take result = clip;
  Frame out;
  std::size_t next = 0;
  const auto take = [&] {
    std::copy(out.rotations.begin(), out.rotations.end(), &result.rotation(next++, 0));
  };
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    if (stream->push(frame_of(view, f), out)) take();
  }
  while (stream->flush(out)) take();
  return result;
}

inline double live_delay_ms(const Cleaner& cleaner, const Take& like) {
  return 1000 / like.frame_rate_hz *
         static_cast<double>(make_stream(cleaner, like)->latency_frames());
}

/// The remaining error as a share of that of the damaged take, averaged over takes. `damage`
/// damages a take.
template <class Damage>
double live_error_share(const std::vector<Take>& truths, const Cleaner& cleaner,
                        const Damage& damage) {
  double sum = 0;
  for (const Take& truth : truths) {
    const Take noisy = damage(truth);
    sum += geodesic_rms_deg(truth, streamed(noisy, cleaner)) / geodesic_rms_deg(truth, noisy);
  }
  return sum / static_cast<double>(truths.size());
}

}  // namespace kinemend::papers
