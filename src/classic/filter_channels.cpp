// Groups pieces over the same frames into blocks of channels, filters these, and separates them
// again. Compares a cutoff with half the frame rate.
#include "classic/filter_channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "body/representation.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend {

namespace {

// Enough to fill vector registers, few enough to spread over threads. For speed, not swept.
constexpr std::size_t most_in_block = 8;

using ChannelFilter = std::function<void(PoseMatrix&)>;

void filter_block(std::span<Piece<Vec3>> pieces, const ChannelFilter& filter) {
  const std::size_t frames = pieces.front().samples.size();
  PoseMatrix matrix(frames, 3 * pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Vec3 origin = pieces[i].samples.front();
    for (std::size_t f = 0; f < frames; ++f) {
      const Vec3 p = pieces[i].samples[f] - origin;
      double* row = matrix.row(f).data() + 3 * i;
      row[0] = p.x, row[1] = p.y, row[2] = p.z;
    }
  }
  filter(matrix);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Vec3 origin = pieces[i].samples.front();
    for (std::size_t f = 0; f < frames; ++f) {
      const double* row = matrix.row(f).data() + 3 * i;
      pieces[i].samples[f] = origin + Vec3{row[0], row[1], row[2]};
    }
  }
}

void filter_block(std::span<Piece<Quat>> pieces, Encoding encoding, const ChannelFilter& filter) {
  const std::size_t frames = pieces.front().samples.size(), width = channels_of(encoding);
  PoseMatrix matrix(frames, width * pieces.size());
  std::vector<Quat> references(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (encoding == Encoding::tangent)
      references[i] = mean_rotation(pieces[i].samples, pieces[i].observed);
    encode_rotations(pieces[i].samples, encoding, references[i], matrix, width * i);
  }
  filter(matrix);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (std::size_t f = 0; f < frames; ++f)
      pieces[i].samples[f] = decode_rotation(matrix, encoding, references[i], f, width * i);
  }
}

// Tracks that are filtered together; their pieces are loaded when the block is filtered.
struct RotationBlock {
  Encoding encoding = Encoding::quaternion;
  std::vector<std::size_t> tracks;
};

std::vector<RotationBlock> rotation_blocks(const TakeView& take,
                                           const std::vector<std::size_t>& tracks,
                                           ChannelChoice choice) {
  std::vector<Encoding> encodings(tracks.size(), Encoding::quaternion);
  if (choice == ChannelChoice::suitable) {
    for_each_parallel(tracks.size(), tracks.size() * take.frames, [&](std::size_t i) {
      const Piece<Quat> piece = rotation_piece(take, tracks[i]);
      encodings[i] = suitable_encoding(piece.samples, piece.observed);
    });
  }
  std::vector<RotationBlock> blocks;
  for (const Encoding encoding : {Encoding::quaternion, Encoding::tangent}) {
    std::size_t in_block = most_in_block;
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      if (encodings[i] != encoding) continue;
      if (in_block == most_in_block) blocks.push_back({encoding, {}}), in_block = 0;
      blocks.back().tracks.push_back(tracks[i]);
      ++in_block;
    }
  }
  return blocks;
}

// All pieces, sorted so that those over the same frames are adjacent.
std::vector<Piece<Vec3>> pieces_by_span(const TakeView& take,
                                        const std::vector<std::size_t>& tracks) {
  std::vector<Piece<Vec3>> pieces;
  for (const std::size_t track : tracks) {
    std::vector<Piece<Vec3>> own = position_pieces(take, track);
    std::move(own.begin(), own.end(), std::back_inserter(pieces));
  }
  std::stable_sort(pieces.begin(), pieces.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first_frame, a.samples.size()) < std::pair(b.first_frame, b.samples.size());
  });
  return pieces;
}

std::vector<std::span<Piece<Vec3>>> position_blocks(std::vector<Piece<Vec3>>& pieces) {
  std::vector<std::span<Piece<Vec3>>> blocks;
  for (Piece<Vec3>& piece : pieces) {
    const bool joins = !blocks.empty() && blocks.back().size() < most_in_block &&
                       blocks.back().front().first_frame == piece.first_frame &&
                       blocks.back().front().samples.size() == piece.samples.size();
    if (joins) {
      blocks.back() = {blocks.back().data(), blocks.back().size() + 1};
    } else {
      blocks.push_back({&piece, 1});
    }
  }
  return blocks;
}

void hand_over(const TakeView& take, const std::vector<std::size_t>& tracks,
               std::vector<Piece<Vec3>> pieces, const TrackSink& sink) {
  std::stable_sort(pieces.begin(), pieces.end(), [](const auto& a, const auto& b) {
    return std::pair(a.track, a.first_frame) < std::pair(b.track, b.first_frame);
  });
  std::span<Piece<Vec3>> rest(pieces);
  for (const std::size_t track : tracks) {
    const auto end = std::find_if(rest.begin(), rest.end(),
                                  [&](const auto& piece) { return piece.track != track; });
    const auto count = static_cast<std::size_t>(end - rest.begin());
    sink(track, assemble(take, track, rest.first(count)));
    rest = rest.subspan(count);
  }
}

}  // namespace

void filter_channels(const TakeView& take, ChannelChoice choice, const TrackSink& sink,
                     const std::function<void(double)>& tell, const ChannelFilter& filter) {
  std::vector<std::size_t> rotations, positions;
  for (const std::size_t track : changeable_tracks(take))
    (take.tracks[track].space == Space::rotation ? rotations : positions).push_back(track);
  const std::vector<RotationBlock> blocks = rotation_blocks(take, rotations, choice);
  std::vector<Piece<Vec3>> pieces = pieces_by_span(take, positions);
  const std::vector<std::span<Piece<Vec3>>> beside = position_blocks(pieces);
  const std::size_t samples = (rotations.size() + positions.size()) * take.frames;
  ShareProgress progress(tell);
  progress.begin_part(1, blocks.size() + beside.size());
  for_each_parallel(blocks.size() + beside.size(), samples, [&](std::size_t b) {
    if (b >= blocks.size()) {
      filter_block(beside[b - blocks.size()], filter);
    } else {
      std::vector<Piece<Quat>> own;
      for (const std::size_t track : blocks[b].tracks) own.push_back(rotation_piece(take, track));
      filter_block(own, blocks[b].encoding, filter);
      for (Piece<Quat>& piece : own) {
        const std::size_t track = piece.track;
        sink(track, assemble(std::move(piece)));
      }
    }
    progress.step();
  });
  hand_over(take, positions, std::move(pieces), sink);
}

void filter_channels(Piece<Quat>& piece, const ChannelFilter& filter) {
  filter_block({&piece, 1}, Encoding::quaternion, filter);
}

void filter_channels(Piece<Vec3>& piece, const ChannelFilter& filter) {
  filter_block({&piece, 1}, filter);
}

bool is_below_nyquist(double cutoff_hz, double frame_rate_hz) {
  return cutoff_hz < frame_rate_hz / 2;
}

std::string cutoff_warning(std::string_view option, double cutoff_hz, double frame_rate_hz) {
  return fmt::format("{}: {} Hz is not below the Nyquist frequency of {} Hz (half the frame rate)",
                     option, figure(cutoff_hz), figure(frame_rate_hz / 2));
}

}  // namespace kinemend
