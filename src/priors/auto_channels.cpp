#include "priors/auto_channels.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "kinemend/experimental/representation.hpp"
#include "kinemend/rotation.hpp"
#include "tracks/smooth_chart.hpp"
#include "tracks/spikes.hpp"
#include "tracks/track_cleaning.hpp"
#include "tracks/vector_tracks.hpp"

namespace kinemend {

namespace {

Vec3 vector_at(const PoseMatrix& poses, std::size_t frame, std::size_t track) {
  const double* v = poses.row(frame).data() + 3 * track;
  return {v[0], v[1], v[2]};
}

void set_vector(PoseMatrix& poses, std::size_t frame, std::size_t track, Vec3 v) {
  double* to = poses.row(frame).data() + 3 * track;
  to[0] = v.x, to[1] = v.y, to[2] = v.z;
}

// Tracks of one kind, as `auto` takes them together.
class Together {
 public:
  Together(const PoseMatrix& poses, const std::vector<std::uint8_t>& observed, std::size_t first,
           std::size_t count)
      : poses_(poses),
        first_(first),
        tracks_(poses.frames, count),
        suspects_(poses.frames, count),
        gaps_(poses.frames, count) {
    const std::size_t width = poses.channels / 3;
    for (std::size_t n = 0; n < count && !observed.empty(); ++n) {
      for (std::size_t f = 0; f < poses.frames; ++f)
        gaps_(f, n) = observed[f * width + first + n] == 0 ? 1 : 0;
    }
  }

  void add_turns(double rate_hz) {
    for (std::size_t n = 0; n < tracks_.tracks(); ++n) {
      std::vector<Quat> turns, steady;
      for (std::size_t f = 0; f < poses_.frames; ++f)
        turns.push_back(exp(radians_per_degree * vector_at(poses_, f, first_ + n)));
      steady = turns;
      const std::vector<std::uint8_t> gross = replace_gross_spikes(steady);
      charts_.push_back(smooth_chart(steady, rate_hz));
      for (std::size_t f = 0; f < poses_.frames; ++f) {
        tracks_.set(f, n, degrees_per_radian * charts_[n].vector_of(f, turns[f]));
        suspects_(f, n) = gross[f];
      }
    }
  }

  void add_positions() {
    for (std::size_t n = 0; n < tracks_.tracks(); ++n) {
      for (std::size_t f = 0; f < poses_.frames; ++f)
        tracks_.set(f, n, vector_at(poses_, f, first_ + n));
    }
  }

  void clean(const std::vector<std::vector<std::size_t>>& nearby, double rate_hz, TrackKind kind,
             AutoChannels& result) {
    const CleanedTracks verdicts =
        clean_tracks(tracks_, suspects_, gaps_, nearby, rate_hz, {1, true, kind, {}});
    for (std::size_t n = 0; n < tracks_.tracks(); ++n) {
      const std::size_t track = first_ + n;
      std::fill_n(result.noise.begin() + static_cast<std::ptrdiff_t>(3 * track), 3,
                  verdicts.noise[n]);
      for (std::size_t f = 0; f < poses_.frames; ++f) {
        const bool is_spike = verdicts.marked(f, n) != 0;
        if (is_spike)
          std::fill_n(&result.suspect[f * poses_.channels + 3 * track], 3, std::uint8_t{1});
        if (is_spike || verdicts.shares[n] != 0) set_vector(result.poses, f, track, value(f, n));
      }
    }
  }

 private:
  Vec3 value(std::size_t frame, std::size_t n) const {
    const Vec3 v = tracks_.at(frame, n);
    if (charts_.empty()) return v;
    const Quat turn = charts_[n].rotation_of(frame, radians_per_degree * v);
    return degrees_per_radian *
           continue_rotation_vector(log(turn),
                                    radians_per_degree * vector_at(poses_, frame, first_ + n));
  }

  const PoseMatrix& poses_;
  std::size_t first_;
  VectorTracks tracks_;
  SampleMarks suspects_, gaps_;
  std::vector<RotationChart> charts_;
};

}  // namespace

AutoChannels auto_of_channels(const BodyLayout& layout, double rate_hz, const PoseMatrix& poses,
                              const std::vector<std::uint8_t>& observed) {
  AutoChannels result{poses, std::vector<std::uint8_t>(poses.values.size(), 0),
                      std::vector<double>(poses.channels, 0)};
  if (poses.frames < fewest_clean_frames) return result;
  const std::size_t joints = layout.track_count(), tracks = poses.channels / 3;
  Together turns(poses, observed, 0, joints);
  turns.add_turns(rate_hz);
  turns.clean(joints_nearby(layout.parents), rate_hz, TrackKind::rotations, result);
  if (tracks == joints) return result;
  Together place(poses, observed, joints, tracks - joints);
  place.add_positions();
  place.clean(std::vector<std::vector<std::size_t>>(tracks - joints), rate_hz, TrackKind::positions,
              result);
  return result;
}

}  // namespace kinemend
