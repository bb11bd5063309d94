// Turns the likelihoods of the network into contacts, by the most likely sequence of states of each
// foot over the whole take.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "base/frame_span.hpp"
#include "base/portable.hpp"
#include "feet/contact_network.hpp"
#include "feet/contacts.hpp"

namespace kinemend::feet {

namespace {

// A foot is in the air, or on its heel, its toe, or both: bit p says whether part p stands.
constexpr std::size_t states = 4;
// The cost of a part that comes down or lifts, in nats; and the share of a step's evidence that is
// new, because neighbouring steps see the same motion. Swept on 16 takes that no
// table uses (docs/details/feet.md).
constexpr double change_cost = 0.75, new_share = 0.5;

bool stands(std::size_t state, std::size_t part) { return ((state >> part) & 1) != 0; }

double cost_between(std::size_t from, std::size_t to) {
  double cost = 0;
  for (std::size_t part = 0; part < 2; ++part)
    cost += stands(from, part) != stands(to, part) ? change_cost : 0;
  return cost;
}

// Returns the most likely state of foot `leg` in each frame, by dynamic programming.
std::vector<std::uint8_t> likely_states(const std::vector<float>& odds, const Soles& soles,
                                        std::size_t leg) {
  const std::size_t frames = soles.body.frames, points = soles.body.points;
  const double weight = new_share * contact_rate_hz / soles.body.frame_rate_hz;
  std::vector<std::array<std::uint8_t, states>> before(frames);
  std::array<double, states> best{};
  for (std::size_t f = 0; f < frames; ++f) {
    std::array<double, states> next{};
    for (std::size_t to = 0; to < states; ++to) {
      std::size_t from = 0;
      double score = -std::numeric_limits<double>::infinity();
      for (std::size_t s = 0; s < states; ++s) {
        const double own = best[s] - cost_between(s, to);
        if (own > score) score = own, from = s;
      }
      for (std::size_t part = 0; part < 2; ++part) {
        const double odd = odds[f * points + 2 * leg + part];
        if (stands(to, part)) score += soles.has[2 * leg + part] != 0 ? weight * odd : -1e9;
      }
      next[to] = score;
      before[f][to] = static_cast<std::uint8_t>(from);
    }
    best = next;
  }
  std::vector<std::uint8_t> result(frames);
  auto state = static_cast<std::size_t>(std::max_element(best.begin(), best.end()) - best.begin());
  for (std::size_t f = frames; f-- > 0;) {
    result[f] = static_cast<std::uint8_t>(state);
    state = before[f][state];
  }
  return result;
}

double probability(double odds) { return 1 / (1 + portable::exp(-odds)); }

}  // namespace

std::vector<std::uint8_t> contact_flags(const std::vector<FootContact>& contacts,
                                        std::size_t frames, std::size_t points) {
  std::vector<std::uint8_t> flags(frames * points);
  for (const FootContact& contact : contacts) {
    for (std::size_t f = contact.first_frame; f <= contact.last_frame; ++f)
      flags[f * points + Soles::point_of(contact)] = 1;
  }
  return flags;
}

FoundContacts likely_contacts(const ContactNetwork& network, const Soles& soles,
                              const std::vector<FootContact>& by_thresholds,
                              const ContactSettings& settings) {
  const std::vector<float> odds =
      standing_odds(network, soles.body, soles.up, Lookahead::whole,
                    contact_flags(by_thresholds, soles.body.frames, soles.body.points));
  const std::size_t points = soles.body.points;
  const std::size_t least = frames_in(settings.least_s, soles.body.frame_rate_hz, 2);
  FoundContacts found;
  double expected = 0;  // frames
  for (std::size_t leg = 0; leg < soles.legs(); ++leg) {
    if (soles.has[2 * leg + 1] == 0) continue;
    const std::vector<std::uint8_t> sequence = likely_states(odds, soles, leg);
    for (std::size_t f = 0; f < sequence.size(); ++f) {
      const float* const own = odds.data() + f * points + 2 * leg;
      expected += probability(std::max(own[0], own[1]));
    }
    for (std::size_t part = 0; part < 2; ++part) {
      const std::size_t p = 2 * leg + part;
      if (soles.has[p] == 0) continue;
      const auto is_down = [&](std::size_t f) { return stands(sequence[f], part); };
      for (const FrameSpan& span : runs_where(sequence.size(), is_down, least - 1)) {
        if (span.length() < least) continue;
        double sum = 0;
        for (std::size_t f = span.first; f <= span.last; ++f)
          sum += probability(odds[f * points + p]);
        found.contacts.push_back({leg, static_cast<FootPart>(part), span.first, span.last,
                                  sum / static_cast<double>(span.length())});
      }
    }
  }
  found.expected_s = expected / soles.body.frame_rate_hz;
  return found;
}

double standing_s(const std::vector<FootContact>& contacts, std::span<const std::uint8_t> flags,
                  std::size_t frames, std::size_t legs, double frame_rate_hz) {
  std::vector<std::uint8_t> stands(frames * legs);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (!flags.empty() && flags[i] == 0) continue;
    for (std::size_t f = contacts[i].first_frame; f <= contacts[i].last_frame; ++f)
      stands[f * legs + contacts[i].leg] = 1;
  }
  return static_cast<double>(std::count(stands.begin(), stands.end(), 1)) / frame_rate_hz;
}

StandingTime standing_time(const std::vector<FootContact>& contacts,
                           std::optional<double> expected_s, std::size_t frames, std::size_t legs,
                           double frame_rate_hz) {
  StandingTime time;
  time.found_s = standing_s(contacts, {}, frames, legs, frame_rate_hz);
  time.expected_s = expected_s.value_or(time.found_s);
  double parts = 0;
  for (const FootContact& contact : contacts) {
    const auto length = static_cast<double>(contact.last_frame - contact.first_frame + 1);
    time.confidence += length * contact.confidence;
    parts += length;
  }
  if (parts > 0) time.confidence /= parts;
  return time;
}

}  // namespace kinemend::feet
