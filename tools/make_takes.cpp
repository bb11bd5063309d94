// Makes the takes that ship in examples/takes: a clean one from the gait generator, and the same
// one damaged.
//
//   make_takes examples/takes
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>

#include "kinemend/io.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/synth.hpp"

namespace {

using namespace kinemend;

// The frames of a BVH file with fewer decimals, so that the takes stay small.
std::string with_decimals(std::string_view bvh, int decimals) {
  const std::size_t frame_time = bvh.find("Frame Time:");
  const std::size_t frames = bvh.find('\n', frame_time) + 1;
  std::string result(bvh.substr(0, frames));
  std::string number;
  for (char c : bvh.substr(frames)) {
    if (c != ' ' && c != '\n') {
      number += c;
      continue;
    }
    if (!number.empty()) {
      const std::string text =
          fmt::format("{:.{}f}", std::strtod(number.c_str(), nullptr), decimals);
      result += text.find_first_not_of("-0.") == std::string::npos ? "0" : text;
      number.clear();
      result += c;
    }
  }
  return result;
}

void damage(Take& clip, std::string_view name, const OptionValues& values, Random& random) {
  const DamageReport report = apply_damage(clip, name, values, random);
  fmt::print("{}: {} of {} samples, {:.2f} degrees RMS, {:.1f} at most\n", report.kind,
             report.samples_damaged, report.samples, report.rms_deg, report.max_deg);
}

void write(const std::filesystem::path& path, const Take& clip) {
  const std::string bytes = with_decimals(write_take(clip), 4);
  write_file(path, bytes, true);
  fmt::print("{}: {} frames, {} bytes\n", path.filename().string(), clip.frame_count(),
             bytes.size());
}

void make_takes(const std::filesystem::path& folder) {
  Take clip = synthesize({"stroll", 8, 120, 11, false});
  write(folder / "walk.bvh", clip);
  Random random(2008);
  damage(clip, "gaussian", {{"std_deg", 1.5}}, random);
  damage(clip, "outliers", {{"share", 0.004}, {"std_deg", 25.0}}, random);
  write(folder / "noisy_walk.bvh", clip);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fputs("usage: make_takes FOLDER\n", stderr);
    return 2;
  }
  try {
    make_takes(arguments[1]);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
