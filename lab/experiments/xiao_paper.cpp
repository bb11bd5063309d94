// Learns a dictionary for each part of the body, codes the windows of a take, and averages the
// results.
#include "xiao_paper.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/quantiles.hpp"
#include "lab/training/ksvd.hpp"
#include "lab/training/sparse_body.hpp"
#include "motion/rotation.hpp"

namespace kinemend::papers {

namespace {

// Distance from the middle of the hips to the neck. Poses are scaled to it, so that lengths are
// about centimetres of an adult.
constexpr double trunk_length = 50;
constexpr std::size_t windows_at_once = 256;

PoseMatrix positions_of(const Take& clip) {
  PoseMatrix positions(clip.frame_count(), 3 * clip.marker_count());
  for (std::size_t i = 0; i < clip.positions.size(); ++i) {
    const Vec3 p = clip.positions[i];
    positions.values[3 * i] = p.x;
    positions.values[3 * i + 1] = p.y;
    positions.values[3 * i + 2] = p.z;
  }
  return positions;
}

double trunk_of(const PoseMatrix& positions, const LocalPoints& points) {
  std::vector<double> lengths;
  for (std::size_t f = 0; f < positions.frames; ++f) {
    const auto at = [&](std::int32_t marker) {
      return vector_at(positions, f, static_cast<std::size_t>(marker));
    };
    const Vec3 hips = 0.5 * (at(points.left_hip) + at(points.right_hip));
    lengths.push_back(norm(at(points.neck) - hips));
  }
  return median_of(lengths);
}

void scale_by(double factor, PoseMatrix& positions) {
  for (double& value : positions.values) value *= factor;
}

// The channel within its frame of a window's value.
std::size_t channel_of(const SparsePoselet& poselet, std::size_t value) {
  const std::size_t own = value % poselet.channels();
  return 3 * static_cast<std::size_t>(poselet.points[own / 3]) + own % 3;
}

template <class Number>
void append_window(const PoseMatrix& local, const SparsePoselet& poselet, std::size_t first,
                   std::size_t frames, std::vector<Number>& values) {
  for (std::size_t i = 0; i < frames * poselet.channels(); ++i)
    values.push_back(
        static_cast<Number>(local(first + i / poselet.channels(), channel_of(poselet, i))));
}

// Calls `merge` with the values of each window of one coordinate, and writes what it returns.
template <class Merge>
void run_along(Take& clip, std::size_t frames, const Merge& merge) {
  const std::size_t markers = clip.marker_count(), reach = frames / 2;
  const std::vector<Vec3> given = clip.positions;
  std::vector<double> values;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const std::size_t own = std::min({reach, f, clip.frame_count() - 1 - f}), first = f - own,
                      last = f + own + 1;
    for (std::size_t m = 0; m < markers; ++m) {
      for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
        values.clear();
        for (std::size_t g = first; g < last; ++g) values.push_back(given[g * markers + m].*axis);
        clip.positions[f * markers + m].*axis = merge(values);
      }
    }
  }
}

}  // namespace

Take steady_take(Take clip, std::size_t frames) {
  if (frames < 2) return clip;
  run_along(clip, frames, [](std::vector<double>& values) { return median_of(values); });
  run_along(clip, frames, [](const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  });
  return clip;
}

// Finds the poselets of `sparse`, with the markers' numbers in the clips.
void XiaoPaper::find_parts(const std::vector<Take>& clips) {
  BodyLayoutBuilder builder;
  for (const Take& clip : clips) builder.add(clip);
  const BodyLayout layout = builder.finish();
  const auto to_marker = [&](std::int32_t& point) {
    point = clips.front().find(layout.names[static_cast<std::size_t>(point)]);
  };
  local_ = find_local_points(layout);
  for (std::int32_t* point : {&local_.root, &local_.left_hip, &local_.right_hip, &local_.neck})
    to_marker(*point);
  poselets_ = find_poselets(layout, marker_points(layout), sizes_.whole);
  for (SparsePoselet& poselet : poselets_) std::ranges::for_each(poselet.points, to_marker);
}

