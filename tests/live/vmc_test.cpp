// Tests of VMC sessions: the output is the input in order with cleaned bones, despite network
// faults.
#include "kinemend/extend/sessions.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <random>

#include "kinemend/error.hpp"
#include "kinemend/live.hpp"
#include "kinemend/methods.hpp"
#include "live/vmc_packets.hpp"
#include "live/vmc_stream.hpp"

namespace kinemend::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double frame_s = 1.0 / 60;
constexpr double degrees = 180 / 3.14159265358979;

class VmcRelay {
 public:
  explicit VmcRelay(const std::string& method = "median", const VmcOptions& options = {},
                    const OptionValues& values = {})
      : cleaner_(make_cleaner(method, values)),
        session(*cleaner_, options,
                [this](std::string_view datagram) { out.emplace_back(datagram); }) {}
  // Sends at a time of the sender's clock, after all timeouts that are due before it.
  void send(const std::string& datagram, double now_s) {
    while (session.due_s() < now_s) session.attend(session.due_s());
    in.push_back(datagram);
    session.receive(datagram, now_s);
  }
  void send_frames(std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f)
      send(vmc_datagram(f, vmc_noisy(f)), frame_s * static_cast<double>(f));
  }

 private:
  std::unique_ptr<Cleaner> cleaner_;

 public:
  VmcSession session;
  std::vector<std::string> in, out;
};

void expect_unchanged_but_for_poses(const VmcRelay& relay) {
  ASSERT_EQ(relay.out.size(), relay.in.size());
  for (std::size_t i = 0; i < relay.in.size(); ++i)
    ASSERT_EQ(without_poses(relay.out[i]), without_poses(relay.in[i])) << i;
}

void expect_no_larger_steps(const VmcRelay& relay, double share = 1) {
  VmcSteps before, after;
  for (const std::string& datagram : relay.in) before.add(datagram);
  for (const std::string& datagram : relay.out) after.add(datagram);
  for (const auto& [name, step] : after.most)
    EXPECT_LE(step, share * before.most[name] + 0.01) << name;
}

double rotation_error_deg(const std::vector<std::string>& datagrams) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t f = 0; f < datagrams.size(); ++f) {
    const VmcBody truth = vmc_truth(f);
    for (const auto& [name, pose] : vmc_poses(datagrams[f])) {
      sum += std::pow(angle_between(truth.at(name).rotation, normalized(pose.rotation)), 2);
      ++count;
    }
  }
  return degrees * std::sqrt(sum / static_cast<double>(count));
}

TEST(VmcSession, ChangesThePosesAlone) {
  VmcRelay relay;
  relay.send_frames(0, 120);
  relay.session.settle();
  expect_unchanged_but_for_poses(relay);
  EXPECT_LT(rotation_error_deg(relay.out), 0.6 * rotation_error_deg(relay.in));
  EXPECT_EQ(relay.session.counts().frames, 120);
  EXPECT_EQ(relay.session.counts().poses, 120 * 20);
  EXPECT_EQ(relay.session.counts().missing, 0);
  EXPECT_EQ(relay.session.counts().made_up, 0);
}

// Repeats the bone table and the stream by hand and compares.
TEST(VmcSession, GivesWhatTheStreamMakesOfTheTake) {
  VmcRelay relay("gaussian");
  relay.send_frames(0, 60);
  const VmcBones bones({});
  std::vector<std::uint8_t> present(bones.count(), 0);
  std::vector<Vec3> offsets(bones.count());
  const VmcBody first = vmc_noisy(0);
  for (const auto& [name, pose] : first) {
    present[static_cast<std::size_t>(bones.find(name))] = 1;
    offsets[static_cast<std::size_t>(bones.find(name))] = pose.position;
  }
  const Take like = bones.take_of(present, offsets, 60);
  const auto cleaner = make_cleaner("gaussian");
  const auto stream = make_stream(*cleaner, like);
  Frame in, out;
  std::size_t given = 0;
  for (std::size_t f = 0; f < 60; ++f) {
    const VmcBody body = vmc_noisy(f);
    in.rotations.clear();
    for (const std::string& name : like.skeleton.names)
      in.rotations.push_back(body.at(name).rotation);
    in.positions = {body.at("root").position, body.at("Hips").position};
    if (!stream->push(in, out)) continue;
    const VmcBody got = vmc_poses(relay.out.at(given++));
    for (std::size_t j = 0; j < like.joint_count(); ++j)
      ASSERT_LT(angle_between(got.at(like.skeleton.names[j]).rotation, out.rotations[j]), 2e-6)
          << j;
    ASSERT_LT(norm(got.at("Hips").position - out.positions[1]), 1e-6);
    ASSERT_LT(norm(got.at("root").position - out.positions[0]), 1e-6);
  }
  EXPECT_EQ(given, relay.out.size());
}

