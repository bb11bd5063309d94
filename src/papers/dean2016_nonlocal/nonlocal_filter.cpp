// Computes distances of patches block by block, converts them to weights, and averages poses with
// these. Continues tracks beyond their ends.
#include "papers/dean2016_nonlocal/nonlocal_filter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "base/parallel.hpp"
#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "cleaner/orientation_filter.hpp"
#include "motion/rotation.hpp"
#include "papers/dean2016_nonlocal/nonlocal_kernels.hpp"

namespace kinemend {

namespace {

// Index of the sample at i, which may be beyond the ends.
std::size_t source_index(std::ptrdiff_t i, std::size_t frames, NonlocalBoundary boundary) {
  const auto last = static_cast<std::ptrdiff_t>(frames) - 1;
  if (boundary != NonlocalBoundary::mirror || last == 0) {
    return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, last));
  }
  const std::ptrdiff_t phase = ((i % (2 * last)) + 2 * last) % (2 * last);
  return static_cast<std::size_t>(std::min(phase, 2 * last - phase));
}

// The least-squares line through the `count` samples at an end, relative to the end sample.
struct EndLine {
  Vec3 value, slope;
};

template <class Track>
EndLine fit_end(const Track& track, bool front, std::size_t count) {
  const std::size_t end = front ? 0 : track.frames - 1;
  const double n = static_cast<double>(count);
  const double middle = (n - 1) / 2;
  Vec3 sum, moment;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 d = difference(track[end], track[front ? i : end - i]);
    sum += d;
    moment += (static_cast<double>(i) - middle) * d;
  }
  const Vec3 slope = count < 2 ? Vec3{} : (12 / (n * (n * n - 1))) * moment;
  return {(1 / n) * sum - middle * slope, slope};
}

// The track with `pad` samples on either side.
template <class Track>
Track pad_ends(const Track& track, std::size_t pad, const NonlocalSettings& settings) {
  const std::size_t frames = track.frames;
  Track padded(frames + 2 * pad);
  for (std::size_t i = 0; i < padded.frames; ++i) {
    const auto from = static_cast<std::ptrdiff_t>(i) - static_cast<std::ptrdiff_t>(pad);
    padded.set(i, track[source_index(from, frames, settings.boundary)]);
  }
  if (settings.boundary != NonlocalBoundary::neumann) return padded;
  const std::size_t count = std::min(frames, 2 * settings.patch_radius + 1);
  for (const bool front : {true, false}) {
    const EndLine line = fit_end(track, front, count);
    for (std::size_t i = 1; i <= pad; ++i) {
      const Vec3 by = line.value - static_cast<double>(i) * line.slope;
      padded.set(front ? pad - i : pad + frames - 1 + i, moved(track[front ? 0 : frames - 1], by));
    }
  }
  return padded;
}

std::vector<double> pad_weights(const std::vector<double>& weights, std::size_t frames,
                                std::size_t pad, NonlocalBoundary boundary) {
  if (weights.empty()) return {};
  std::vector<double> padded(frames + 2 * pad + lane_room);
  for (std::size_t i = 0; i < frames + 2 * pad; ++i) {
    const auto from = static_cast<std::ptrdiff_t>(i) - static_cast<std::ptrdiff_t>(pad);
    padded[i] = weights[source_index(from, frames, boundary)];
  }
  return padded;
}

constexpr double infinite = std::numeric_limits<double>::infinity();

// A take with its ends extended, and the filter on one block of frames.
class Averager {
 public:
  Averager(const NonlocalTake& take, const NonlocalSettings& settings)
      : settings_(settings),
        frames_(take.frames()),
        pad_(std::max(settings.patch_radius + (settings.whole_take ? 0 : settings.window_radius),
                      lane_room)) {
    for (const auto& track : take.rotations) {
      rotations_.push_back(pad_ends(track, pad_, settings));
    }
    for (const auto& track : take.positions) {
      positions_.push_back(pad_ends(track, pad_, settings));
    }
    for (const auto& track : take.points) points_.push_back(pad_ends(track, pad_, settings));
    for (const auto& weights : take.points_observed) {
      points_observed_.push_back(pad_weights(weights, frames_, pad_, settings.boundary));
    }
    for (const auto& weights : take.observed) {
      observed_.push_back(pad_weights(weights, frames_, pad_, settings.boundary));
      gaps_ = gaps_ || !weights.empty();
    }
  }

