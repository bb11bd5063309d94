// Sends a take frame by frame through every method that works live, and writes the result.
//
//   stream_take TAKE FOLDER
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/io.hpp"
#include "kinemend/live.hpp"
#include "kinemend/methods.hpp"

namespace {

using namespace kinemend;

void set_frame(Take& clip, std::size_t f, const Frame& frame) {
  if (!clip.has_joints()) {
    for (std::size_t m = 0; m < clip.marker_count(); ++m) clip.position(f, m) = frame.positions[m];
    return;
  }
  const std::size_t joints = clip.joint_count();
  for (std::size_t j = 0; j < joints; ++j) clip.rotation(f, j) = frame.rotations[j];
  for (std::size_t i = 0; i < frame.positions.size(); ++i)
    set_track(clip, joints + i, std::span(frame.positions).subspan(i, 1), f);
}

std::unique_ptr<Stream> stream_of(const Cleaner& cleaner, const Take& take) {
  return take.has_joints() ? make_stream(cleaner, take)
                           : make_stream(cleaner, take, body_height(take));
}

// Returns nothing for a method that needs the whole take.
std::optional<Take> streamed(const Take& take, const Method& method, const OptionValues& options) {
  try {
    const auto cleaner = make_cleaner(method.name, options);
    const auto stream = stream_of(*cleaner, take);
    const TakeView view = view_of(take);
    Take result = take;
    std::size_t next = 0;
    Frame out;
    for (std::size_t f = 0; f < take.frame_count(); ++f) {
      if (stream->push(frame_of(view, f), out)) set_frame(result, next++, out);
    }
    while (stream->flush(out)) set_frame(result, next++, out);
    return result;
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::usage) return std::nullopt;
    throw;
  }
}

void stream_all(const Take& take, const std::filesystem::path& folder) {
  const std::vector<std::pair<std::string, OptionValues>> ways{
      {"", {}}, {".causal", {{"causal", true}}}, {".filter", {{"smoother", false}}}};
  for (const Method& method : methods()) {
    for (const auto& [name, options] : ways) {
      const auto result = streamed(take, method, options);
      if (!result) continue;
      const std::string format = take.source.format.empty() ? "bvh" : take.source.format;
      write_file(folder / (method.name + name + "." + format), write_take(*result, format), true);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: stream_take TAKE FOLDER\n");
    return 2;
  }
  try {
    const TakeResult read = read_take(std::filesystem::path(argv[1]));
    std::filesystem::create_directories(argv[2]);
    stream_all(read.take, argv[2]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "stream_take: {}\n", error.what());
    return 3;
  }
  return 0;
}