TEST(VmcSession, IsAConstantNumberOfFramesBehind) {
  for (const char* method : {"median", "one-euro"}) {
    VmcRelay relay(method);
    const std::size_t latency = relay.session.latency_frames();
    EXPECT_EQ(latency, std::string(method) == "median" ? 4 : 0);
    for (std::size_t f = 0; f < 100; ++f) {
      relay.send_frames(f, f + 1);
      // The first frame ends only with a pause, because the sender's pattern is not known yet.
      if (f > 0) {
        ASSERT_EQ(relay.out.size(), f + 1 < latency ? 0 : f + 1 - latency) << f;
      }
    }
  }
}

TEST(VmcSession, DoesNotMindHowMessagesAreSpreadOverDatagrams) {
  VmcRelay whole, apart;
  whole.send_frames(0, 60);
  whole.session.settle();
  for (std::size_t f = 0; f < 60; ++f) {
    for (const std::string& message : vmc_messages(f, vmc_noisy(f)))
      apart.send(message, frame_s * static_cast<double>(f));
  }
  apart.session.settle();
  expect_unchanged_but_for_poses(apart);
  std::map<std::string, std::vector<Quat>> first, second;
  for (const std::string& datagram : whole.out) {
    for (const auto& [name, pose] : vmc_poses(datagram)) first[name].push_back(pose.rotation);
  }
  for (const std::string& datagram : apart.out) {
    for (const auto& [name, pose] : vmc_poses(datagram)) second[name].push_back(pose.rotation);
  }
  EXPECT_EQ(first, second);
}

TEST(VmcSession, KeepsGoingThroughLossReorderingAndGarbage) {
  for (const char* method : {"median", "one-euro", "gaussian", "bilateral"}) {
    VmcRelay relay(method);
    std::mt19937 random(7);
    std::vector<std::string> late;
    for (std::size_t f = 0; f < 300; ++f) {
      const double now_s = frame_s * (static_cast<double>(f) + 0.0001 * (random() % 2000));
      const std::vector<std::string> messages = vmc_messages(f, vmc_noisy(f));
      for (std::size_t part = 0; part < messages.size(); part += 6) {
        const std::vector<std::string> some(
            messages.begin() + static_cast<std::ptrdiff_t>(part),
            messages.begin() + static_cast<std::ptrdiff_t>(std::min(part + 6, messages.size())));
        std::string datagram =
            osc_bundle({osc_bundle(some, 3, 4)}, static_cast<std::uint32_t>(f), 2);
        const unsigned fate = random() % 100;
        if (fate < 30) continue;
        if (fate < 35) {
          late.push_back(datagram);
          continue;
        }
        if (fate < 38) {
          const std::size_t size = random() % 90;
          relay.send(std::string(size, static_cast<char>(random())), now_s);
        }
        relay.send(datagram, now_s);
        for (const std::string& old : late) relay.send(old, now_s);
        late.clear();
      }
      ASSERT_LT(relay.session.waiting_bytes(), 100000);
    }
    relay.session.settle();
    expect_unchanged_but_for_poses(relay);
    SCOPED_TRACE(method);
    // Noise may make the motion's step across a gap smaller; an averaging method restores it.
    const bool averages = method == std::string("gaussian") || method == std::string("bilateral");
    expect_no_larger_steps(relay, averages ? 1.25 : 1);
    EXPECT_GT(relay.session.counts().missing, 500) << method;
    EXPECT_GT(relay.session.counts().not_osc, 20);
    EXPECT_LE(relay.session.counts().settled, 1);
  }
}