  std::size_t frames() const { return frames_; }
  // Frames of a block, whose distances to all neighbours fit the cache.
  std::size_t block_frames() const {
    if (!settings_.whole_take) return 256;
    return std::clamp<std::size_t>((std::size_t{1} << 20) / frames_, 16, 256);
  }

  struct Moves {
    std::vector<VectorTrack> turns;  ///< one per rotation track; empty if not wanted
    std::vector<VectorTrack> shifts;
    std::vector<VectorTrack> point_moves;
  };

  // Adds to `risks`, one for each bandwidth, Mallows' C_p of the block's frames.
  void add_risks(std::size_t first, std::size_t count, double variance,
                 const std::vector<double>& bandwidths, std::vector<double>& risks) const {
    const Weights distances = find_distances(first, count);
    for (std::size_t n = 0; n < bandwidths.size(); ++n) {
      Weights weights = distances;
      weigh(count, bandwidths[n], weights);
      double changed = 0, samples = 0;
      const std::vector<VectorTrack> travels = body_travels(first, count, weights.neighbours);
      for (std::size_t p = 0; p < points_.size(); ++p) {
        if (!points_observed_[p].empty()) continue;
        VectorTrack moves(count);
        mean_point_move(points_[p], nullptr, first + pad_, count, weights.neighbours, travels,
                        moves);
        for (std::size_t i = 0; i < count; ++i) changed += dot(moves[i], moves[i]);
        samples += 1;
      }
      for (std::size_t j = 0; j < rotations_.size(); ++j) {
        if (!observed_[j].empty()) continue;
        VectorTrack turns(count);
        mean_turn(rotations_[j], nullptr, first + pad_, count, weights.neighbours, turns);
        for (std::size_t i = 0; i < count; ++i) changed += dot(turns[i], turns[i]);
        samples += 1;
      }
      double own = 0;
      const std::size_t stride = count + lane_room;
      for (std::size_t i = 0; i < count; ++i) {
        double total = 1;
        for (std::size_t k = 0; k < weights.neighbours.size(); ++k) {
          total += weights.values[k * stride + i];
        }
        own += 1 / total;
      }
      risks[n] += changed + 2 * variance * 3 * samples * own;
    }
  }

  // The turns and moves of frames first .. first + count - 1.
  Moves run(std::size_t first, std::size_t count, const std::vector<std::uint8_t>& wanted,
            const std::vector<std::uint8_t>& travels) const {
    Weights weights = find_distances(first, count);
    weigh(count, settings_.bandwidth, weights);
    Moves moves;
    for (std::size_t j = 0; j < rotations_.size(); ++j) {
      moves.turns.emplace_back(wanted[j] ? count : 0);
      if (!wanted[j]) continue;
      mean_turn(rotations_[j], observed_[j].empty() ? nullptr : observed_[j].data(), first + pad_,
                count, weights.neighbours, moves.turns.back());
    }
    std::vector<Neighbour> near;
    for (const Neighbour& n : weights.neighbours) {
      if (static_cast<std::size_t>(std::abs(n.offset)) <= settings_.travel_radius)
        near.push_back(n);
    }
    for (std::size_t p = 0; p < positions_.size(); ++p) {
      moves.shifts.emplace_back(count);
      if (travels[p] != 0) {
        travel_move(positions_[p], first + pad_, count, near, moves.shifts.back());
      } else {
        mean_move(positions_[p], first + pad_, count, weights.neighbours, moves.shifts.back());
      }
    }
    add_point_moves_of(first, count, weights.neighbours, near, moves);
    return moves;
  }

