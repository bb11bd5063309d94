// Tests of the prior of `sparse`: local coordinates, points, parts of the body, the model file, and
// the filter.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <set>
#include <string>
#include <utility>

#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/lab/train.hpp"
#include "papers/xiao2015_sparse/sparse_filter.hpp"
#include "papers/xiao2015_sparse/sparse_prior.hpp"

namespace kinemend {
namespace {

Take walk(std::uint64_t seed, double duration_s = 3) {
  SynthOptions options;
  options.duration_s = duration_s;
  options.frame_rate_hz = 60;
  options.seed = seed;
  return synthesize(options);
}

Model trained(const std::vector<Take>& clips, OptionValues options = {}) {
  options.try_emplace("atoms", std::int64_t{60});
  options.try_emplace("window_frames", std::int64_t{9});
  options.try_emplace("iterations", std::int64_t{4});
  TrainingTakes takes{clips.size(), [&](std::size_t i) -> Take { return clips[i]; }};
  return train_model("sparse", takes, options);
}

const Model& joint_model() {
  static const Model model = trained(std::vector<Take>{walk(1), walk(2)});
  return model;
}

BodyChannels channels_of_clip(const Model& model, const Take& clip) {
  return encode_body(clip, model.layout, match_body(model.layout, clip));
}

double rms(const PoseMatrix& a, const PoseMatrix& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    sum += (a.values[i] - b.values[i]) * (a.values[i] - b.values[i]);
  return std::sqrt(sum / static_cast<double>(a.values.size()));
}

PoseMatrix three_points(const std::vector<Vec3>& points) {
  PoseMatrix result(1, 3 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    result(0, 3 * i) = points[i].x;
    result(0, 3 * i + 1) = points[i].y;
    result(0, 3 * i + 2) = points[i].z;
  }
  return result;
}

TEST(LocalCoordinates, PutHipsAndNeckAsThePaperSays) {
  PoseMatrix pose = three_points({{5, 1, 2}, {5.3, 1.2, 2.1}, {4.9, 0.8, 2.4}, {5.6, 2, 1.4}});
  const LocalPoints points{0, 1, 2, 3};
  const std::vector<LocalFrame> frames = local_frames(pose, points);
  to_local(frames, pose);
  const auto at = [&](std::size_t i) {
    return Vec3{pose(0, 3 * i), pose(0, 3 * i + 1), pose(0, 3 * i + 2)};
  };
  EXPECT_LT(norm(at(0)), 1e-12);
  const Vec3 up = at(3) - 0.5 * (at(1) + at(2));
  EXPECT_NEAR(up.x, 0, 1e-12);
  EXPECT_NEAR(up.z, 0, 1e-12);
  EXPECT_GT(up.y, 0);
  EXPECT_NEAR(at(1).z, at(2).z, 1e-12);  // the plane of the three is parallel to XY
  EXPECT_GT(at(1).x, at(2).x);
}

TEST(LocalCoordinates, AreUndoneExactlyAndSurviveDegeneratePoses) {
  Random random(1);
  PoseMatrix positions(6, 15);
  for (double& value : positions.values) value = random.normal();
  for (std::size_t c = 0; c < 15; ++c) positions(0, c) = 0;  // all points coincide
  for (std::size_t axis = 0; axis < 3; ++axis) {             // points on a line
    positions(3, 3 + axis) = 1;
    positions(3, 6 + axis) = 2;
    positions(3, 9 + axis) = 3;
  }
  const std::vector<LocalFrame> frames = local_frames(positions, {0, 1, 2, 3});
  EXPECT_EQ(frames[0].turn, frames[1].turn);
  EXPECT_EQ(frames[3].turn, frames[2].turn);
  PoseMatrix there = positions;
  to_local(frames, there);
  from_local(frames, there);
  for (std::size_t i = 0; i < positions.values.size(); ++i)
    EXPECT_NEAR(there.values[i], positions.values[i], 1e-12);
}

TEST(SparsePoints, AreTheJointsOfTheTakeInBodyHeights) {
  const Take clip = walk(3);
  const Model& model = joint_model();
  const SparsePrior prior = sparse_prior_of(model);
  const BodyMatch match = match_body(model.layout, clip);
  const BodyChannels channels = encode_body(clip, model.layout, match);
  const PoseMatrix points = points_of(prior.points, model.layout, channels.poses);
  const std::vector<Vec3> truth = joint_positions(clip);
  const std::size_t joints = clip.joint_count();
  for (const std::size_t f : {std::size_t{0}, std::size_t{50}}) {
    for (std::size_t i = 1; i < model.layout.track_count(); ++i) {
      const Vec3 own{points(f, 3 * i), points(f, 3 * i + 1), points(f, 3 * i + 2)};
      const auto root = static_cast<std::size_t>(match.tracks[0]);
      const auto joint = static_cast<std::size_t>(match.tracks[i]);
      const double distance = norm(truth[f * joints + joint] - truth[f * joints + root]);
      EXPECT_NEAR(norm(own), distance / match.body_height, 2e-3) << model.layout.names[i];
    }
  }
}

TEST(SparsePoints, TurnBackIntoTheRotationsTheyCameFrom) {
  const Model& model = joint_model();
  const SparsePrior prior = sparse_prior_of(model);
  const PoseMatrix channels = channels_of_clip(model, walk(4)).poses;
  const PoseMatrix points = points_of(prior.points, model.layout, channels);
  const PoseMatrix back = channels_of(prior.points, model.layout, points, channels);
  EXPECT_LT(rms(back, channels), 1e-6);
  // Even from an inaccurate guide, the solver reaches the positions that bones determine.
  PoseMatrix guide = channels;
  Random random(5);
  for (std::size_t f = 0; f < guide.frames; ++f) {
    for (std::size_t c = 0; c < 3 * model.layout.track_count(); ++c)
      guide(f, c) += 3 * random.normal();
  }
  const PoseMatrix near = channels_of(prior.points, model.layout, points, guide, 1e-4);
  EXPECT_LT(rms(points_of(prior.points, model.layout, near), points), 1e-4);
}

TEST(Poselets, AreTorsoArmsAndLegsWithSharedJoints) {
  const Model& model = joint_model();
  const SparsePrior prior = sparse_prior_of(model);
  ASSERT_EQ(prior.poselets.size(), 5u);
  std::vector<std::size_t> uses(prior.points.count(), 0);
  for (const SparsePoselet& poselet : prior.poselets) {
    for (const std::int32_t point : poselet.points) uses[static_cast<std::size_t>(point)] += 1;
  }
  EXPECT_EQ(std::count(uses.begin(), uses.end(), 0u), 0);
  EXPECT_GE(std::count(uses.begin(), uses.end(), 2u), 4);
  EXPECT_EQ(find_poselets(model.layout, prior.points, true).size(), 1u);
}

TEST(SparseTraining, KnowsThePapersLocalCoordinatesWhereAskedFor) {
  EXPECT_LT(sparse_prior_of(joint_model()).local.root, 0);
  const LocalPoints local =
      sparse_prior_of(trained(std::vector<Take>{walk(1, 1)}, {{"local", true}})).local;
  EXPECT_EQ(local.root, 0);
  EXPECT_GE(std::min({local.left_hip, local.right_hip, local.neck}), 1);
}

TEST(Poselets, OfMarkersGoByNamesOrByWhereTheyAre) {
  BodyLayout layout;
  layout.kind = BodyKind::markers;
  layout.names = {"LASI", "RKNE", "C7", "LELB", "x1", "x2"};
  layout.means = {{0.1, 0.55, 0}, {-0.1, 0.3, 0},  {0, 0.85, 0},
                  {0.2, 0.6, 0},  {-0.25, 0.6, 0}, {0.1, 0.1, 0}};
  const std::vector<SparsePoselet> poselets = find_poselets(layout, marker_points(layout));
  ASSERT_EQ(poselets.size(), 5u);
  EXPECT_THAT(poselets[0].points, testing::ElementsAre(0, 2));
  EXPECT_THAT(poselets[1].points, testing::ElementsAre(3));
  EXPECT_THAT(poselets[2].points, testing::ElementsAre(4));
  EXPECT_THAT(poselets[3].points, testing::ElementsAre(0, 5));
  EXPECT_THAT(poselets[4].points, testing::ElementsAre(1));
}

BodyLayout layout_of_four() {
  BodyLayout layout;
  layout.names = {"Hips", "Spine", "LeftArm", "RightArm"};
  return layout;
}

// Four joints, and the end sites of the two arms.
SparsePoints points_of_four() {
  SparsePoints points;
  points.parents = {-1, 0, 1, 1, 2, 3};
  points.offsets.resize(6);
  return points;
}

TEST(PoseletFile, SaysWhichJointsArePartsOfWhat) {
  const std::vector<SparsePoselet> poselets = parse_poselets(
      "\xEF\xBB\xBF# of a puppet\r\n\n middle : Hips, spine\r\narms: *Arm, Spine # both", "own.txt",
      layout_of_four(), points_of_four());
  ASSERT_EQ(poselets.size(), 2u);
  EXPECT_EQ(poselets[0].name, "middle");
  EXPECT_THAT(poselets[0].points, testing::ElementsAre(0, 1));
  EXPECT_EQ(poselets[1].name, "arms");
  EXPECT_THAT(poselets[1].points, testing::ElementsAre(1, 2, 3, 4, 5));
}

TEST(PoseletFile, IsRefusedWithTheLineAndWhatIsWrongWithIt) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"all: *\nHips", "own.txt:2: expected \"poselet: name, name, ...\", found \"Hips\""},
      {": Hips", "own.txt:1: expected the poselet's name before the colon"},
      {"a:  # nothing", "own.txt:1: poselet \"a\" is empty"},
      {"a: Hips,,Spine", "own.txt:1: a name is missing between two commas"},
      {"a: Hips, Tail", "own.txt:1: no joint is named \"Tail\""},
      {"a: *\n\na: *", "own.txt:3: poselet \"a\" is already in a line above"},
      {"# none", "own.txt: there are no poselets in it"},
      {"a: Hips, LeftArm", "own.txt: in no poselet: Spine, RightArm"}};
  for (const auto& [text, message] : cases) {
    try {
      parse_poselets(text, "own.txt", layout_of_four(), points_of_four());
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), message);
      EXPECT_EQ(error.kind(), ErrorKind::usage);
    }
  }
}

