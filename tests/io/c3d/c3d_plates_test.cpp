// Tests of force plates: loads from analog channels of every type, and their corners.
#include <gmock/gmock.h>

#include <bit>
#include <cstring>
#include <memory>
#include <numeric>

#include "c3d_support.hpp"
#include "kinemend/extend/motion.hpp"

namespace kinemend {
namespace {

using testing::DoubleEq;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pointwise;

// A file of one plate without points, two instants a frame, whose channel c has the value
// `at(instant, c)`, from 0.
template <class At>
Take take_of_plate(double type, std::size_t channels, std::size_t instants, const At& at) {
  auto document = std::make_shared<C3dDocument>();
  C3dLayout& layout = document->layout;
  layout.is_float = true;
  layout.rate_hz = document->frame_rate_hz = 100;
  layout.frame_count = instants / 2;
  layout.analog_count = channels;
  layout.analog_values = 2 * channels;
  for (std::size_t i = 0; i < instants; ++i) {
    for (std::size_t c = 0; c < channels; ++c) {
      const auto value = static_cast<float>(at(i, c));
      document->bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
  }
  std::vector<double> numbers(channels);
  std::iota(numbers.begin(), numbers.end(), 1.0);
  C3dParameters& parameters = document->parameters;
  set_parameter(parameters, "FORCE_PLATFORM", c3d_integer("USED", 1));
  set_parameter(parameters, "FORCE_PLATFORM", c3d_integers("TYPE", {type}));
  set_parameter(parameters, "FORCE_PLATFORM", c3d_integers("CHANNEL", numbers));
  set_parameter(parameters, "FORCE_PLATFORM",
                c3d_reals("CORNERS", {0, 0, 0, 400, 0, 0, 400, 600, 0, 0, 600, 0}, 3));
  Take take;
  take.unit = "mm";
  take.source.format = "c3d";
  take.source.document = std::move(document);
  return take;
}

C3dParameters& parameters_of(Take& take) {
  return const_cast<C3dDocument&>(dynamic_cast<const C3dDocument&>(*take.source.document))
      .parameters;
}

// A force of -700 N in the second half.
double step_force(std::size_t instant) { return instant < 4 ? 0 : -700; }

TEST(C3dPlates, LoadsAreTheNormalForceTurnedUpward) {
  const Take take = take_of_plate(
      2, 6, 8, [](std::size_t i, std::size_t c) { return c == 2 ? step_force(i) : 31.0; });
  const std::vector<ForcePlate> plates = force_plates(take);
  ASSERT_EQ(plates.size(), 1u);
  EXPECT_EQ(plates[0].rate_hz, 200);
  EXPECT_THAT(plates[0].loads, Pointwise(DoubleEq(), {0., 0., 0., 0., 700., 700., 700., 700.}));
  EXPECT_EQ(plates[0].corners[2], (Vec3{400, 600, 0}));
}

TEST(C3dPlates, TypeThreeIsTheSumOfFourCorners) {
  const Take take = take_of_plate(
      3, 8, 8, [](std::size_t i, std::size_t c) { return c >= 4 ? step_force(i) / 4 : 31.0; });
  EXPECT_THAT(force_plates(take).at(0).loads,
              Pointwise(DoubleEq(), {0., 0., 0., 0., 700., 700., 700., 700.}));
}

TEST(C3dPlates, TypeFourTakesTheThirdRowOfItsMatrix) {
  Take take = take_of_plate(4, 6, 8, [](std::size_t i, std::size_t c) {
    return i < 4 ? 0.0 : static_cast<double>(c + 1);
  });
  std::vector<double> matrix(36);
  for (std::size_t row = 0; row < 6; ++row) {
    for (std::size_t column = 0; column < 6; ++column)
      matrix[6 * column + row] = row == 2 ? 10.0 * static_cast<double>(column) : 1;
  }
  set_parameter(parameters_of(take), "FORCE_PLATFORM", c3d_reals("CAL_MATRIX", matrix, 6));
  // 10 (0 1 + 1 2 + 2 3 + 3 4 + 4 5 + 5 6)
  EXPECT_THAT(force_plates(take).at(0).loads,
              Pointwise(DoubleEq(), {0., 0., 0., 0., 700., 700., 700., 700.}));
}

TEST(C3dPlates, FramesThatTheFileCallsUnloadedAreZero) {
  Take take = take_of_plate(
      2, 6, 8, [](std::size_t i, std::size_t c) { return c == 2 ? step_force(i) - 2900 : 0.0; });
  set_parameter(parameters_of(take), "FORCE_PLATFORM", c3d_integers("ZERO", {1, 2}));
  EXPECT_THAT(force_plates(take).at(0).loads,
              Pointwise(DoubleNear(1e-9), {0., 0., 0., 0., 700., 700., 700., 700.}));
  set_parameter(parameters_of(take), "FORCE_PLATFORM", c3d_integers("ZERO", {1, 0}));
  EXPECT_EQ(force_plates(take).at(0).loads.front(), 2900) << "no range: as it is";
}

TEST(C3dPlates, AreNotReadWhereTheFileIsDamaged) {
  const auto loaded = [](std::size_t i, std::size_t) { return step_force(i); };
  Take take = take_of_plate(2, 6, 8, loaded);
  set_parameter(parameters_of(take), "FORCE_PLATFORM",
                c3d_integers("CHANNEL", {1, 2, 99, 4, 5, 6}));
  EXPECT_THAT(force_plates(take), IsEmpty()) << "a channel that does not exist";
  take = take_of_plate(2, 6, 8, loaded);
  set_parameter(parameters_of(take), "FORCE_PLATFORM", c3d_reals("CORNERS", {0, 0, 0}, 3));
  EXPECT_THAT(force_plates(take), IsEmpty()) << "corners left out";
  EXPECT_THAT(force_plates(take_of_plate(9, 6, 8, loaded)), IsEmpty()) << "an unknown type";
  EXPECT_THAT(force_plates(take_of_plate(4, 6, 8, loaded)), IsEmpty()) << "no matrix";
  EXPECT_THAT(force_plates(test::read_good_c3d("laboratory")), IsEmpty()) << "three channels";
  EXPECT_THAT(force_plates(Take{}), IsEmpty()) << "not from C3D";
}

TEST(C3dPlates, CornersFollowTheTakeIntoOtherUnits) {
  Take take = take_of_plate(2, 6, 8, [](std::size_t i, std::size_t) { return step_force(i); });
  TakeChange change;
  change.length_factor = 0.001;
  change.shift = {1, 0, 0};
  take.source.document = dynamic_cast<const C3dDocument&>(*take.source.document).after(change);
  const ForcePlate plate = force_plates(take).at(0);
  EXPECT_NEAR(plate.corners[2].x, 1.4, 1e-12);
  EXPECT_NEAR(plate.corners[2].y, 0.6, 1e-12);
  EXPECT_EQ(plate.loads.back(), 700);
}

}  // namespace
}  // namespace kinemend