 private:
  // One row per neighbour, `lane_room` longer than the block.
  struct Weights {
    std::vector<double> values;
    std::vector<Neighbour> neighbours;

    Weights() = default;
    Weights(Weights&&) = default;
    // The neighbours point to the weights of the copy.
    Weights(const Weights& other) : values(other.values), neighbours(other.neighbours) {
      for (Neighbour& n : neighbours)
        n.weights = &values[static_cast<std::size_t>(n.weights - other.values.data())];
    }
    Weights& operator=(const Weights&) = delete;
    Weights& operator=(Weights&&) = default;
    ~Weights() = default;
  };

  // The value of the weighted line through a body's moves: poses before and after a frame have
  // different total weights, so that their mean would lag or lead while the body travels.
  class LineOfMoves {
   public:
    void add(double weight, std::ptrdiff_t offset, Vec3 move) {
      const auto o = static_cast<double>(offset);
      weights_ += weight;
      offsets_ += weight * o;
      squares_ += weight * o * o;
      moves_ += weight * move;
      products_ += weight * o * move;
    }
    Vec3 at_own_frame() const {
      const Vec3 mean = (1 / weights_) * moves_;
      const double spread = squares_ - offsets_ * offsets_ / weights_;
      if (!(spread > least_spread * weights_)) return mean;
      const Vec3 speed = (1 / spread) * (products_ - offsets_ * mean);
      return mean - (offsets_ / weights_) * speed;
    }

   private:
    // Chosen by hand, not swept.
    static constexpr double least_spread = 0.5;  // square frames, below which no speed is estimated
    double weights_ = 1, offsets_ = 0, squares_ = 0;
    Vec3 moves_, products_;
  };

  void travel_move(const VectorTrack& track, std::size_t first, std::size_t count,
                   const std::vector<Neighbour>& near, VectorTrack& out) const {
    for (std::size_t i = 0; i < count; ++i) {
      LineOfMoves line;
      for (const Neighbour& n : near) {
        if (n.weights[i] <= 0) continue;
        const auto there = static_cast<std::ptrdiff_t>(first + i) + n.offset;
        line.add(n.weights[i], n.offset, track[static_cast<std::size_t>(there)] - track[first + i]);
      }
      out.set(i, line.at_own_frame());
    }
  }

  const double* point_weights(std::size_t point) const {
    return points_observed_[point].empty() ? nullptr : points_observed_[point].data();
  }

  // Sums over the points between frames `a` + i and `b` + i of the padded take, i < count.
  struct Moved {
    std::vector<double> squares, x, y, z, pairs;

    explicit Moved(std::size_t length)
        : squares(length), x(length), y(length), z(length), pairs(length) {}
  };
  Moved point_sums(std::size_t a, std::size_t b, std::size_t count) const {
    Moved sums(count + lane_room);
    for (std::size_t p = 0; p < points_.size(); ++p) {
      add_point_moves(
          points_[p], point_weights(p), a, b, count,
          {sums.squares.data(), sums.x.data(), sums.y.data(), sums.z.data(), sums.pairs.data()});
    }
    return sums;
  }

  // The move of the centre of the points seen in both frames, from each frame to each neighbour.
  std::vector<VectorTrack> body_travels(std::size_t first, std::size_t count,
                                        const std::vector<Neighbour>& neighbours) const {
    std::vector<VectorTrack> travels;
    if (points_.empty()) return travels;
    for (const Neighbour& n : neighbours) {
      VectorTrack travel(count);
      // A neighbour beyond the take has no weight.
      const auto there = static_cast<std::ptrdiff_t>(first + pad_) + n.offset;
      const auto all = static_cast<std::ptrdiff_t>(frames_ + 2 * pad_);
      const std::size_t begin = there < 0 ? static_cast<std::size_t>(-there) : 0;
      const auto end = std::min(static_cast<std::ptrdiff_t>(count), all - there);
      if (static_cast<std::ptrdiff_t>(begin) < end) {
        const std::size_t part = static_cast<std::size_t>(end) - begin;
        const Moved sums =
            point_sums(first + pad_ + begin,
                       static_cast<std::size_t>(there + static_cast<std::ptrdiff_t>(begin)), part);
        for (std::size_t i = 0; i < part; ++i) {
          const double share = 1 / std::max(sums.pairs[i], 1.0);
          travel.set(begin + i, share * Vec3{sums.x[i], sums.y[i], sums.z[i]});
        }
      }
      travels.push_back(std::move(travel));
    }
    return travels;
  }