TEST(SparseTraining, LearnsThePoseletsOfAFileAndKeepsThemInTheModel) {
  const std::string path = testing::TempDir() + "poselets.txt";
  std::ofstream(path) << "left: *Left*, Hips\nothers: *\n";
  const Model model = trained(std::vector<Take>{walk(1, 1)}, {{"poselets", path}});
  const SparsePrior prior = sparse_prior_of(parse_model(write_model(model), "own"));
  ASSERT_EQ(prior.poselets.size(), 2u);
  EXPECT_EQ(prior.poselets[1].points.size(), prior.points.count());
  for (const std::int32_t point : prior.poselets[0].points) {
    const auto own = static_cast<std::size_t>(point);
    const std::size_t track = own < model.layout.track_count()
                                  ? own
                                  : static_cast<std::size_t>(prior.points.parents[own]);
    const std::string& name = model.layout.names[track];
    EXPECT_TRUE(name == "Hips" || name.find("Left") != name.npos) << name;
  }
  std::remove(path.c_str());
  EXPECT_THROW(trained(std::vector<Take>{walk(1, 1)}, {{"poselets", path}}), Error);
  EXPECT_THROW(trained(std::vector<Take>{walk(1, 1)}, {{"poselets", path}, {"whole", true}}),
               Error);
}