XiaoPaper::XiaoPaper(const std::vector<Take>& clips, const XiaoPaperSizes& sizes) : sizes_(sizes) {
  find_parts(clips);
  std::vector<PoseMatrix> poses;
  std::size_t all = 0;
  for (const Take& clip : clips) {
    PoseMatrix local = positions_of(clip);
    scale_by(trunk_length / trunk_of(local, local_), local);
    to_local(local_frames(local, local_), local);
    all += local.frames < sizes.window_frames ? 0 : local.frames - sizes.window_frames + 1;
    poses.push_back(std::move(local));
  }
  const std::size_t step = std::max<std::size_t>(1, all / sizes.windows);
  for (std::size_t p = 0; p < poselets_.size(); ++p) {
    SparsePoselet& poselet = poselets_[p];
    std::vector<float> signals;
    std::size_t number = 0;
    for (const PoseMatrix& local : poses) {
      for (std::size_t first = 0; first + sizes.window_frames <= local.frames; ++first) {
        if (number++ % step == 0)
          append_window(local, poselet, first, sizes.window_frames, signals);
      }
    }
    const sparse::KsvdSettings learning{
        .atoms = sizes.atoms, .iterations = sizes.iterations, .seed = p + 1};
    poselet.dictionary =
        sparse::ksvd(signals, sizes.window_frames * poselet.channels(), learning).dictionary;
  }
}

PoseMatrix XiaoPaper::filter(const PoseMatrix& local, bool is_absolute,
                             const XiaoPaperSettings& settings, std::size_t hop) const {
  const double lambda = is_absolute ? settings.lambda_absolute : settings.lambda_squares;
  PoseMatrix sums(local.frames, local.channels), counts(local.frames, local.channels);
  const std::size_t window = sizes_.window_frames;
  std::vector<std::size_t> starts;
  for (std::size_t first = 0; first + window < local.frames; first += hop) starts.push_back(first);
  starts.push_back(local.frames - window);
  for (const SparsePoselet& poselet : poselets_) {
    const std::size_t rows = window * poselet.channels();
    for (std::size_t first = 0; first < starts.size(); first += windows_at_once) {
      const std::size_t last = std::min(starts.size(), first + windows_at_once);
      std::vector<double> signals;
      for (std::size_t w = first; w < last; ++w)
        append_window(local, poselet, starts[w], window, signals);
      const std::vector<double> lambdas(last - first, lambda);
      const sparse::SparseProblem problem{
          is_absolute ? sparse::Loss::absolute : sparse::Loss::squares, signals, {}, lambdas, {}};
      const std::vector<double> values =
          sparse::descend_sparse(poselet.dictionary, problem, settings.descent).reconstructed;
      for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t frame = starts[first + i / rows] + i % rows / poselet.channels();
        const std::size_t channel = channel_of(poselet, i % rows);
        sums(frame, channel) += values[i];
        counts(frame, channel) += 1;
      }
    }
  }
  for (std::size_t i = 0; i < sums.values.size(); ++i)
    sums.values[i] = counts.values[i] > 0 ? sums.values[i] / counts.values[i] : local.values[i];
  return sums;
}

Take XiaoPaper::filtered(const Take& noisy, const Take& posed, const XiaoPaperSettings& settings,
                         std::size_t hop) const {
  PoseMatrix local = positions_of(noisy), poses = positions_of(posed);
  const double factor = trunk_length / trunk_of(poses, local_);
  scale_by(factor, local);
  scale_by(factor, poses);
  const std::vector<LocalFrame> frames = local_frames(poses, local_);
  to_local(frames, local);
  if (settings.loss != XiaoPaperLoss::squares) local = filter(local, true, settings, hop);
  if (settings.loss != XiaoPaperLoss::absolute) local = filter(local, false, settings, hop);
  from_local(frames, local);
  scale_by(1 / factor, local);
  Take result = noisy;
  for (std::size_t i = 0; i < result.positions.size(); ++i)
    result.positions[i] = {local.values[3 * i], local.values[3 * i + 1], local.values[3 * i + 2]};
  return result;
}

}  // namespace kinemend::papers
