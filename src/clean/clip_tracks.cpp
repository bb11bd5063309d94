#include "clean/clip_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "kinemend/representation.hpp"
#include "motion/moving_joints.hpp"

namespace kinemend {

namespace {

std::vector<std::size_t> observed_frames(const Clip& clip, std::size_t joint) {
  std::vector<std::size_t> frames;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    if (clip.is_observed(f, joint)) frames.push_back(f);
  }
  return frames;
}

void bridge(Clip& clip, std::size_t joint, std::size_t before, std::size_t after) {
  const Quat a = clip.rotation(before, joint);
  const Vec3 step =
      (1.0 / static_cast<double>(after - before)) * log(conjugate(a) * clip.rotation(after, joint));
  for (std::size_t f = before + 1; f < after; ++f) {
    clip.rotation(f, joint) = normalized(a * exp(static_cast<double>(f - before) * step));
  }
}

// Joints of one encoding that are filtered together: enough to fill vector registers, few enough
// to spread over threads.
struct Block {
  Encoding encoding;
  std::vector<std::size_t> joints;
};

std::vector<Block> make_blocks(const Clip& clip, std::span<const std::size_t> joints,
                               ChannelChoice choice) {
  constexpr std::size_t block_joints = 8;
  std::vector<Encoding> encodings(joints.size(), Encoding::quaternion);
  if (choice == ChannelChoice::suitable) {
    for_each_parallel(joints.size(), joints.size() * clip.frame_count(),
                      [&](std::size_t i) { encodings[i] = suitable_encoding(clip, joints[i]); });
  }
  std::vector<Block> blocks;
  for (const Encoding encoding : {Encoding::quaternion, Encoding::tangent}) {
    std::size_t in_block = block_joints;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      if (encodings[i] != encoding) continue;
      if (in_block == block_joints) blocks.push_back({encoding, {}}), in_block = 0;
      blocks.back().joints.push_back(joints[i]);
      ++in_block;
    }
  }
  return blocks;
}

void filter_positions(Clip& clip, const Selection& selection,
                      const std::function<void(PoseMatrix&)>& filter) {
  const auto tracks = selected_positions(clip, selection);
  if (tracks.empty()) return;
  const std::size_t frames = clip.frame_count();
  PoseMatrix matrix(frames, 3 * tracks.size());
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    for (std::size_t f = 0; f < frames; ++f) {
      const Vec3 p = tracks[i].values[f * tracks[i].stride] - tracks[i].values[0];
      matrix(f, 3 * i) = p.x;
      matrix(f, 3 * i + 1) = p.y;
      matrix(f, 3 * i + 2) = p.z;
    }
  }
  filter(matrix);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const Vec3 origin = tracks[i].values[0];
    for (std::size_t f = 0; f < frames; ++f) {
      const Vec3 p{matrix(f, 3 * i), matrix(f, 3 * i + 1), matrix(f, 3 * i + 2)};
      tracks[i].values[f * tracks[i].stride] = origin + p;
    }
  }
}

}  // namespace

std::vector<std::size_t> selected_joints(const Clip& clip, const Selection& selection) {
  std::vector<std::size_t> joints;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    if (selection.joints[j] && joint_moves(clip, j)) joints.push_back(j);
  }
  return joints;
}

bool translation_selected(const Clip& clip, const Selection& selection, std::size_t index) {
  return selection.translations && selection.joints[clip.translated_joints[index]] != 0;
}

std::vector<PositionTrack> selected_positions(Clip& clip, const Selection& selection) {
  std::vector<PositionTrack> tracks;
  if (clip.frame_count() == 0) return tracks;
  if (selection.root_position) tracks.push_back({clip.root_positions.data(), 1});
  const std::size_t width = clip.translated_joints.size();
  for (std::size_t i = 0; i < width; ++i) {
    if (translation_selected(clip, selection, i)) {
      tracks.push_back({clip.joint_translations.data() + i, width});
    }
  }
  return tracks;
}

bool is_root(const Clip& clip, const PositionTrack& track) {
  return track.values == clip.root_positions.data();
}

ActionTrack position_actions(const Clip& clip, const PositionTrack& track, CleanTrace& trace) {
  std::vector<Action>& actions =
      is_root(clip, track) ? trace.root_actions : trace.translation_actions;
  const std::size_t frames = clip.frame_count();
  if (actions.empty()) actions.assign(frames * track.stride, Action::kept);
  const std::ptrdiff_t at =
      is_root(clip, track) ? 0 : track.values - clip.joint_translations.data();
  return {actions.data() + at, track.stride};
}

std::vector<Quat> joint_track(const Clip& clip, std::size_t joint) {
  std::vector<Quat> track(clip.frame_count());
  for (std::size_t f = 0; f < track.size(); ++f) track[f] = clip.rotation(f, joint);
  return track;
}

void set_joint_track(Clip& clip, std::size_t joint, std::span<const Quat> track) {
  for (std::size_t f = 0; f < track.size(); ++f) clip.rotation(f, joint) = track[f];
}