TEST(VmcSession, FillsFramesThatWereLostAndStaysAsFarBehind) {
  VmcRelay relay("gaussian");
  std::mt19937 random(3);
  std::size_t sent = 0;
  for (std::size_t f = 0; f < 300; ++f) {
    if (random() % 10 < 3) continue;
    relay.send_frames(f, f + 1);
    ++sent;
    ASSERT_LE(relay.in.size() - relay.out.size(), relay.session.latency_frames() + 1);
  }
  EXPECT_NEAR(static_cast<double>(relay.session.counts().made_up),
              300.0 - static_cast<double>(sent), 6);
  relay.session.settle();
  // Across a long loss, body motion dominates the noise, which may shorten the step.
  expect_no_larger_steps(relay, 1.1);
}

TEST(VmcSession, LetsAFaceGoOnWhileTheBodyRests) {
  VmcRelay relay;
  relay.send_frames(0, 30);
  const auto face = [](std::size_t i) {
    return osc_message("/VMC/Ext/Blend/Val", "sf", osc_text("A") + osc_real(static_cast<float>(i)));
  };
  for (std::size_t i = 0; i < 60; ++i) relay.send(face(i), 0.5 + frame_s * static_cast<double>(i));
  EXPECT_EQ(relay.out.size(), relay.in.size());
  EXPECT_EQ(relay.session.counts().settled, 1);
  relay.send_frames(120, 180);
  relay.session.settle();
  expect_unchanged_but_for_poses(relay);
}

TEST(VmcSession, PassesADatagramWithoutMotionAtOnceBeforeThereIsAny) {
  VmcRelay relay;
  relay.send(osc_message("/VMC/Ext/OK", "i", osc_number(1)), 0);
  relay.send("garbage", 0);
  relay.send("", 0);
  EXPECT_EQ(relay.out, relay.in);
  EXPECT_EQ(relay.session.counts().not_osc, 2);
}

TEST(VmcSession, TakesUpABoneThatAppearsLaterWithoutATrace) {
  const auto without_head = [](std::size_t f) {
    VmcBody body = vmc_noisy(f);
    body.erase("Head");
    return body;
  };
  VmcRelay grown, never;
  for (std::size_t f = 0; f < 90; ++f) {
    const double now_s = frame_s * static_cast<double>(f);
    grown.send(vmc_datagram(f, f < 40 ? without_head(f) : vmc_noisy(f)), now_s);
    never.send(vmc_datagram(f, without_head(f)), now_s);
    if (f > 1) {
      ASSERT_EQ(grown.out.size(), never.out.size()) << f;
    }
  }
  for (std::size_t i = 0; i < grown.out.size(); ++i) {
    VmcBody left = vmc_poses(grown.out[i]), right = vmc_poses(never.out[i]);
    left.erase("Head");
    ASSERT_EQ(left.size(), right.size());
    for (const auto& [name, pose] : left)
      ASSERT_LT(angle_between(pose.rotation, right.at(name).rotation), 1e-6) << name << i;
  }
}

TEST(VmcSession, ForgetsABoneThatNoLongerComes) {
  VmcRelay relay("one-euro");
  relay.send_frames(0, 10);
  for (std::size_t f = 10; f < 200; ++f) {
    VmcBody body = vmc_noisy(f);
    body.erase("LeftHand");
    relay.send(vmc_datagram(f, body), frame_s * static_cast<double>(f));
  }
  EXPECT_EQ(relay.session.counts().missing, 60);
  EXPECT_EQ(relay.out.size(), relay.in.size());
}

