// Tests of `kinemend train`: models of every method are trained, shown and used for cleaning.
#include <signal.h>

#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class Train : public Program {
 protected:
  /// Writes a.bvh and b.bvh: clean walks.
  void walks() {
    synth("a.bvh", "walk", "3");
    synth("b.bvh", "stroll", "3");
  }
  /// Writes m.kmodel of a method that trains quickly.
  void model(const std::string& method = "kalman-learned") {
    walks();
    const Ran ran = run({"train", method, "a.bvh", "b.bvh", "-o", "m.kmodel"});
    ASSERT_EQ(ran.code, 0) << ran.err;
  }
};

TEST_F(Train, EveryMethodWritesAModelAndSaysWhatItLearned) {
  walks();
  for (const std::string method : {"example", "wiener", "sparse", "kalman-learned"}) {
    const Ran ran = run({"train", method, "a.bvh", "b.bvh", "-o", method + ".kmodel"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
    EXPECT_THAT(ran.out, StartsWith(method + ".kmodel: " + method + " of "));
    EXPECT_THAT(ran.out, HasSubstr("joints"));
    EXPECT_THAT(ran.out, HasSubstr("from 2 takes (0.1 min) in "));
    EXPECT_TRUE(fs::exists(folder / (method + ".kmodel")));
  }
}

TEST_F(Train, TheSameTakesGiveTheSameBytesWhateverTheThreads) {
  walks();
  for (const std::string method : {"example", "wiener", "sparse"}) {
    ASSERT_EQ(
        run({"train", method, "a.bvh", "b.bvh", "-o", "one", "--jobs", "1", "-q", "--force"}).code,
        0);
    const std::string one = contents(folder / "one");
    const Ran again =
        run({"train", method, "a.bvh", "b.bvh", "-o", "one", "--jobs", "4", "-q", "--force"});
    ASSERT_EQ(again.code, 0);
    EXPECT_EQ(again.out, "");
    EXPECT_EQ(contents(folder / "one"), one);
  }
}

TEST_F(Train, TellsProgramsWhatItLearned) {
  walks();
  const Ran ran = run({"train", "kalman-learned", "a.bvh", "b.bvh", "-o", "m.kmodel", "--json",
                       "--title", "Walks", "--data", "made up", "--licence", "CC0"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json json = Json::parse(ran.out);
  EXPECT_EQ(json["output"], "m.kmodel");
  EXPECT_EQ(json["method"], "kalman-learned");
  EXPECT_EQ(json["takes"], 2);
  EXPECT_NEAR(json["seconds"], 6, 0.3);
  EXPECT_EQ(json["body"], "joints");
  EXPECT_EQ(json["channel_count"], 3 * json["parts"].size() + 3);
  EXPECT_EQ(json["bytes"], fs::file_size(folder / "m.kmodel"));
  EXPECT_EQ(json["title"], "Walks");
  EXPECT_EQ(json["command"], "kinemend train --output m.kmodel kalman-learned a.bvh b.bvh");
  EXPECT_FALSE(json["numbers"].empty());

  Json info = Json::parse(run({"info", "m.kmodel", "--json"}).out)["takes"][0];
  EXPECT_EQ(info["input"], "m.kmodel");
  info.erase("input");
  for (const auto& [key, value] : info.items()) EXPECT_EQ(json[key], value) << key;
}

TEST_F(Train, InfoShowsTheCardAndTheBody) {
  walks();
  ASSERT_EQ(run({"train", "kalman-learned", "a.bvh", "-o", "m.kmodel", "--licence", "CC0 1.0",
                 "--title", "One walk", "--data", "made | up", "--card", "m.md"})
                .code,
            0);
  const Ran info = run({"info", "m.kmodel", "--tree"});
  EXPECT_THAT(info.out, StartsWith("m.kmodel: One walk\n"));
  EXPECT_THAT(info.out, HasSubstr("CC0 1.0"));
  EXPECT_THAT(info.out, HasSubstr("1 take, 0.1 min"));
  EXPECT_THAT(info.out, HasSubstr("LeftArm"));
  const std::string card = contents(folder / "m.md");
  EXPECT_THAT(card, StartsWith("# One walk\n"));
  EXPECT_THAT(card, HasSubstr("| licence | CC0 1.0 |"));
  EXPECT_THAT(card, HasSubstr("| data | made \\| up |"));
  EXPECT_THAT(card, HasSubstr("`kinemend train --output m.kmodel kalman-learned a.bvh`"));
  const Json json = Json::parse(run({"info", "m.kmodel", "--json"}).out)["takes"][0];
  EXPECT_THAT(card, HasSubstr(json["checksum"].get<std::string>()));
}

TEST_F(Train, TakesComeFromFoldersAndLists) {
  fs::create_directories(folder / "takes/deep");
  synth("takes/deep/a.bvh", "walk", "3");
  synth("takes/b.bvh", "walk", "3");
  synth("c.bvh", "walk", "3");
  put(folder / "takes/notes.txt", "no take");
  put(folder / "list.txt", "# more\nc.bvh\n\n");
  const Ran ran =
      run({"train", "kalman-learned", "takes", "--list", "list.txt", "-o", "m.kmodel", "--json"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(Json::parse(ran.out)["takes"], 3);
  const Ran one_by_one = run({"train", "kalman-learned", "takes/b.bvh", "takes/deep/a.bvh", "c.bvh",
                              "-o", "n.kmodel", "--json"});
  EXPECT_EQ(Json::parse(one_by_one.out)["numbers"], Json::parse(ran.out)["numbers"]);
}

TEST_F(Train, ATakeThatCannotBeReadEndsItUnlessItMayBeLeftOut) {
  walks();
  put(folder / "bad.bvh", "HIERARCHY\nROOT");
  const std::vector<std::string> words = {"train", "kalman-learned", "a.bvh", "bad.bvh", "b.bvh",
                                          "-o",    "m.kmodel"};
  const Ran refused = run(words);
  EXPECT_EQ(refused.code, 3);
  EXPECT_THAT(refused.err, IsOneLine());
  EXPECT_THAT(refused.err, HasSubstr("bad.bvh:2: "));
  EXPECT_FALSE(fs::exists(folder / "m.kmodel"));

  auto skipping = words;
  skipping.insert(skipping.end(), {"--skip-unreadable", "--json"});
  const Ran ran = run(skipping);
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.err, HasSubstr("bad.bvh:2: "));
  EXPECT_THAT(ran.err, HasSubstr("(skipped)"));
  EXPECT_EQ(Json::parse(ran.out)["takes"], 2);
}

TEST_F(Train, ATakeMayComeOverStandardInput) {
  walks();
  const std::vector<std::string> words = {"train",     "wiener", "-o",     "m.kmodel",
                                          "--command", "x",      "--force"};
  const auto bytes = [&](const std::string& take, const std::string& input) {
    std::vector<std::string> all = words;
    all.push_back(take);
    Setting setting;
    setting.in = input;
    const Ran ran = run(all, setting);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return contents(folder / "m.kmodel");
  };
  EXPECT_EQ(bytes("-", contents(folder / "a.bvh")), bytes("a.bvh", ""));
}

TEST_F(Train, RefusesWhatMakesNoSense) {
  walks();
  const auto message = [&](std::vector<std::string> words, int code = 2) {
    words.insert(words.begin(), "train");
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, code) << ran.err;
    EXPECT_THAT(ran.err, IsOneLine());
    return ran.err;
  };
  EXPECT_THAT(message({}), HasSubstr("METHOD is missing"));
  EXPECT_THAT(message({"exampel", "a.bvh", "-o", "m"}), HasSubstr("did you mean example?"));
  EXPECT_THAT(message({"example", "a.bvh"}), HasSubstr("--output is missing"));
  EXPECT_THAT(message({"example", "-o", "m"}), HasSubstr("TAKE or --list is missing"));
  EXPECT_THAT(message({"example", "-", "-", "-o", "m"}), HasSubstr("only once"));
  EXPECT_THAT(message({"example", "-", "--list", "-", "-o", "m"}), HasSubstr("only once"));
  EXPECT_THAT(message({"example", "a.bvh", "-o", "m", "--ridge", "0.1"}),
              HasSubstr("--ridge is an option of kalman-learned, not of example"));
  EXPECT_THAT(message({"example", "a.bvh", "-o", "m", "--window-s", "0"}),
              HasSubstr("--window-s: 0 is outside"));
  EXPECT_THAT(message({"example", "a.bvh", "-o", "m", "--joints", "Tail"}), HasSubstr("Tail"));
  EXPECT_THAT(message({"example", "none.bvh", "-o", "m"}, 3), HasSubstr("none.bvh"));
  put(folder / "m", "mine");
  EXPECT_THAT(message({"example", "a.bvh", "-o", "m"}, 4), HasSubstr("exists already"));
  EXPECT_EQ(contents(folder / "m"), "mine");
}

TEST_F(Train, LearnsTheJointsAskedFor) {
  walks();
  const Ran ran = run({"train", "kalman-learned", "a.bvh", "-o", "m.kmodel", "--json", "--joints",
                       "Hips,Left*Leg,LeftUpLeg"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json parts = Json::parse(ran.out)["parts"];
  for (const Json& part : parts) {
    const std::string name = part;
    EXPECT_TRUE(name == "Hips" || name.rfind("Left", 0) == 0) << name;
  }
  EXPECT_LT(parts.size(), 5u);
}

TEST_F(Train, ItsModelsCleanAndTheirFilesMayBeNamedAnywhere) {
  model();
  noisy("noisy.bvh");
  const Ran by_flag = run({"clean", "noisy.bvh", "-o", "flag.bvh", "--method", "kalman-learned",
                           "--model", "m.kmodel", "--json"});
  ASSERT_EQ(by_flag.code, 0) << by_flag.err;
  EXPECT_EQ(Json::parse(by_flag.out)["takes"][0]["options"]["model"], "m.kmodel");
  put(folder / "c.toml", "method = \"kalman-learned\"\n[kalman-learned]\nmodel = \"m.kmodel\"\n");
  const Ran by_file = run({"clean", "noisy.bvh", "-o", "file.bvh", "--config", "c.toml"});
  ASSERT_EQ(by_file.code, 0) << by_file.err;
  EXPECT_EQ(contents(folder / "flag.bvh"), contents(folder / "file.bvh"));
  EXPECT_NE(contents(folder / "flag.bvh"), contents(folder / "noisy.bvh"));

  const Ran printed =
      run({"clean", "--method", "kalman-learned", "--model", "m.kmodel", "--print-config"});
  EXPECT_THAT(printed.out, HasSubstr("model = \"m.kmodel\""));
  EXPECT_THAT(run({"help", "kalman-learned"}).out, Not(HasSubstr("--model TEXT")));
  EXPECT_THAT(run({"help", "kalman-learned"}).out, HasSubstr("--model FILE"));
}

TEST_F(Train, SaysWhatIsWrongWithAModel) {
  model();
  const auto message = [&](const std::vector<std::string>& more, int code) {
    std::vector<std::string> words = {"clean", "a.bvh", "-o", "out.bvh"};
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, code);
    EXPECT_THAT(ran.err, IsOneLine());
    return ran.err;
  };
  EXPECT_THAT(message({"--method", "kalman-learned"}, 2),
              HasSubstr("method kalman-learned needs a model: --model FILE, made by kinemend "
                        "train kalman-learned"));
  EXPECT_THAT(message({"--method", "kalman-learned", "--model", "none.kmodel"}, 3),
              HasSubstr("none.kmodel"));
  EXPECT_THAT(message({"--method", "kalman-learned", "--model", "a.bvh"}, 3),
              HasSubstr("a.bvh: byte 0"));
  EXPECT_THAT(message({"--method", "example", "--model", "m.kmodel"}, 2),
              HasSubstr("expected a model of method example, found one of kalman-learned"));
  put(folder / "cut.kmodel", contents(folder / "m.kmodel").substr(0, 3000));
  EXPECT_THAT(message({"--method", "kalman-learned", "--model", "cut.kmodel"}, 3),
              HasSubstr("cut.kmodel: byte "));
}

TEST_F(Train, ABatchNoticesAnotherModel) {
  model();
  fs::create_directories(folder / "raw");
  noisy("raw/n.bvh", "1");
  const std::vector<std::string> words = {
      "batch", "raw", "-o", "clean", "--method", "kalman-learned", "--model", "m.kmodel"};
  ASSERT_EQ(run(words).code, 0);
  EXPECT_THAT(run(words).out, HasSubstr("0 cleaned"));
  const std::string before = contents(folder / "clean/n.bvh");
  ASSERT_EQ(run({"train", "kalman-learned", "b.bvh", "-o", "m.kmodel", "--force"}).code, 0);
  EXPECT_THAT(run(words).out, HasSubstr("1 cleaned"));
  EXPECT_NE(contents(folder / "clean/n.bvh"), before);
}

TEST_F(Train, AMapStartsFromWhatIsKnown) {
  model();
  put(folder / "hand.bvh", hand_take());
  const Ran same = run({"models", "--map", "m.kmodel", "a.bvh"});
  ASSERT_EQ(same.code, 0) << same.err;
  EXPECT_THAT(same.out, HasSubstr("LeftArm,LeftArm\n"));
  const Ran hand = run({"models", "--map", "m.kmodel", "hand.bvh", "-o", "map.csv"});
  ASSERT_EQ(hand.code, 0) << hand.err;
  EXPECT_EQ(hand.out, "");
  EXPECT_THAT(contents(folder / "map.csv"), HasSubstr("LeftFinger1"));
  put(folder / "same.csv", same.out);
  noisy("noisy.bvh");
  const Ran with = run({"clean", "noisy.bvh", "-o", "with.bvh", "--method", "kalman-learned",
                        "--model", "m.kmodel", "--map", "same.csv"});
  ASSERT_EQ(with.code, 0) << with.err;
  ASSERT_EQ(run({"clean", "noisy.bvh", "-o", "without.bvh", "--method", "kalman-learned", "--model",
                 "m.kmodel"})
                .code,
            0);
  EXPECT_EQ(contents(folder / "with.bvh"), contents(folder / "without.bvh"));
}

TEST_F(Train, WhatShipsIsListedAndExported) {
  const Json list = Json::parse(run({"models", "--json"}).out)["models"];
  const std::string text = run({"models"}).out;
  for (const Json& shipped : list) {
    const std::string method = shipped["method"];
    EXPECT_THAT(text, HasSubstr(shipped["checksum"].get<std::string>()));
    ASSERT_EQ(run({"models", "--export", method, "-o", method + ".kmodel"}).code, 0);
    const Json info = Json::parse(run({"info", method + ".kmodel", "--json"}).out)["takes"][0];
    EXPECT_EQ(info["checksum"], shipped["checksum"]);
  }
  EXPECT_EQ(list.empty(), text == "no model ships with this program\n");
  const Ran unknown = run({"models", "--export", "kalman-learned", "-o", "k.kmodel"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("no model ships for kalman-learned"));
  EXPECT_EQ(run({"models", "a.bvh"}).code, 2);
  EXPECT_EQ(run({"models", "--map", "m.kmodel"}).code, 2);
}

TEST_F(Train, AModelWithAFlippedByteIsRefusedByItsChecksum) {
  noisy("a.bvh", "2");
  ASSERT_EQ(run({"train", "wiener", "truth.bvh", "-o", "walk.kmodel"}).code, 0);
  std::string bytes = contents(folder / "walk.kmodel");
  // The flipped bit still leaves a valid number.
  bytes[bytes.size() - 11] = static_cast<char>(bytes[bytes.size() - 11] ^ 0x01);
  put(folder / "flipped.kmodel", bytes);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"info", "flipped.kmodel"},
        {"clean", "a.bvh", "-m", "wiener", "--model", "flipped.kmodel", "--dry-run"},
        {"models", "--map", "flipped.kmodel", "a.bvh"}}) {
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, 3) << words[0];
    EXPECT_THAT(ran.err, HasSubstr("flipped.kmodel: the file is damaged: its checksum is "));
  }
}

TEST_F(Train, ShippedModelsBearChecksums) {
  for (const char* method : {"example", "wiener", "sparse"}) {
    const std::string name = std::string(method) + ".kmodel";
    ASSERT_EQ(run({"models", "--export", method, "-o", name}).code, 0);
    std::string bytes = contents(folder / name);
    bytes[bytes.size() - 11] = static_cast<char>(bytes[bytes.size() - 11] ^ 0x01);
    put(folder / "flipped.kmodel", bytes);
    EXPECT_THAT(run({"info", "flipped.kmodel"}).err, HasSubstr("the file is damaged")) << method;
  }
}

// Training interrupted by Ctrl-C as soon as it can be resumed.
class BrokenOffTraining : public Train {
 protected:
  const std::vector<std::string> words = {"train", "sparse",   "a.bvh",        "b.bvh",
                                          "-o",    "m.kmodel", "--iterations", "100",
                                          "-q",    "--title",  "Two walks"};

  Ran broken_off() {
    const fs::path said = folder / "said";
    const pid_t child = fork();
    if (child == 0) {
      const int file = open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
      if (file < 0 || dup2(file, STDERR_FILENO) < 0) _exit(126);
      execute(words, {});
    }
    while (!fs::exists(folder / "m.kmodel.checkpoint") && kill(child, 0) == 0 &&
           waitpid(child, nullptr, WNOHANG) == 0)
      usleep(5000);
    kill(child, SIGINT);
    Ran ran = wait_for(child);
    ran.err = contents(said);
    fs::remove(said);
    return ran;
  }
};

TEST_F(BrokenOffTraining, LeavesACheckpointFromWhichTheSameModelComes) {
  walks();
  const Ran broken = broken_off();
  EXPECT_EQ(broken.code, 128 + SIGINT);
  EXPECT_EQ(broken.err,
            "stopped; the work so far is in m.kmodel.checkpoint; to continue:\n"
            "  kinemend train sparse a.bvh b.bvh -o m.kmodel --iterations 100 -q --title "
            "'Two walks' --resume\n");
  EXPECT_THAT(files(), ElementsAre("a.bvh", "b.bvh", "m.kmodel.checkpoint"));

  const Ran anew = run(words);
  EXPECT_EQ(anew.code, 4);
  EXPECT_EQ(anew.err,
            "kinemend: m.kmodel.checkpoint: left by an unfinished training; --resume "
            "continues it, --force starts anew\n");

  std::vector<std::string> others = words;
  others[7] = "101";
  others.emplace_back("--resume");
  const Ran refused = run(others);
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("m.kmodel.checkpoint: is of another training: iterations was "
                                     "100, and is 101"));

  std::vector<std::string> on = words;
  on.emplace_back("--resume");
  const Ran resumed = run(on);
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  const std::string model = contents(folder / "m.kmodel");
  EXPECT_THAT(files(), ElementsAre("a.bvh", "b.bvh", "m.kmodel"));
  std::vector<std::string> whole = words;
  whole.emplace_back("--force");
  ASSERT_EQ(run(whole).code, 0);
  EXPECT_TRUE(contents(folder / "m.kmodel") == model);
}

TEST_F(Train, SaysWhereThereIsNoCheckpointToGoOnFrom) {
  walks();
  const Ran ran = run({"train", "sparse", "a.bvh", "-o", "m.kmodel", "--resume"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_EQ(ran.err,
            "kinemend: m.kmodel.checkpoint: no such checkpoint; leave out --resume to "
            "start the training anew\n");
  EXPECT_EQ(run({"train", "sparse", "a.bvh", "-o", "-", "--resume"}).code, 2);
  put(folder / "m.kmodel.checkpoint", "nonsense");
  const Ran damaged = run({"train", "sparse", "a.bvh", "-o", "m.kmodel", "--resume"});
  EXPECT_EQ(damaged.code, 3);
  EXPECT_THAT(damaged.err, HasSubstr("m.kmodel.checkpoint: is damaged, or no checkpoint"));
  EXPECT_EQ(contents(folder / "m.kmodel.checkpoint"), "nonsense");
}

}  // namespace
}  // namespace kinemend::test
