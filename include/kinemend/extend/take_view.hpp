// Presents takes of joints and takes of markers in the same form: a set of tracks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend {

/// The space of a track's samples: SO(3), unit quaternions; or R^3, file units.
enum class Space : std::uint8_t { rotation, position };

/// How samples that were not measured are treated.
enum class GapTreatment : std::uint8_t {
  /// Joints: every frame needs a value, so gaps of any length are bridged (rotations along the
  /// geodesic, positions along the line, at the ends by the nearest sample).
  bridge,
  /// Markers: gaps up to 0.25 s are bridged while a track is filtered, longer gaps separate the
  /// track into parts that are filtered alone, and missing samples stay missing.
  cut,
};

/// Known noise, which `auto` and the learned methods use instead of measuring it.
struct TakeNoise {
  std::optional<double> correlation;  ///< from one measurement to the next, 0 to 0.99; 0: white
  /// J or M, per axis: degrees for joints, file units for markers; 0: measured. Empty: all are
  /// measured.
  std::vector<double> strengths;
};

/// The tracks that may change: rotations of joints or positions of markers, and positions of
/// joints.
struct Selection {
  std::vector<std::uint8_t> owners{};  ///< J or M, 1 if it may change; empty: all
  bool root_position = true;           ///< position of joint 0
  bool translations = true;            ///< positions of translated joints that are selected
  /// Height of the person, file units, the scale for markers; 0: estimated.
  double body_height = 0;
  TakeNoise noise{};
  Source source = Source::unknown;  ///< the system that recorded the take

  bool includes(std::size_t owner) const { return owners.empty() || owners[owner] != 0; }
};

/// The samples of one joint's rotation, one joint's position or one marker over all frames.
struct Track {
  Space space = Space::position;
  std::int32_t owner = -1;  ///< joint or marker; -1: the root position
  std::size_t frames = 0;
  const Quat* rotations = nullptr;  ///< for `Space::rotation`: frame f is at [f * stride]
  const Vec3* positions = nullptr;  ///< for `Space::position`
  std::size_t stride = 1;
  const std::uint8_t* observed = nullptr;  ///< frame f is at [f * observed_stride]; null: all
  std::size_t observed_stride = 1;
  /// The distance that is equivalent to one radian: 1 for rotations; the mean bone length for
  /// joints' positions; a quarter of the body height for markers, which is about the length of a
  /// limb segment.
  double radian = 1;
  double noise = 0;  ///< known noise per axis: degrees or file units; 0: not known
  bool selected = true;

  Quat rotation(std::size_t frame) const { return rotations[frame * stride]; }
  Vec3 position(std::size_t frame) const { return positions[frame * stride]; }
  bool is_observed(std::size_t frame) const {
    return observed == nullptr || observed[frame * observed_stride] != 0;
  }
};

/// A take as its tracks, which refer to a clip that outlives the view. Joints: J rotations, the
/// root position, then the positions of the translated joints. Markers: M positions.
struct TakeView {
  const Take* joints = nullptr;   ///< the clip of a take of joints, else null
  const Take* markers = nullptr;  ///< the clip of a take of markers, else null
  std::vector<Track> tracks;
  std::size_t owners = 0;  ///< J or M: track n < owners belongs to joint or marker n
  std::size_t frames = 0;
  double frame_rate_hz = 0;
  GapTreatment gaps = GapTreatment::bridge;
  /// The scale of distances in file units; for joints it comes from the skeleton.
  double body_height = 1;
  std::optional<double> noise_correlation;  ///< `TakeNoise::correlation`
  Source source = Source::unknown;          ///< `Selection::source`

  /// Index of the track of the root position; joints only.
  std::size_t root_track() const noexcept { return owners; }
};

/// Makes the view of a take. Markers that are not positions are never selected.
TakeView view_of(const Take& take, const Selection& selection = {});

/// Returns `Track::radian` of the positions of a take, which is the same for all of them.
double radian_of_positions(const TakeView& take);

/// Whether a track of rotations has two samples that differ, observed or not; always true for
/// positions.
bool moves(const Track& track);
/// Returns, in order, the selected tracks that have an observed sample and, for rotations, two
/// samples that differ.
std::vector<std::size_t> changeable_tracks(const TakeView& take);

/// Returns the samples of a track unchanged; empty for a track of the other space.
std::vector<Quat> rotations_of(const Track& track);
std::vector<Vec3> positions_of(const Track& track);
/// Returns one mark per frame; empty if all were observed.
std::vector<std::uint8_t> observed_of(const Track& track);

/// Writes samples to track `track` of the clip that a view refers to, from frame `first` on.
void set_track(Take& take, std::size_t track, std::span<const Quat> samples, std::size_t first = 0);
void set_track(Take& take, std::size_t track, std::span<const Vec3> samples, std::size_t first = 0);

/// Mean length of the bones (offsets that are not zero), file units; 1 without bones. It puts
/// positions and rotations on one scale: a turn of one radian moves a bone's end by about this.
double typical_bone_length(const Skeleton& skeleton);

}  // namespace kinemend
