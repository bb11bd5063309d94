// Damages and cleans takes, and draws stretches of their feet.
#include "lab/samples/contact_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "base/portable.hpp"
#include "feet/contacts.hpp"
#include "feet/leg_motion.hpp"
#include "kinemend/clean.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/methods.hpp"
#include "motion/take.hpp"

namespace kinemend {

namespace {

using feet::BodyPoints;

// A way to damage a take.
struct Recipe {
  const char* damage;
  const char* kind;  // of `system`
  Source source;     // that the user declares before cleaning
};

constexpr std::array<Recipe, 9> recipes{{{"system", "video", Source::video},
                                         {"system", "inertial", Source::suit},
                                         {"system", "depth", Source::depth},
                                         {"gaussian", "", Source::unknown},
                                         {"system", "video", Source::video},
                                         {"system", "triangulated", Source::unknown},
                                         {"system", "inertial", Source::suit},
                                         {"ar1", "", Source::unknown},
                                         {"system", "depth", Source::depth}}};

void damage(Take& take, const Recipe& recipe, Random& random) {
  OptionValues values;
  const std::string name = recipe.damage;
  if (name == "system") {
    values["kind"] = std::string(recipe.kind);
    values["strength"] = random.uniform(0.5, 1.4);
    if (random.chance(0.3)) values["heading_deg"] = random.uniform(0.0, 15.0);
  } else {
    values["std_deg"] = random.uniform(0.3, 3.0);
  }
  apply_damage(take, name, values, random);
  if (random.chance(0.15)) apply_damage(take, "bias", {}, random);
  if (random.chance(0.1)) apply_damage(take, "outliers", {}, random);
  if (random.chance(0.1)) apply_damage(take, "held", {}, random);
}

Take cleaned(const Take& take, Source source) {
  CleanSettings settings;
  settings.source = source;
  return clean_take(take, *make_learned(), settings).take;
}

struct SolesOf {
  ContactSource::Version version;
  std::optional<feet::Up> up;
  std::vector<std::uint8_t> has;
};

// The up direction is that of the clean take, which damage does not change.
SolesOf soles_of(const Take& take, std::optional<feet::Up> up) {
  SolesOf result;
  feet::LegMotion legs = feet::leg_motion(take, find_legs(take.skeleton));
  if (legs.legs() == 0) return result;
  result.up = up ? up : feet::up_of(legs, std::nullopt);
  if (!result.up) return result;
  feet::set_heels(take, *result.up, legs);
  BodyPoints& soles = result.version.soles;
  soles = feet::sole_points(legs);
  for (std::size_t p = 0; p < soles.points; ++p)
    result.has.push_back(legs.models[p / 2].has[1] ? 1 : 0);
  ContactSettings rules;
  rules.finder = ContactFinder::thresholds;
  result.version.touching = feet::contact_flags(
      feet::find_contacts(feet::find_soles(legs, *result.up, rules), rules).contacts, soles.frames,
      soles.points);
  return result;
}

}  // namespace

std::optional<ContactSource> contact_source(const Take& clip, std::size_t versions, Random random) {
  const Take clean = slice(clip, leading_calibration_frames(clip), clip.frame_count());
  constexpr double shortest_s = 1;
  if (static_cast<double>(clean.frame_count()) < shortest_s * clean.frame_rate_hz) return {};
  SolesOf own = soles_of(clean, std::nullopt);
  if (!own.up || std::count(own.has.begin(), own.has.end(), 1) == 0) return {};
  if (std::count(own.version.touching.begin(), own.version.touching.end(), 1) == 0) return {};
  ContactSource source{clean.frame_rate_hz, own.version.touching, own.has, *own.up, {}};
  source.versions.push_back(std::move(own.version));
  const std::size_t start = random.below(recipes.size());
  for (std::size_t v = 1; v < versions; ++v) {
    const Recipe& recipe = recipes[(start + v) % recipes.size()];
    Take take = clean;
    const double rate =
        random.chance(0.4) ? (random.chance(0.5) ? 30.0 : 60.0) : take.frame_rate_hz;
    if (rate < take.frame_rate_hz) take = resample(take, rate);
    damage(take, recipe, random);
    if (v % 2 == 1) {
      const bool is_declared = random.chance(0.7);
      take = cleaned(take, is_declared ? recipe.source : Source::unknown);
    }
    source.versions.push_back(soles_of(take, source.up).version);
  }
  return source;
}

namespace {

Vec3 between(const BodyPoints& body, std::size_t point, double frame) {
  const auto first = static_cast<std::size_t>(frame);
  const std::size_t next = std::min(first + 1, body.frames - 1);
  const double share = frame - static_cast<double>(first);
  return (1 - share) * body.at(first, point) + share * body.at(next, point);
}

Vec3 centre_between(const BodyPoints& body, double frame) {
  const auto first = static_cast<std::size_t>(frame);
  const std::size_t next = std::min(first + 1, body.frames - 1);
  const double share = frame - static_cast<double>(first);
  return (1 - share) * body.centres[first] + share * body.centres[next];
}

// A slow random path, three waves along each axis, in body heights.
class Drift {
 public:
  Drift(double size, Random& random) {
    for (Wave& wave : waves_) {
      wave.size = size * Vec3{random.normal(), random.normal(), random.normal()};
      wave.frequency_hz = random.uniform(0.05, 1.2);
      wave.phase = random.uniform(0, 2 * std::numbers::pi);
    }
  }
  Vec3 at(double time_s) const {
    Vec3 sum;
    for (const Wave& wave : waves_)
      sum +=
          portable::sin(2 * std::numbers::pi * wave.frequency_hz * time_s + wave.phase) * wave.size;
    return sum;
  }