  void add_point_moves_of(std::size_t first, std::size_t count,
                          const std::vector<Neighbour>& neighbours,
                          const std::vector<Neighbour>& near, Moves& moves) const {
    if (points_.empty()) return;
    const std::vector<VectorTrack> travels = body_travels(first, count, neighbours);
    VectorTrack centre(count);
    for (std::size_t i = 0; i < count; ++i) {
      LineOfMoves line;
      for (std::size_t n = 0, k = 0; n < neighbours.size() && k < near.size(); ++n) {
        if (neighbours[n].offset != near[k].offset) continue;
        line.add(near[k].weights[i], near[k].offset, travels[n][i]);
        ++k;
      }
      centre.set(i, line.at_own_frame());
    }
    for (std::size_t p = 0; p < points_.size(); ++p) {
      VectorTrack move(count);
      mean_point_move(points_[p], point_weights(p), first + pad_, count, neighbours, travels, move);
      turn(move, centre);
      moves.point_moves.push_back(std::move(move));
    }
  }

  // Mean squared difference per channel of the patches about frames `from` + i and `from` + lag +
  // i, for i < count.
  void patch_distances(std::ptrdiff_t from, std::ptrdiff_t lag, std::size_t count,
                       double* out) const {
    const std::size_t patch = 2 * settings_.patch_radius + 1;
    const std::size_t wide = count + patch - 1;
    std::vector<double> sums(wide + lane_room),
        pairs(gaps_ || !points_.empty() ? wide + lane_room : 0);
    const auto a = static_cast<std::size_t>(from + static_cast<std::ptrdiff_t>(pad_) -
                                            static_cast<std::ptrdiff_t>(settings_.patch_radius));
    const std::size_t b = a + static_cast<std::size_t>(lag);
    double whole = 0;  // joints without gaps
    for (std::size_t j = 0; j < rotations_.size(); ++j) {
      if (observed_[j].empty()) {
        add_squared_angles(rotations_[j], a, b, wide, sums.data());
        whole += 1;
      } else {
        add_observed_angles(rotations_[j], observed_[j].data(), a, b, wide, sums.data(),
                            pairs.data());
      }
    }
    if (!points_.empty()) add_centred_distances(a, b, wide, sums, pairs);
    std::vector<double> counts(count, whole * static_cast<double>(patch));
    std::fill(out, out + count, 0.0);
    for (std::size_t o = 0; o < patch; ++o) {
      for (std::size_t i = 0; i < count; ++i) out[i] += sums[i + o];
      if (pairs.empty()) continue;
      for (std::size_t i = 0; i < count; ++i) counts[i] += pairs[i + o];
    }
    for (std::size_t i = 0; i < count; ++i) {
      out[i] = counts[i] > 0                           ? out[i] / (3 * counts[i])
               : rotations_.empty() && points_.empty() ? 0.0
                                                       : infinite;
    }
  }

  // Uses the points' moves relative to that of their centre.
  void add_centred_distances(std::size_t a, std::size_t b, std::size_t count,
                             std::vector<double>& sums, std::vector<double>& pairs) const {
    const Moved moved = point_sums(a, b, count);
    for (std::size_t i = 0; i < count; ++i) {
      if (moved.pairs[i] < 2) continue;
      const Vec3 sum{moved.x[i], moved.y[i], moved.z[i]};
      sums[i] += std::max(0.0, moved.squares[i] - dot(sum, sum) / moved.pairs[i]);
      pairs[i] += moved.pairs[i] - 1;
    }
  }

