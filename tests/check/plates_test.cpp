// Tests of the comparison of stands with the loads of force plates.
#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

#include "check/support.hpp"
#include "kinemend/io.hpp"

namespace kinemend::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Two feet, each with a marker on heel and toe, that step forward by turns: each stands for a
// second while the other swings over 60 cm in half of it. Centimetres, 100 Hz.
struct Steps {
  Take take = make_marker_take({"LASI", "RASI", "LHEE", "LTOE", "RHEE", "RTOE"}, 600, 100);
  FootStands stands;

  Steps() {
    take.unit = "cm";
    std::fill(take.observed.begin(), take.observed.end(), std::uint8_t{1});
    stands.sides = {"left", "right"};
    stands.tracks = {{2, 3}, {4, 5}};
    for (std::size_t f = 0; f < take.frame_count(); ++f) {
      const Vec3 left = foot_at(f, 0), right = foot_at(f, 1);
      take.position(f, 0) = 0.5 * (left + right) + Vec3{10, 95, 0};
      take.position(f, 1) = 0.5 * (left + right) + Vec3{-10, 95, 0};
      for (std::size_t part = 0; part < 2; ++part) {
        const Vec3 along{0, 0, part == 0 ? 0.0 : 18.0};
        take.position(f, 2 + part) = left + along;
        take.position(f, 4 + part) = right + along;
      }
    }
  }

  // Foot 0 swings in frames 50 to 100, 250 to 300, ...; foot 1 100 frames later.
  Vec3 foot_at(std::size_t frame, std::size_t foot) const {
    const double t = (static_cast<double>(frame) - (foot == 0 ? 50 : 150)) / 200;
    const double whole = std::floor(t), share = std::min(1.0, 4 * (t - whole));
    const double lift = share < 1 ? 12 * std::sin(pi * share) : 0;
    return {foot == 0 ? 10.0 : -10.0, 4 + lift, 60 * (whole + share)};
  }

  // A plate under the n-th place of a foot that is loaded in these seconds.
  ForcePlate plate_under(Vec3 place, double from_s, double to_s) const {
    ForcePlate plate;
    plate.corners = {place + Vec3{-9, -4, -10}, place + Vec3{9, -4, -10}, place + Vec3{9, -4, 30},
                     place + Vec3{-9, -4, 30}};
    plate.rate_hz = 1000;
    for (int i = 0; i < 6000; ++i)
      plate.loads.push_back(i >= 1000 * from_s && i < 1000 * to_s ? 700 : 0.5);
    return plate;
  }
};

CheckReport report_with(const Take& take, std::vector<ForcePlate> plates) {
  CheckSettings settings;
  settings.plates = std::move(plates);
  return check_take(take, settings);
}

TEST(Plates, AFootThatComesDownLaterThanItsLoadBeginsIsReported) {
  const Steps steps;
  // The left foot stands from 1.0 s to 2.5 s.
  const ForcePlate plate = steps.plate_under(steps.foot_at(150, 0), 0.95, 2.55);
  const CheckReport report = report_with(steps.take, {plate});
  ASSERT_EQ(report.plate_stands.size(), 1u);
  const PlateStand& stand = report.plate_stands[0];
  EXPECT_THAT(stand.plates, ElementsAre(0));
  EXPECT_EQ(report.stands.sides[stand.foot], "left");
  EXPECT_TRUE(stand.is_found);
  EXPECT_NEAR(stand.first_s, 0.95, 1e-9);
  EXPECT_NEAR(stand.last_s, 2.55, 1e-9);
  ASSERT_TRUE(stand.onset_ms && stand.offset_ms);
  EXPECT_NEAR(*stand.onset_ms, 50, 30);
}

TEST(Plates, ALoadThatIsMovedIsFoundMovedByAsMuch) {
  const Steps steps;
  const Vec3 place = steps.foot_at(150, 0);
  const auto stand = [&](double by_s) {
    return report_with(steps.take, {steps.plate_under(place, 1 + by_s, 2.5 + by_s)})
        .plate_stands.at(0);
  };
  EXPECT_NEAR(*stand(0).onset_ms - *stand(0.04).onset_ms, 40, 1e-6);
  EXPECT_NEAR(*stand(0).offset_ms - *stand(0.04).offset_ms, 40, 1e-6);
}

TEST(Plates, TwoPlatesUnderOneFootAreOneLoad) {
  const Steps steps;
  const Vec3 place = steps.foot_at(150, 0);
  ForcePlate later = steps.plate_under(place, 1.2, 2.6);
  const CheckReport report = report_with(steps.take, {steps.plate_under(place, 1, 2.5), later});
  ASSERT_EQ(report.plate_stands.size(), 1u);
  EXPECT_THAT(report.plate_stands[0].plates, ElementsAre(0, 1));
  EXPECT_NEAR(report.plate_stands[0].first_s, 1, 1e-9);
  EXPECT_NEAR(report.plate_stands[0].last_s, 2.6, 1e-9);
}

TEST(Plates, APlateUnderBothFeetSaysNothingOfEither) {
  const Steps steps;
  ForcePlate wide = steps.plate_under(steps.foot_at(150, 0), 1, 2.5);
  for (Vec3& corner : wide.corners) corner.x *= 5, corner.z = corner.z < 50 ? -200 : 900;
  EXPECT_THAT(report_with(steps.take, {wide}).plate_stands, IsEmpty());
}

TEST(Plates, APlateWithoutLoadUnderAStandingFootIsNotBelieved) {
  const Steps steps;
  const Vec3 place = steps.foot_at(150, 0);
  EXPECT_THAT(report_with(steps.take, {steps.plate_under(place, 2.2, 2.5)}).plate_stands,
              IsEmpty());
}

TEST(Plates, AKnockOnAPlateThatNoFootIsOnIsNoLoad) {
  const Steps steps;
  const ForcePlate far = steps.plate_under({500, 4, 0}, 1, 2);
  EXPECT_THAT(report_with(steps.take, {far}).plate_stands, IsEmpty());
}

TEST(Plates, FiguresAreMediansOfAbsoluteDifferences) {
  PlateStand early{{0}, 0, 1, 2, true, -10.0, 5.0}, late{{0}, 0, 3, 4, true, 30.0, {}},
      later{{0}, 0, 5, 6, true, -20.0, {}}, missed{{1}, 1, 3, 4, false, {}, {}};
  const PlateFigures figures = plate_figures({early, late, later, missed});
  EXPECT_EQ(figures.loads, 4u);
  EXPECT_EQ(figures.found, 3u);
  EXPECT_EQ(figures.onset_ms, 20.0);
  EXPECT_EQ(figures.offset_ms, 5.0);
  EXPECT_FALSE(plate_figures({missed}).onset_ms);
}

}  // namespace
}  // namespace kinemend::test