TEST(VmcSession, ReplacesPosesThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  VmcRelay relay;
  for (std::size_t f = 0; f < 60; ++f) {
    VmcBody body = vmc_noisy(f, 0.1);
    if (f == 30) body["Head"].rotation = {0, 0, 0, 0};
    if (f == 31) body["Neck"].rotation.x = nan;
    if (f == 32) body["Hips"].position.y = std::numeric_limits<double>::infinity();
    if (f == 33) body["Spine"].position.y = nan;
    relay.send(vmc_datagram(f, body), frame_s * static_cast<double>(f));
  }
  relay.session.settle();
  EXPECT_EQ(relay.session.counts().not_finite, 4);
  for (std::size_t f = 0; f < 60; ++f) {
    for (const auto& [name, pose] : vmc_poses(relay.out.at(f))) {
      ASSERT_LT(angle_between(normalized(pose.rotation), vmc_truth(f).at(name).rotation), 0.08)
          << name << f;
      ASSERT_LT(norm(pose.position - vmc_truth(f).at(name).position), 0.03) << name << f;
    }
  }
}

TEST(VmcSession, PassesAPoseThatIsNoneBeforeThereIsAGoodOne) {
  VmcRelay relay;
  VmcBody body = vmc_noisy(0);
  body["Head"].rotation = {0, 0, 0, 0};
  for (std::size_t f = 0; f < 20; ++f)
    relay.send(vmc_datagram(f, body), frame_s * static_cast<double>(f));
  relay.session.settle();
  EXPECT_EQ(vmc_poses(relay.out.back()).at("Head").rotation, (Quat{0, 0, 0, 0}));
  expect_unchanged_but_for_poses(relay);
}

TEST(VmcSession, CleansTheChosenBonesOnly) {
  VmcOptions options;
  options.bones = {"head", "Tail"};
  VmcRelay relay("median", options);
  for (std::size_t f = 0; f < 60; ++f) {
    std::vector<std::string> messages = vmc_messages(f, vmc_noisy(f));
    messages.push_back(vmc_bone("Tail", vmc_noisy(f).at("Neck")));
    messages.push_back(vmc_bone("Wing", vmc_noisy(f).at("Neck")));
    relay.send(osc_bundle(messages), frame_s * static_cast<double>(f));
  }
  relay.session.settle();
  std::map<std::string, int> changed;
  for (std::size_t i = 0; i < relay.in.size(); ++i) {
    const VmcBody before = vmc_poses(relay.in[i]);
    for (const auto& [name, pose] : vmc_poses(relay.out[i]))
      changed[name] +=
          pose.rotation != before.at(name).rotation || pose.position != before.at(name).position
              ? 1
              : 0;
  }
  for (const auto& [name, count] : changed)
    EXPECT_EQ(count > 50, name == "Head" || name == "Tail") << name;
  EXPECT_EQ(changed["Wing"], 0);
  EXPECT_EQ(relay.session.counts().other_bones, 60);
  EXPECT_THAT(relay.session.take_notes(),
              ElementsAre(HasSubstr("bone Wing is not in Unity's humanoid")));
}

TEST(VmcSession, FollowsChangesOfTheRateAndARestart) {
  for (const char* method : {"median", "one-euro", "gaussian"}) {
    VmcRelay relay(method);
    double now_s = 0;
    std::size_t f = 0;
    for (const double rate_hz : {60.0, 30.0, 90.0, 24.0, 240.0, 60.0}) {
      for (int i = 0; i < 200; ++i, ++f) {
        relay.send(vmc_datagram(f, vmc_noisy(f)), now_s);
        now_s += 1 / rate_hz;
        if (i > 5) {
          ASSERT_LE(relay.in.size() - relay.out.size(), relay.session.latency_frames() + 1);
        }
      }
    }
    // The sender restarts with its first frames.
    for (f = 0; f < 100; ++f) relay.send(vmc_datagram(f, vmc_noisy(f)), now_s += frame_s);
    relay.session.settle();
    expect_unchanged_but_for_poses(relay);
    expect_no_larger_steps(relay);
    EXPECT_THAT(
        relay.session.take_notes(),
        testing::Contains(HasSubstr("30 frames per second arrive, and 60 are expected (--fps)")));
  }
}