  // Distances of the block's frames to each neighbour; infinite for one without weight.
  Weights find_distances(std::size_t first, std::size_t count) const {
    Weights result =
        settings_.whole_take ? whole_take_distances(first, count) : window_distances(first, count);
    if (settings_.neighbours > 0) keep_nearest(count, result);
    return result;
  }

  // Converts distances to weights.
  void weigh(std::size_t count, double bandwidth, Weights& weights) const {
    const std::vector<double> floors = nearest_distances(count, weights);
    const std::size_t stride = count + lane_room;
    for (std::size_t n = 0; n < weights.neighbours.size(); ++n) {
      decay(1 / (2 * bandwidth * bandwidth), floors.data(), count, &weights.values[n * stride]);
      std::fill_n(&weights.values[n * stride + count], lane_room, 0.0);
    }
  }

  void add_neighbours(const std::vector<std::ptrdiff_t>& offsets, std::size_t stride,
                      Weights& weights) const {
    weights.values.assign(offsets.size() * stride, infinite);
    for (std::size_t n = 0; n < offsets.size(); ++n) {
      weights.neighbours.push_back({offsets[n], &weights.values[n * stride]});
    }
  }

  // Each pair is measured once and used in both directions.
  Weights window_distances(std::size_t first, std::size_t count) const {
    const std::size_t stride = count + lane_room;
    std::vector<std::ptrdiff_t> offsets;
    for (std::size_t lag = 1; lag <= settings_.window_radius; ++lag) {
      offsets.push_back(static_cast<std::ptrdiff_t>(lag));
      offsets.push_back(-static_cast<std::ptrdiff_t>(lag));
    }
    Weights result;
    add_neighbours(offsets, stride, result);
    std::vector<double> distances(count + settings_.window_radius);
    for (std::size_t lag = 1; lag <= settings_.window_radius; ++lag) {
      const auto step = static_cast<std::ptrdiff_t>(lag);
      patch_distances(static_cast<std::ptrdiff_t>(first) - step, step, count + lag,
                      distances.data());
      double* row = &result.values[2 * (lag - 1) * stride];
      std::copy_n(distances.begin() + step, count, row);
      std::copy_n(distances.begin(), count, row + stride);
    }
    return result;
  }

  Weights whole_take_distances(std::size_t first, std::size_t count) const {
    const std::size_t stride = count + lane_room;
    const auto begin = static_cast<std::ptrdiff_t>(first);
    const auto end = static_cast<std::ptrdiff_t>(first + count);
    const auto all = static_cast<std::ptrdiff_t>(frames_);
    std::vector<std::ptrdiff_t> offsets;
    for (std::ptrdiff_t lag = 1 - end; lag < all - begin; ++lag) {
      if (lag != 0) offsets.push_back(lag);
    }
    Weights result;
    add_neighbours(offsets, stride, result);
    for (std::size_t n = 0; n < offsets.size(); ++n) {
      const std::ptrdiff_t from = std::max(begin, -offsets[n]);
      const std::ptrdiff_t to = std::min(end, all - offsets[n]);
      if (from < to) {
        patch_distances(from, offsets[n], static_cast<std::size_t>(to - from),
                        &result.values[n * stride + static_cast<std::size_t>(from - begin)]);
      }
    }
    return result;
  }

