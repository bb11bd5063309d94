// Takes of markerless systems and depth cameras beside markers of the same motion, as channels of
// the network.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "body/representation.hpp"
#include "cleaner/pieces.hpp"
#include "kinemend/extend/rotation.hpp"
#include "kinemend/extend/signal.hpp"
#include "kinemend/take.hpp"
#include "lab/samples/motion_samples.hpp"
#include "methods/learned/motion_channels.hpp"
#include "pair_errors.hpp"

namespace kinemend::papers {

struct SystemPair {
  std::string source, noisy, reference;
};

/// Returns whether tools/train_learned excludes the pair from training.
inline bool is_left_out(const std::string& name) {
  if (name.starts_with("lbmc-")) {
    const std::string system = name.substr(5, name.find('-', 5) - 5);
    return system != "M1" && system != "M2" && system != "M3" && system != "M5" && system != "M7";
  }
  const std::size_t person = name.find("_s");
  return name.starts_with("kinect-") && person != std::string::npos && name[person + 3] > '3';
}

inline std::vector<SystemPair> all_pairs_below(const std::filesystem::path& folder) {
  std::vector<SystemPair> pairs;
  if (!std::filesystem::is_directory(folder)) return pairs;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const std::size_t at = name.find(".noisy.");
    if (at == std::string::npos) continue;
    const std::string reference = name.substr(0, at) + ".reference." + name.substr(at + 7);
    pairs.push_back(
        {name.substr(0, name.find('-')), entry.path().string(), (folder / reference).string()});
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const SystemPair& a, const SystemPair& b) { return a.noisy < b.noisy; });
  return pairs;
}

/// The pairs that no shipped model has learned from.
inline std::vector<SystemPair> pairs_below(const std::filesystem::path& folder) {
  std::vector<SystemPair> pairs = all_pairs_below(folder);
  std::erase_if(pairs, [](const SystemPair& pair) {
    return !is_left_out(std::filesystem::path(pair.noisy).filename().string());
  });
  return pairs;
}

/// Root mean squares over channels whose reference moves; `values` is F x C.
inline PairErrors errors_of(const std::vector<float>& values, const MotionSample& pair) {
  const MotionTake& take = pair.take;
  PoseMatrix error(take.frames, take.channels);
  std::vector<std::uint8_t> moves(take.channels);
  for (std::size_t f = 0; f < take.frames; ++f) {
    for (std::size_t c = 0; c < take.channels; ++c) {
      const std::size_t i = f * take.channels + c;
      error(f, c) = static_cast<double>(values[i] - pair.truth[i]);
      if (pair.truth[i] != 0) moves[c] = 1;
    }
  }
  PoseMatrix fast = error;
  filter_zero_phase(fast, butterworth_lowpass(4, 6, take.frame_rate_hz));
  PairErrors sums;
  double count = 0;
  for (std::size_t f = 1; f + 1 < take.frames; ++f) {
    for (std::size_t c = 0; c < take.channels; ++c) {
      if (moves[c] == 0) continue;
      const double change = (error(f + 1, c) - error(f - 1, c)) * take.frame_rate_hz / 2;
      const double quick = error(f, c) - fast(f, c);
      sums.value += error(f, c) * error(f, c);
      sums.velocity += change * change;
      sums.fast += quick * quick;
      count += 1;
    }
  }
  return {std::sqrt(sums.value / count), std::sqrt(sums.velocity / count),
          std::sqrt(sums.fast / count)};
}

/// F x 3 (J - 1): the rotation vectors of the joints below the root, degrees, continued past half a
/// turn.
inline std::vector<float> channels_of(const MotionTracks& tracks, const Take& clip) {
  if (!clip.has_joints()) return values_in(tracks, view_of(clip));
  const std::size_t joints = clip.joint_count() - 1;
  std::vector<float> values;
  std::vector<Vec3> last(joints);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t j = 0; j < joints; ++j) {
      last[j] = continue_rotation_vector(log(clip.rotation(f, j + 1)), last[j]);
      for (const double radians : {last[j].x, last[j].y, last[j].z})
        values.push_back(static_cast<float>(degrees_per_radian * radians));
    }
  }
  return values;
}

/// Channels that move less are ignored: those of joints, and those of markers in degrees of their
/// body.
constexpr double least_turn_deg = 2, least_move_deg = 0.34;

struct PairInChannels {
  MotionTracks tracks;  ///< tracks of the noisy take
  MotionSample sample;  ///< the noisy take, with the reference as its system shows it
};

inline PairInChannels pair_in_channels(const Take& noisy, const Take& reference, double least_deg) {
  const TakeView view = view_of(noisy);
  PairInChannels pair{motion_tracks_of(view, changeable_tracks(view)), {}};
  MotionSample both{pair.tracks.take, channels_of(pair.tracks, reference)};
  both.take.values = channels_of(pair.tracks, noisy);
  both.take.channels = both.take.values.size() / both.take.frames;
  pair.sample = mapped_pair({"", std::move(both)}, least_deg).sample;
  return pair;
}

inline bool moves(const MotionSample& pair) {
  return std::any_of(pair.truth.begin(), pair.truth.end(), [](float v) { return v != 0; });
}

}  // namespace kinemend::papers