std::vector<Vec3> position_track(const PositionTrack& track, std::size_t frames) {
  std::vector<Vec3> values(frames);
  for (std::size_t f = 0; f < frames; ++f) values[f] = track.values[f * track.stride];
  return values;
}

void set_position_track(const PositionTrack& track, std::span<const Vec3> values) {
  for (std::size_t f = 0; f < values.size(); ++f) track.values[f * track.stride] = values[f];
}

void mark_gaps(const Clip& clip, std::span<const std::size_t> joints, CleanTrace& trace) {
  if (clip.observed.empty()) return;
  for (const std::size_t joint : joints) {
    const std::vector<std::size_t> seen = observed_frames(clip, joint);
    if (seen.empty() || seen.size() == clip.frame_count()) continue;
    if (trace.actions.empty()) trace.actions.assign(clip.local_rotations.size(), Action::kept);
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      if (!clip.is_observed(f, joint))
        trace.actions[f * clip.joint_count() + joint] = Action::filled;
    }
  }
}

void bridge_gaps(Clip& clip, std::span<const std::size_t> joints, CleanTrace& trace) {
  if (clip.observed.empty()) return;
  mark_gaps(clip, joints, trace);
  for (const std::size_t joint : joints) {
    const std::vector<std::size_t> seen = observed_frames(clip, joint);
    if (seen.empty()) continue;
    for (std::size_t f = 0; f < seen.front(); ++f) {
      clip.rotation(f, joint) = clip.rotation(seen.front(), joint);
    }
    for (std::size_t i = 1; i < seen.size(); ++i) bridge(clip, joint, seen[i - 1], seen[i]);
    for (std::size_t f = seen.back() + 1; f < clip.frame_count(); ++f) {
      clip.rotation(f, joint) = clip.rotation(seen.back(), joint);
    }
  }
}

void hand_over(Clip& clip, Clip cleaned, const JointSink& sink, CleanTrace& trace) {
  clip.root_positions = cleaned.root_positions;  // which tell the number of frames
  clip.joint_translations = std::move(cleaned.joint_translations);
  clip.observed = std::move(cleaned.observed);
  clip.observed_positions = std::move(cleaned.observed_positions);
  const std::size_t joints = clip.joint_count(), frames = clip.frame_count();
  for_each_parallel(joints, clip.local_rotations.size(), [&](std::size_t j) {
    std::vector<Action> actions(trace.actions.empty() ? 0 : frames);
    for (std::size_t f = 0; f < actions.size(); ++f) actions[f] = trace.actions[f * joints + j];
    sink(j, joint_track(cleaned, j), std::move(actions));
  });
  trace.actions.clear();
}

void bridge_positions(Clip& clip) {
  if (clip.observed_positions.empty()) return;
  const std::size_t translated = clip.translated_joints.size(), frames = clip.frame_count();
  for (std::size_t p = 0; p <= translated; ++p) {
    Vec3* values = p == 0 ? clip.root_positions.data() : clip.joint_translations.data() + p - 1;
    const std::size_t stride = p == 0 ? 1 : translated;
    std::vector<std::size_t> seen;
    for (std::size_t f = 0; f < frames; ++f) {
      if (clip.is_position_observed(f, p)) seen.push_back(f);
    }
    if (seen.empty() || seen.size() == frames) continue;
    for (std::size_t f = 0, next = 0; f < frames; ++f) {
      while (next < seen.size() && seen[next] < f) ++next;
      const std::size_t after = seen[std::min(next, seen.size() - 1)];
      const std::size_t before = next == 0 || after == f ? after : seen[next - 1];
      if (after == f) continue;
      const double share =
          after > before ? static_cast<double>(f - before) / static_cast<double>(after - before)
                         : 0;
      const Vec3 start = values[before * stride];
      values[f * stride] = start + share * (values[after * stride] - start);
    }
  }
}

double typical_bone_length(const Skeleton& skeleton) {
  double sum = 0, count = 0;
  for (const Vec3& offset : skeleton.offsets) {
    const double length = norm(offset);
    if (length > 0) sum += length, count += 1;
  }
  for (const EndSite& site : skeleton.end_sites) {
    const double length = norm(site.offset);
    if (length > 0) sum += length, count += 1;
  }
  return count > 0 ? sum / count : 1.0;
}

CleanTrace clean_channels(Clip& clip, const Selection& selection, ChannelChoice choice,
                          const std::function<void(PoseMatrix&)>& filter) {
  CleanTrace trace;
  const std::vector<std::size_t> joints = selected_joints(clip, selection);
  bridge_gaps(clip, joints, trace);
  const std::vector<Block> blocks = make_blocks(clip, joints, choice);
  for_each_parallel(blocks.size() + 1, joints.size() * clip.frame_count(), [&](std::size_t i) {
    if (i == blocks.size()) return filter_positions(clip, selection, filter);
    EncodedClip encoded = encode(clip, blocks[i].encoding, blocks[i].joints, false);
    filter(encoded.poses);
    decode(encoded, clip);
  });
  return trace;
}

}  // namespace kinemend
