// Tests of the features and the network that find standing feet.
#include "feet/contact_network.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "feet/contacts.hpp"
#include "feet/leg_motion.hpp"
#include "feet/support.hpp"
#include "kinemend/lab/corrupt.hpp"

namespace kinemend::feet {
namespace {

using test::y_up;

BodyPoints soles_of(const Take& clip) {
  LegMotion motion = leg_motion(clip, find_legs(clip.skeleton));
  set_heels(clip, y_up, motion);
  return sole_points(motion);
}

// Every place turned about the vertical axis, scaled, and shifted.
BodyPoints placed_elsewhere(BodyPoints body, double scale) {
  const Quat turn = exp({0, 2.1, 0});
  for (std::vector<Vec3>* const places : {&body.positions, &body.centres}) {
    for (Vec3& place : *places) place = scale * rotate(turn, place) + Vec3{30, 5, -70};
  }
  body.height *= scale;
  return body;
}

TEST(ContactSteps, DependNeitherOnPlaceNorHeadingNorSize) {
  const BodyPoints body = soles_of(test::synthetic_clip("walk", 3));
  for (const Lookahead lookahead : {Lookahead::whole, Lookahead::none}) {
    const ContactSteps here = contact_steps(body, y_up, lookahead);
    const ContactSteps there = contact_steps(placed_elsewhere(body, 2.5), y_up, lookahead);
    ASSERT_EQ(here.features.size(), there.features.size());
    for (std::size_t i = 0; i < here.features.size(); ++i)
      EXPECT_NEAR(here.features[i], there.features[i], 1e-4) << i;
  }
}

TEST(ContactSteps, AreSixtyASecondAtAnyRate) {
  for (const double rate : {15.0, 24.0, 60.0, 120.0, 240.0}) {
    const Take clip = test::synthetic_clip("walk", 2, rate);
    const ContactSteps steps = contact_steps(soles_of(clip), y_up, Lookahead::whole);
    const double seconds = static_cast<double>(clip.frame_count() - 1) / rate;
    EXPECT_EQ(steps.count, 1 + static_cast<std::size_t>(60 * seconds + 1e-6)) << rate;
  }
}

TEST(ContactSteps, BridgeWhatIsNotSeen) {
  BodyPoints body = soles_of(test::synthetic_clip("walk", 2));
  const ContactSteps seen = contact_steps(body, y_up, Lookahead::whole);
  body.observed.assign(body.frames * body.points, 1);
  for (std::size_t f = 50; f < 56; ++f) body.observed[f * body.points + 1] = 0;
  const ContactSteps bridged = contact_steps(body, y_up, Lookahead::whole);
  for (std::size_t i = 0; i < seen.features.size(); ++i) {
    EXPECT_TRUE(std::isfinite(bridged.features[i]));
    EXPECT_NEAR(seen.features[i], bridged.features[i], 2) << i;
  }
}

TEST(LiveContactSteps, AreThoseOfTheWholeTakeWithoutLookahead) {
  for (const double rate : {24.0, 60.0, 120.0, 150.0}) {
    const BodyPoints body = soles_of(test::synthetic_clip("walk", 25, rate));
    const ContactSteps whole = contact_steps(body, y_up, Lookahead::none);
    LiveContactSteps live(2, rate, body.height, y_up);
    std::vector<float> rows(2 * contact_features);
    std::size_t step = 0;
    for (std::size_t f = 0; f < body.frames; ++f) {
      live.push(std::span(body.positions).subspan(4 * f, 4), body.centres[f]);
      for (; live.next_step(rows); ++step) {
        for (std::size_t i = 0; i < rows.size(); ++i) {
          const std::size_t foot = i / contact_features, feature = i % contact_features;
          ASSERT_NEAR(rows[i],
                      whole.features[(foot * whole.count + step) * contact_features + feature],
                      1e-4)
              << rate << " step " << step << " feature " << feature;
        }
      }
    }
    EXPECT_EQ(step, whole.count);
  }
}

TEST(LiveContactNetwork, SaysWhatItSaysOfTheWholeTake) {
  const auto network = shipped_contact_network(Lookahead::none);
  ASSERT_NE(network, nullptr);
  const ContactSteps steps =
      contact_steps(soles_of(test::synthetic_clip("walk", 4)), y_up, Lookahead::none);
  const std::vector<float> whole = run(*network, steps);
  LiveContactNetwork live(*network, 2);
  std::vector<float> rows(2 * contact_features);
  for (std::size_t s = 0; s < steps.count; ++s) {
    for (std::size_t l = 0; l < 2; ++l) {
      const auto row = std::span(steps.features)
                           .subspan((l * steps.count + s) * contact_features, contact_features);
      std::copy(row.begin(), row.end(),
                rows.begin() + static_cast<std::ptrdiff_t>(l * contact_features));
    }
    const std::span<const float> odds = live.run(rows);
    for (std::size_t i = 0; i < 4; ++i)
      ASSERT_NEAR(odds[i], whole[((i / 2) * steps.count + s) * 2 + i % 2], 1e-3) << s;
  }
}

// The share of standing time that is found, and the share of the time found that is right.
std::pair<double, double> score(const std::vector<FootContact>& truth,
                                const std::vector<FootContact>& found, std::size_t frames) {
  const auto right = contact_flags(truth, frames, 4), says = contact_flags(found, frames, 4);
  double both = 0, stands = 0, said = 0;
  for (std::size_t i = 0; i < right.size(); ++i) {
    both += right[i] & says[i];
    stands += right[i];
    said += says[i];
  }
  return {both / stands, both / said};
}

TEST(LikelyContacts, SeeFeetThatStandUnderTheErrorsOfVideo) {
  const Take truth = test::synthetic_clip("walk", 8);
  ContactSettings thresholds;
  thresholds.finder = ContactFinder::thresholds;
  const std::vector<FootContact> contacts = find_contacts(truth, thresholds);
  Take noisy = truth;
  Random random(4);
  apply_damage(noisy, "system", {{"kind", std::string("video")}}, random);
  const auto [found, right] = score(contacts, find_contacts(noisy), truth.frame_count());
  EXPECT_GT(found, 0.8);
  EXPECT_GT(right, 0.8);
  EXPECT_LT(score(contacts, find_contacts(noisy, thresholds), truth.frame_count()).first, 0.5);
}

TEST(LikelyContacts, AreThoseOfThresholdsInACleanTake) {
  const Take clip = test::synthetic_clip("walk", 8);
  ContactSettings thresholds;
  thresholds.finder = ContactFinder::thresholds;
  const auto [found, right] =
      score(find_contacts(clip, thresholds), find_contacts(clip), clip.frame_count());
  EXPECT_GT(found, 0.95);
  EXPECT_GT(right, 0.95);
}

TEST(LikelyContacts, StateHowLikelyTheyAre) {
  const Take clip = test::synthetic_clip("walk", 4);
  for (const FootContact& contact : find_contacts(clip)) {
    EXPECT_GT(contact.confidence, 0.5);
    EXPECT_LE(contact.confidence, 1);
  }
}

TEST(ContactModel, IsRefusedWithoutItsLayers) {
  Model model = *shipped_model("contacts");
  model.tensors.erase("whole.block0.dense.weight");
  EXPECT_THROW(contact_network_of(model, Lookahead::whole), Error);
  Model other = *shipped_model("contacts");
  other.numbers["blocks"] = 100;
  EXPECT_THROW(contact_network_of(other, Lookahead::whole), Error);
}

}  // namespace
}  // namespace kinemend::feet