TEST(VmcSession, HoldsABoundedNumberOfBytes) {
  VmcOptions options;
  options.most_waiting_bytes = 100000;
  VmcRelay relay("median", options);
  relay.send_frames(0, 20);
  std::size_t most = 0;
  // The time does not advance, and one bone arrives without the others.
  const std::string face = osc_message("/face", "s", osc_text(std::string(5000, 'x')));
  for (std::size_t i = 0; i < 2000; ++i) {
    relay.send(i % 50 == 0 ? vmc_bone("Head", vmc_noisy(i).at("Head")) : face, 1);
    most = std::max(most, relay.session.waiting_bytes());
  }
  EXPECT_LE(most, 105100);
  relay.session.settle();
  expect_unchanged_but_for_poses(relay);
  EXPECT_EQ(relay.session.waiting_bytes(), 0);
}

TEST(VmcSession, GivesBackAsManyDatagramsAsCameWhateverTheirBytes) {
  std::mt19937 random(11);
  VmcRelay relay;
  double now_s = 0;
  for (std::size_t f = 0; f < 3000; ++f) {
    std::string datagram = vmc_datagram(f % 100, vmc_noisy(f % 100));
    for (unsigned change = random() % 12; change > 0; --change)
      datagram[random() % datagram.size()] = static_cast<char>(random());
    if (random() % 4 == 0) datagram.resize(random() % datagram.size() / 4 * 4);
    relay.send(datagram, now_s += 0.001 * (random() % 40));
  }
  relay.session.settle();
  ASSERT_EQ(relay.out.size(), relay.in.size());
  for (std::size_t i = 0; i < relay.in.size(); ++i)
    ASSERT_EQ(relay.out[i].size(), relay.in[i].size());
}

TEST(VmcSession, BlendsWithTheStrength) {
  VmcOptions options;
  options.strength = 0;
  VmcRelay relay("median", options);
  relay.send_frames(0, 40);
  relay.session.settle();
  EXPECT_EQ(relay.out, relay.in);
  EXPECT_EQ(relay.session.counts().cleaned, 0);
}

TEST(VmcSession, KeepsTheBytesOfWhatAMethodDoesNotChange) {
  VmcRelay relay("hampel");
  for (std::size_t f = 0; f < 40; ++f)
    relay.send(vmc_datagram(f, vmc_truth(f)), frame_s * static_cast<double>(f));
  relay.session.settle();
  EXPECT_EQ(relay.out, relay.in);
}

TEST(VmcSession, KeepsTheSignOfEachQuaternion) {
  VmcRelay relay("gaussian");
  std::mt19937 random(2);
  for (std::size_t f = 0; f < 40; ++f) {
    VmcBody body = vmc_noisy(f);
    for (auto& [name, pose] : body)
      pose.rotation = random() % 2 == 0 ? -pose.rotation : pose.rotation;
    relay.send(vmc_datagram(f, body), frame_s * static_cast<double>(f));
  }
  relay.session.settle();
  for (std::size_t f = 0; f < 40; ++f) {
    const VmcBody before = vmc_poses(relay.in[f]);
    for (const auto& [name, pose] : vmc_poses(relay.out[f]))
      ASSERT_GT(dot(pose.rotation, before.at(name).rotation), 0.9) << name << f;
  }
}

TEST(VmcSession, TellsTheNoiseOfEachBone) {
  VmcRelay relay("gaussian");
  relay.send_frames(0, 120);
  const std::vector<TrackChange> noise = relay.session.changes();
  EXPECT_EQ(noise.size(), 20);
  for (const TrackChange& bone : noise) {
    EXPECT_GT(bone.rms, 1) << bone.name;
    EXPECT_LT(bone.rms, 4) << bone.name;
  }
}

