// The bytes are a take, and their hash selects changes. A written file must read back as the
// written clip, in place or as a new file. Unchanged samples must keep their value: exactly, unless
// reals replace integers.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "kinemend/error.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/io.hpp"
#include "laws.hpp"

namespace {

using namespace kinemend;

Take read(const std::string& bytes) {
  ReadOptions options;
  options.format = "c3d";
  return read_take(bytes, "fuzz.c3d", options).take;
}

// Positions small enough for a real to hold the added changes, and without zeros that a reader
// could take for missing.
bool is_sensible(const Take& clip) {
  for (std::size_t i = 0; i < clip.positions.size(); ++i) {
    const double size = norm(clip.positions[i]);
    if (clip.observed[i] != 0 && !(size > 1e-3 && size < 1e4)) return false;
  }
  return true;
}

// The step between positions that a file can represent; 0 for reals.
double step_of(const Take& clip) {
  const std::string& encoding = clip.source.facts.at(0).text;
  const std::size_t at = encoding.find("steps of ");
  return at == encoding.npos ? 0 : std::strtod(encoding.c_str() + at + 9, nullptr);
}

void change(Take& clip, Random& random) {
  const double share = random.uniform();
  for (std::size_t i = 0; i < clip.positions.size(); ++i) {
    if (!random.chance(share)) continue;
    clip.observed[i] = random.chance(0.8) ? 1 : 0;
    clip.residuals[i] = clip.observed[i] != 0 ? 0.0f : -1.0f;
    clip.positions[i] = {random.uniform(50, 100), random.uniform(-100, 100), random.normal()};
  }
}

// `source`, unless null, holds values that the clip must keep where it is equal; positions are
// `step` apart.
void check_round_trip(const Take& clip, const Take* source, double step) {
  const Take again = read(write_take(clip, "c3d"));
  again.validate();
  check(again.frame_count() == clip.frame_count());
  check(again.marker_count() == clip.marker_count());
  for (std::size_t i = 0; i < clip.positions.size(); ++i) {
    check(again.observed[i] == clip.observed[i]);
    if (clip.observed[i] == 0) continue;
    const Vec3 now = clip.positions[i];
    const bool kept = source != nullptr && source->observed[i] != 0 && now == source->positions[i];
    // A new file holds reals, which may not represent the steps of an integer file exactly.
    const double rounding = step_of(again) == step ? 0 : 1e-7 * norm(now);
    check(norm(again.positions[i] - now) <= (kept ? rounding : step + 1e-3));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes = text_of(data, size);
  std::uint64_t seed = 14695981039346656037u;
  for (const char byte : bytes) seed = (seed ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  Take clip;
  try {
    clip = read(bytes);
  } catch (const Error&) {
    return 0;
  }
  const double step = step_of(clip);
  if (step > 10 || !is_sensible(clip)) return 0;
  const Take source = clip;
  Random random(seed);
  change(clip, random);
  try {
    check_round_trip(clip, &source, step);
    if (random.chance(0.5)) clip.source.document.reset();
    clip.first_frame = 3;
    clip.events.push_back({"again", "", 2});
    check_round_trip(clip, nullptr, 0);
  } catch (const Error& error) {
    // A new file may not hold all parameters of the old one.
    check(error.kind() == ErrorKind::usage);
  }
  return 0;
}