 private:
  struct Wave {
    Vec3 size;
    double frequency_hz = 0, phase = 0;
  };
  std::array<Wave, 3> waves_;
};

// Takes count by their length up to some seconds, and short ones, which hold runs and jumps, by
// more, so that neither dominate.
const ContactSource& drawn_source(std::span<const ContactSource> sources, Random& random) {
  const auto weight = [](const ContactSource& source) {
    constexpr double least_s = 3, most_s = 20;
    const auto frames = static_cast<double>(source.versions.front().soles.frames);
    return least_s + std::min(most_s, frames / source.frame_rate_hz);
  };
  double left = 0;
  for (const ContactSource& source : sources) left += weight(source);
  left *= random.uniform();
  for (const ContactSource& source : sources) {
    left -= weight(source);
    if (left <= 0) return source;
  }
  return sources.back();
}

// A rate at which the stretch is seen: mostly that of its version.
double seen_rate_hz(double own_hz, Random& random) {
  if (random.chance(0.6)) return own_hz;
  return random.uniform(20, 240);
}

}  // namespace

ContactSample random_contact_sample(std::span<const ContactSource> sources, std::size_t steps,
                                    feet::Lookahead lookahead, Random random) {
  const ContactSource& source = drawn_source(sources, random);
  const ContactSource::Version& drawn = source.versions[random.below(source.versions.size())];
  const BodyPoints& version = drawn.soles;
  const double pace = random.chance(0.5) ? 1 : random.uniform(0.75, 1.35);
  const double own_hz = version.frame_rate_hz * pace;  // of the version's frames, in played time
  const double rate = seen_rate_hz(own_hz, random);
  const double wanted_s = static_cast<double>(steps - 1) / feet::contact_rate_hz;
  const double length_s = static_cast<double>(version.frames - 1) / own_hz;
  const double start_s = length_s > wanted_s ? random.uniform(0, length_s - wanted_s) : 0;
  const double seconds = std::min(wanted_s, length_s);
  const std::size_t frames = 1 + static_cast<std::size_t>(seconds * rate);

  BodyPoints body;
  body.frames = frames;
  body.points = version.points;
  body.frame_rate_hz = rate;
  body.height = version.height * random.uniform(0.88, 1.12);
  const Drift drift(random.chance(0.4) ? 0.02 * version.height * random.uniform() : 0, random);
  const double root_gain = random.chance(0.25) ? random.uniform(-0.08, 0.08) : 0;
  const Vec3 up = source.up.direction();
  Vec3 slope{random.normal(), random.normal(), random.normal()};
  slope = (random.chance(0.2) ? 0.05 : 0) * feet::level_part(slope, source.up);
  const double toe_by = random.uniform(-0.15, 0.1), heel_by = random.uniform(-0.1, 0.15);
  const Vec3 from = centre_between(version, start_s * own_hz);
  std::vector<std::uint8_t> touching;
  for (std::size_t f = 0; f < frames; ++f) {
    const double time_s = static_cast<double>(f) / rate;
    const double frame =
        std::min((start_s + time_s) * own_hz, static_cast<double>(version.frames - 1));
    const Vec3 centre = centre_between(version, frame);
    const Vec3 shift = drift.at(time_s) + root_gain * feet::level_part(centre - from, source.up);
    const auto moved = [&](Vec3 p) { return p + shift + dot(slope, p - from) * up; };
    for (std::size_t p = 0; p < body.points; p += 2) {
      const Vec3 heel = between(version, p, frame), toe = between(version, p + 1, frame);
      body.positions.push_back(moved(heel + heel_by * (toe - heel)));
      body.positions.push_back(moved(toe + toe_by * (toe - heel)));
    }
    body.centres.push_back(moved(centre));
    const auto nearest = static_cast<std::size_t>(std::lround(frame));
    for (std::size_t p = 0; p < body.points; ++p)
      touching.push_back(drawn.touching[nearest * body.points + p]);
  }

  ContactSample sample;
  if (lookahead == feet::Lookahead::none) touching.clear();  // a stream knows no later frames
  sample.steps = feet::contact_steps(body, source.up, lookahead, touching);
  const std::size_t count = sample.steps.count;
  const std::size_t truth_frames = source.stands.size() / body.points;
  for (std::size_t l = 0; l < sample.steps.feet; ++l) {
    for (std::size_t s = 0; s < count; ++s) {
      const double time_s = (start_s + static_cast<double>(s) / feet::contact_rate_hz) * pace;
      const auto frame = std::min(
          truth_frames - 1, static_cast<std::size_t>(std::lround(time_s * source.frame_rate_hz)));
      for (std::size_t part = 0; part < 2; ++part) {
        const std::size_t p = 2 * l + part;
        sample.truth.push_back(source.stands[frame * body.points + p]);
        sample.weight.push_back(source.has[p]);
      }
    }
  }
  return sample;
}

}  // namespace kinemend