TEST(VmcSession, HoldsAFootThatStands) {
  // The body drifts by 6 cm per second over feet that do not turn.
  const auto at = [](std::size_t f) {
    VmcBody body;
    body["root"] = {{0, 0, 0}, {1, 0, 0, 0}};
    body["Hips"] = {{0.001 * static_cast<double>(f), 0.9, 0}, {1, 0, 0, 0}};
    body["Head"] = {{0, 0.7, 0}, {1, 0, 0, 0}};
    for (const double side : {-1.0, 1.0}) {
      const std::string name = side < 0 ? "Left" : "Right";
      body[name + "UpperLeg"] = {{0.1 * side, 0, 0}, exp(Vec3{-0.2, 0, 0})};
      body[name + "LowerLeg"] = {{0, -0.42, 0}, exp(Vec3{0.4, 0, 0})};
      body[name + "Foot"] = {{0, -0.42, 0}, exp(Vec3{-0.2, 0, 0})};
      body[name + "Toes"] = {{0, -0.06, 0.12}, {1, 0, 0, 0}};
    }
    return body;
  };
  const auto foot_x = [](const VmcBody& b) {
    const Quat upper = b.at("LeftUpperLeg").rotation;
    return b.at("Hips").position.x +
           rotate(upper,
                  Vec3{0, -0.42, 0} + rotate(b.at("LeftLowerLeg").rotation, Vec3{0, -0.42, 0}))
               .x;
  };
  for (const bool feet : {false, true}) {
    VmcOptions options;
    options.feet = feet;
    VmcRelay relay("one-euro", options);
    std::vector<double> xs;
    for (std::size_t f = 0; f < 60; ++f) {
      std::vector<std::string> messages = {vmc_root(at(f).at("root"))};
      for (const auto& [name, pose] : at(f)) {
        if (name != "root") messages.push_back(vmc_bone(name, pose));
      }
      relay.send(osc_bundle(messages), frame_s * static_cast<double>(f));
    }
    relay.session.settle();
    for (const std::string& datagram : relay.out) xs.push_back(foot_x(vmc_poses(datagram)));
    const double slide = xs[50] - xs[20];
    if (feet) {
      EXPECT_LT(slide, 0.001);
    } else {
      EXPECT_GT(slide, 0.02);
    }
  }
}

TEST(VmcSession, RunsWithTheLearnedMethod) {
  VmcRelay relay("learned", {}, {{"live", true}});
  relay.send_frames(0, 150);
  relay.session.settle();
  expect_unchanged_but_for_poses(relay);
  EXPECT_LT(rotation_error_deg(relay.out), 0.8 * rotation_error_deg(relay.in));
}

TEST(VmcSession, RefusesOptionsOutOfRangeAndMethodsThatNeedTheWholeTake) {
  const auto cleaner = make_cleaner("median");
  for (const double rate_hz : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    VmcOptions options;
    options.frame_rate_hz = rate_hz;
    EXPECT_THROW(VmcSession(*cleaner, options, [](std::string_view) {}), Error);
  }
  const auto whole = make_cleaner("auto");
  EXPECT_THROW(VmcSession(*whole, {}, [](std::string_view) {}), Error);
}

TEST(VmcBones, AreThoseOfUnitysHumanoidAndHangOnTheNearestThatIsThere) {
  const VmcBones bones({"Tail", "HEAD"});
  EXPECT_EQ(bones.count(), 1 + 55 + 1);
  EXPECT_EQ(bones.find("rightLittleDistal"), 55);
  EXPECT_EQ(bones.find("tail"), 56);
  EXPECT_EQ(bones.find("Wing"), -1);
  std::vector<std::uint8_t> present(bones.count(), 0);
  for (const char* name : {"Hips", "Head", "LeftHand"})
    present[static_cast<std::size_t>(bones.find(name))] = 1;
  const Take take = bones.take_of(present, std::vector<Vec3>(bones.count()), 60);
  EXPECT_THAT(take.skeleton.names, ElementsAre("root", "Hips", "Head", "LeftHand"));
  EXPECT_THAT(take.skeleton.parents, ElementsAre(-1, 0, 1, 1));
  EXPECT_THAT(take.translated_joints, ElementsAre(1));
  EXPECT_NO_THROW(take.validate());
}

}  // namespace
}  // namespace kinemend::test