TEST(SparsePriorFile, ComesBackAndIsRefusedWhereItDoesNotFit) {
  const Model& model = joint_model();
  Model again = model;
  store_sparse_prior(sparse_prior_of(model), again);
  EXPECT_EQ(write_model(again), write_model(model));
  for (const char* name : {"point_parents", "offsets", "local_points", "poselet0.points",
                           "poselet1.mean", "poselet2.atoms"}) {
    Model broken = model;
    broken.tensors.erase(name);
    EXPECT_THROW(sparse_prior_of(broken), Error) << name;
    broken = model;
    for (double& value : broken.tensors[name].values) value += 1000;
    if (broken.tensors[name].stored == TensorType::i32) {
      EXPECT_THROW(sparse_prior_of(broken), Error) << name;
    }
  }
}

TEST(DictionaryAtRate, IsTheSameWaveAtTwiceTheRate) {
  SparsePoselet poselet;
  poselet.points = {0};
  poselet.dictionary = {30, 1, {}};
  const auto wave = [](double u) { return 1 + std::cos(pi * u) + 0.5 * std::cos(3 * pi * u); };
  for (std::size_t i = 0; i < 10; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      poselet.dictionary.values.push_back(
          static_cast<float>((axis + 1) * wave((static_cast<double>(i) + 0.5) / 10)));
  }
  const sparse::Dictionary twice = dictionary_at_rate(poselet, 10, 20);
  ASSERT_EQ(twice.rows, 60u);
  const double scale = twice.values[0] / wave(0.025);
  double length = 0;
  for (std::size_t i = 0; i < 20; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = twice.values[3 * i + axis];
      EXPECT_NEAR(value,
                  scale * static_cast<double>(axis + 1) * wave((static_cast<double>(i) + 0.5) / 20),
                  1e-5);
      length += value * value;
    }
  }
  EXPECT_NEAR(length, 1, 1e-5);
}