  // Neighbours beyond the nearest few, ties kept, get an infinite distance.
  void keep_nearest(std::size_t count, Weights& weights) const {
    if (settings_.neighbours >= weights.neighbours.size()) return;
    const std::size_t stride = count + lane_room;
    std::vector<double> column(weights.neighbours.size());
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t n = 0; n < column.size(); ++n) column[n] = weights.values[n * stride + i];
      const double farthest = of_rank(column, settings_.neighbours - 1);
      for (std::size_t n = 0; n < column.size(); ++n) {
        double& value = weights.values[n * stride + i];
        if (value > farthest) value = infinite;
      }
    }
  }

  // The distance of weight 1. Relative to the nearest neighbour, the largest weight of a neighbour
  // is 1, that of the pose itself, as in the paper; a common factor of all weights does not matter.
  std::vector<double> nearest_distances(std::size_t count, const Weights& weights) const {
    const std::size_t stride = count + lane_room;
    if (settings_.noise_distance > 0) {
      return std::vector<double>(stride, settings_.noise_distance);
    }
    std::vector<double> least(stride, infinite);
    for (std::size_t n = 0; n < weights.neighbours.size(); ++n) {
      for (std::size_t i = 0; i < count; ++i) {
        least[i] = std::min(least[i], weights.values[n * stride + i]);
      }
    }
    for (double& value : least) value = value < infinite ? value : 0.0;
    return least;
  }

  NonlocalSettings settings_;
  std::size_t frames_;
  std::size_t pad_;
  bool gaps_ = false;
  std::vector<RotationTrack> rotations_;
  std::vector<std::vector<double>> observed_;
  std::vector<VectorTrack> positions_;
  std::vector<VectorTrack> points_;
  std::vector<std::vector<double>> points_observed_;
};

RotationTrack part_of(const RotationTrack& track, std::size_t first, std::size_t count) {
  RotationTrack part(count);
  for (std::size_t i = 0; i < count; ++i) part.set(i, track[first + i]);
  return part;
}
VectorTrack part_of(const VectorTrack& track, std::size_t first, std::size_t count) {
  VectorTrack part(count);
  for (std::size_t i = 0; i < count; ++i) part.set(i, track[first + i]);
  return part;
}

template <class Track>
void turn_part(Track& track, std::size_t first, const VectorTrack& turns) {
  Track part = part_of(track, first, turns.frames);
  turn(part, turns);
  for (std::size_t i = 0; i < part.frames; ++i) track.set(first + i, part[i]);
}

}  // namespace

std::size_t NonlocalTake::frames() const {
  if (!rotations.empty()) return rotations.front().frames;
  if (!points.empty()) return points.front().frames;
  return positions.empty() ? 0 : positions.front().frames;
}

double best_bandwidth(const NonlocalTake& take, const NonlocalSettings& settings, double variance) {
  // Frames at which risks are estimated: up to 384 over the take, for speed; not swept.
  constexpr std::size_t block = 64, most_blocks = 6;
  std::vector<double> bandwidths, risks;
  for (int step = 0; step < 8; ++step) {
    bandwidths.push_back(0.3 * portable::pow(2.0, 0.5 * step) * std::sqrt(variance));
  }
  risks.assign(bandwidths.size(), 0.0);
  const Averager averager(take, settings);
  const std::size_t frames = averager.frames();
  const std::size_t blocks = std::min(most_blocks, (frames + block - 1) / block);
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t room = frames > block ? frames - block : 0;
    const std::size_t first = blocks < 2 ? 0 : b * room / (blocks - 1);
    averager.add_risks(first, std::min(block, frames - first), variance, bandwidths, risks);
  }
  const auto least = std::min_element(risks.begin(), risks.end());
  return bandwidths[static_cast<std::size_t>(least - risks.begin())];
}

void nonlocal_filter(NonlocalTake& take, const NonlocalSettings& settings) {
  if (take.frames() == 0) return;
  const Averager averager(take, settings);
  const std::size_t frames = averager.frames();
  const std::size_t block = averager.block_frames();
  const std::size_t blocks = (frames + block - 1) / block;
  for_each_parallel(
      blocks, frames * (1 + take.rotations.size() + take.points.size()), [&](std::size_t b) {
        const std::size_t first = b * block;
        const auto moves =
            averager.run(first, std::min(block, frames - first), take.wanted, take.travels);
        for (std::size_t j = 0; j < take.rotations.size(); ++j) {
          if (take.wanted[j]) turn_part(take.rotations[j], first, moves.turns[j]);
        }
        for (std::size_t p = 0; p < take.positions.size(); ++p) {
          turn_part(take.positions[p], first, moves.shifts[p]);
        }
        for (std::size_t p = 0; p < take.points.size(); ++p) {
          turn_part(take.points[p], first, moves.point_moves[p]);
        }
      });
}

}  // namespace kinemend
