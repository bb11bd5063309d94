// The bytes are a skeleton and its motion, which begins at `:FULLY-SPECIFIED`; without a possible
// ASF part, a fixed skeleton is used. The take is read, written, changed and written again.
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "io/acclaim/amc.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/io.hpp"
#include "laws.hpp"

namespace {

using namespace kinemend;

// The skeleton of the tests' fixtures, by its degrees of freedom.
const std::string fixed_skeleton =
    ":root order tx rz tz ry ty rx\n:bonedata\n"
    "begin name hip length 2 end begin name thigh length 3 axis 0 0 20 XYZ dof rx ry rz end\n"
    "begin name shin length 3 axis 10 -15 20 ZYX dof rx end\n"
    "begin name foot length 2 axis -90 7 20 YZX dof rx rz end\n"
    "begin name spine length 4 dof rz ry rx end begin name arm length 5 dof rz rx end\n"
    "begin name slider length 1 axis 20 -35 50 YXZ dof ty rx tx tz rz end\n"
    "begin name hand length 1 dof ry rz end begin name neck end\n"
    ":hierarchy begin\nroot hip spine\nhip thigh\nthigh shin\nshin foot\nspine arm slider neck\n"
    "slider hand\nend\n";

// `is_mended` is set if the file was cut off, numbers were joined, or one was not finite.
Take read(const std::string& amc, const std::string& asf, bool* is_mended = nullptr) {
  TakeResult result = read_amc(amc, "fuzz.amc", asf, "fuzz.asf", {});
  if (is_mended != nullptr) {
    *is_mended = false;
    for (const char* kind : {"file_cut", "numbers_joined", "value_not_finite"})
      *is_mended = *is_mended || result.diagnostics.count(kind) > 0;
  }
  Take clip = std::move(result.take);
  clip.validate();
  return clip;
}

bool is_sensible(const Take& clip) {
  const auto sensible = [](Vec3 v) { return norm(v) < 1e6; };
  for (const Vec3 v : clip.positions) {
    if (!sensible(v)) return false;
  }
  for (const Vec3 v : clip.skeleton.offsets) {
    if (!sensible(v)) return false;
  }
  return true;
}

void check_same(const Take& clip, const Take& again) {
  check(clip.frame_count() == again.frame_count());
  check(clip.joint_count() == again.joint_count());
  // A held sample follows a change of the sample before it.
  if (!is_sensible(clip) || !clip.observed.empty()) return;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      if (clip.skeleton.rotation_order(j).count != 3) continue;
      check(angle_between(again.rotation(f, j), clip.rotation(f, j)) < 1e-4);
    }
  }
}

void change(Take& clip, std::uint64_t seed) {
  Random random(seed);
  const double share = random.uniform(), size_rad = std::pow(10.0, random.uniform(-6, 0.5));
  for (Quat& q : clip.rotations) {
    if (!random.chance(share)) continue;
    q = normalized(q * exp({size_rad * random.normal(), size_rad * random.normal(),
                            size_rad * random.normal()}));
  }
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t k = 1; k < clip.point_count(); ++k)
      clip.position(f, k) += {random.normal(), 0, 0.5};
  }
}

// NaN, infinity, a partial last frame, and two numbers without a blank are never written; once they
// are gone, the text does not change.
void check_unchanged(const Take& clip, bool is_mended, const std::string& amc,
                     const std::string& asf) {
  const std::string written = write_take(clip, "amc");
  if (clip.observed.empty() && !is_mended) {
    check(written == amc);
    return;
  }
  const Take finite = read(written, asf);
  check(finite.observed.empty());
  check(write_take(finite, "amc") == written);
}

// Every file written from a readable pair must be readable again.
void check_written(Take clip, bool is_mended, const std::string& amc, const std::string& asf,
                   std::uint64_t seed) {
  check_unchanged(clip, is_mended, amc, asf);
  check(write_take(clip, "asf") == asf);
  const SourceInfo source = clip.source;
  clip.source = {};
  try {
    const Take plain = read(write_take(clip, "amc"), write_take(clip, "asf"));
    check(plain.frame_count() == clip.frame_count());
  } catch (const Error& error) {
    check(error.kind() == ErrorKind::usage);
  }
  clip.source = source;
  change(clip, seed);
  check_same(clip, read(write_take(clip, "amc"), asf));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes = text_of(data, size);
  std::uint64_t seed = 14695981039346656037u;
  for (const char byte : bytes) seed = (seed ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  const std::size_t motion = bytes.find(":FULLY-SPECIFIED");
  const bool both = motion != bytes.npos && bytes.find(":root") < motion;
  const std::string amc = both ? bytes.substr(motion) : bytes;
  const std::string asf = both ? bytes.substr(0, motion) : fixed_skeleton;
  Take clip;
  bool is_mended = false;
  try {
    clip = read(amc, asf, &is_mended);
  } catch (const Error& error) {
    const bool is_of_motion = std::string_view(error.what()).starts_with("fuzz.amc:");
    check_refusal(error, {ErrorKind::unreadable_input}, is_of_motion ? "fuzz.amc:" : "fuzz.asf:");
    return 0;
  }
  check_written(std::move(clip), is_mended, amc, asf, seed);
  return 0;
}