// A noisy walk of markers, similar to the training takes.
struct NoisyTake {
  SparsePrior prior;
  PoseMatrix clean, noisy;
  std::vector<std::uint8_t> observed;
  std::vector<double> noise;

  double error(const SparseSettings& settings = {}) const {
    return rms(sparse_filter(prior, {noisy, clean, observed, noise, 60}, settings), clean);
  }
};
NoisyTake noisy_take(double noise, double outliers, double duration_s = 1.5) {
  static const Model model =
      trained(std::vector<Take>{joint_markers(walk(1)), joint_markers(walk(2))});
  NoisyTake take;
  take.prior = sparse_prior_of(model);
  const Take clip = joint_markers(walk(6, duration_s));
  take.clean = points_of(take.prior.points, model.layout,
                         encode_body(clip, model.layout, match_body(model.layout, clip)).poses);
  take.noisy = take.clean;
  Random random(7);
  for (double& value : take.noisy.values)
    value += noise * random.normal() + (random.chance(outliers) ? 0.2 : 0);
  take.observed.assign(take.noisy.values.size(), 1);
  take.noise.assign(take.noisy.channels, noise);
  return take;
}

TEST(SparseFilter, TakesNoiseAwayByEitherSolver) {
  const NoisyTake take = noisy_take(0.02, 0);
  for (const bool exact : {false, true}) {
    SparseSettings settings;
    settings.exact = exact;
    EXPECT_LT(take.error(settings), 0.4 * 0.02);
  }
}

TEST(SparseFilter, ResistsOutliersByTheAbsoluteLoss) {
  const NoisyTake take = noisy_take(0.005, 0.1, 0.4);
  SparseSettings squares, absolute;
  squares.loss = SparseLoss::squares;
  absolute.loss = SparseLoss::absolute;
  EXPECT_LT(take.error(), 0.5 * take.error(squares));
  EXPECT_LT(take.error(absolute), 0.5 * take.error(squares));
}

TEST(SparseFilter, FillsMissingRowsFromTheOthers) {
  NoisyTake take = noisy_take(0.005, 0);
  const double before = take.error();
  for (std::size_t f = 40; f < 50; ++f) {
    for (std::size_t c = 12; c < 15; ++c) {
      take.observed[f * take.noisy.channels + c] = 0;
      take.noisy(f, c) = 0.7;
    }
  }
  EXPECT_LT(take.error(), 1.5 * before);
}

TEST(SparseFilter, SolvesOnlyPoseletsOfWhichAPointIsWanted) {
  const NoisyTake take = noisy_take(0.01, 0, 0.5);
  std::vector<std::uint8_t> wanted(take.prior.points.count(), 0);
  const std::vector<std::int32_t>& chosen = take.prior.poselets[1].points;
  wanted[static_cast<std::size_t>(chosen.front())] = 1;
  const SparseTake all{take.noisy, take.clean, take.observed, take.noise, 60};
  SparseTake some = all;
  some.wanted = wanted;
  const PoseMatrix whole = sparse_filter(take.prior, all), part = sparse_filter(take.prior, some);
  std::size_t solved = 0;
  for (std::size_t p = 0; p < wanted.size(); ++p) {
    const bool is_chosen =
        std::find(chosen.begin(), chosen.end(), static_cast<std::int32_t>(p)) != chosen.end();
    if (part(0, 3 * p) == take.clean(0, 3 * p)) continue;
    ++solved;
    // The whole filter averages a point over all its poselets, so only chosen points are equal.
    if (is_chosen) {
      EXPECT_NEAR(part(0, 3 * p), whole(0, 3 * p), 0.01);
    }
  }
  EXPECT_GE(solved, chosen.size());
  EXPECT_LT(solved, wanted.size());
}

TEST(SparseFilter, TakesATakeOfOneFrame) {
  NoisyTake take = noisy_take(0.01, 0);
  for (PoseMatrix* poses : {&take.clean, &take.noisy}) {
    poses->frames = 1;
    poses->values.resize(poses->channels);
  }
  take.observed.resize(take.noisy.channels);
  EXPECT_LT(take.error(), 0.05);
}

}  // namespace
}  // namespace kinemend
