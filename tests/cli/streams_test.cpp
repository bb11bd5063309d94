// Tests of the standard streams: pipes, closed pipes and terminals.
#include <pty.h>

#include <cstring>

#include "cli/program.hpp"
#include "long_tests.hpp"

namespace kinemend::test {
namespace {

using Streams = Program;
using testing::HasSubstr;
using testing::Not;

/// Runs the program with a terminal as all of its standard streams.
class Terminal : public Program {
 protected:
  std::string run_on_terminal(const std::vector<std::string>& words, const Setting& setting = {}) {
    int master = -1;
    const pid_t child = forkpty(&master, nullptr, nullptr, nullptr);
    if (child == 0) execute(words, setting);
    std::string text;
    char buffer[4096];
    for (ssize_t count = 1; count > 0;) {
      count = read(master, buffer, sizeof buffer);
      if (count > 0) text.append(buffer, static_cast<std::size_t>(count));
    }
    close(master);
    code = wait_for(child).code;
    return text;
  }
  int code = -1;
};

/// Runs the program with some of the descriptors 0 to 2 closed, as by `<&- >&-`.
class ClosedStreams : public Program {
 protected:
  int run_without(const std::vector<int>& streams, const std::vector<std::string>& words) {
    const pid_t child = fork();
    if (child == 0) {
      const int null = open("/dev/null", O_RDWR);
      for (const int stream : {0, 1, 2}) dup2(null, stream);
      close(null);
      for (const int stream : streams) close(stream);
      execute(words, {});
    }
    return wait_for(child).code;
  }
};

TEST_F(ClosedStreams, NeverEndUpInTheTake) {
  KINEMEND_LONG_WHEN_SANITIZED();
  noisy("walk.bvh");
  const std::vector<std::vector<std::string>> commands = {
      {"clean", "walk.bvh", "-o", "out.bvh", "--force"},
      {"fill", "walk.bvh", "-o", "out.bvh", "--force"},
      {"corrupt", "walk.bvh", "-o", "out.bvh", "--damage", "gaussian", "--force"},
      {"convert", "walk.bvh", "-o", "out.bvh", "--plain", "--force"},
      {"clean", "out.bvh", "-o", "out.bvh", "-m", "butterworth", "--force"},
      {"clean", "no.bvh", "-o", "out.bvh", "--force"}};
  for (const auto& words : commands) {
    put(folder / "out.bvh", contents(folder / "walk.bvh"));
    const int code = run(words).code;
    const std::string expected = contents(folder / "out.bvh");
    for (const std::vector<int>& streams :
         std::vector<std::vector<int>>{{0}, {1}, {2}, {0, 1}, {0, 2}, {1, 2}, {0, 1, 2}}) {
      put(folder / "out.bvh", contents(folder / "walk.bvh"));
      EXPECT_EQ(run_without(streams, words), code) << words[0];
      EXPECT_EQ(contents(folder / "out.bvh"), expected) << words[0] << " without " << streams[0];
    }
  }
}

TEST_F(ClosedStreams, ATakeForAClosedStandardOutputIsExitCode4) {
  noisy("walk.bvh");
  EXPECT_EQ(run_without({1}, {"clean", "walk.bvh", "-o", "-"}), 4);
  EXPECT_EQ(run_without({1}, {"convert", "walk.bvh", "-o", "-"}), 4);
  EXPECT_EQ(run_without({0}, {"clean", "-", "-o", "out.bvh"}), 3);
}

TEST_F(Streams, StandardInputUnderAnotherNameGoesToStandardOutput) {
  noisy("walk.bvh");
  const std::string take = contents(folder / "walk.bvh");
  const Ran ran = run({"clean", "/dev/stdin"}, {take, {}, {}});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ran.out, run({"clean", "-"}, {take, {}, {}}).out);
  EXPECT_EQ(run({"clean", "/dev/stdin", "--output-dir", "out"}, {take, {}, {}}).code, 2);
}

TEST_F(Streams, ALongNameIsCutInMessages) {
  const std::string name(500, 'n');
  std::string take = hand_take();
  take.replace(take.find("LeftArm"), 7, name);
  put(folder / "long.bvh", take);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"info", "long.bvh", "--tree"},
        {"clean", "long.bvh", "-m", "gaussian", "--verbose", "-o", "a.bvh"},
        {"clean", "long.bvh", "--joints", "none", "-o", "b.bvh"},
        {"clean", "long.bvh", "--joints", name + "x", "-o", "b.bvh"},
        {"check", "long.bvh"},
        {name},
        {"clean", "--" + name}}) {
    const Ran ran = run(words);
    EXPECT_THAT(ran.err + ran.out, Not(HasSubstr(std::string(81, 'n')))) << words[0];
  }
}

TEST_F(Streams, ATakeGoesThroughAPipe) {
  noisy("walk.bvh");
  ASSERT_EQ(run({"clean", "walk.bvh"}).code, 0);
  const Ran ran = run({"clean", "-"}, {contents(folder / "walk.bvh"), {}, {}});
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(ran.out, contents(folder / "walk.clean.bvh"));
  EXPECT_THAT(ran.err, testing::StartsWith("standard input: noisy: "));
}

TEST_F(Streams, APipeMayEndInAFileAndAFileInAPipe) {
  noisy("walk.bvh");
  const Ran to_file = run({"clean", "-", "-o", "out.bvh"}, {contents(folder / "walk.bvh"), {}, {}});
  EXPECT_EQ(to_file.code, 0);
  EXPECT_THAT(to_file.out, testing::StartsWith("standard input: noisy: "));
  const Ran to_pipe = run({"clean", "walk.bvh", "-o", "-"});
  EXPECT_EQ(to_pipe.out, contents(folder / "out.bvh"));
  EXPECT_THAT(to_pipe.err, HasSubstr("method learned"));
}

TEST_F(Streams, EveryCommandReadsStandardInput) {
  const std::string take = hand_take();
  put(folder / "hand.bvh", take);
  EXPECT_THAT(run({"info", "-"}, {take, {}, {}}).out, testing::StartsWith("standard input\n"));
  EXPECT_EQ(run({"convert", "-", "-o", "-"}, {take, {}, {}}).out, take);
  EXPECT_EQ(run({"compare", "hand.bvh", "-", "--max-rms-deg", "0"}, {take, {}, {}}).code, 0);
  const Ran damaged = run({"corrupt", "-", "-o", "-", "--damage", "gaussian"}, {take, {}, {}});
  EXPECT_EQ(damaged.code, 0);
  EXPECT_THAT(damaged.out, testing::StartsWith("HIERARCHY"));
  EXPECT_THAT(damaged.err, HasSubstr("gaussian"));
}

TEST_F(Streams, BadStandardInputIsNamed) {
  const Ran ran = run({"clean", "-"}, {"HIERARCHY\nROOT\n", {}, {}});
  EXPECT_EQ(ran.code, 3);
  EXPECT_EQ(ran.out, "");
  EXPECT_THAT(ran.err, IsOneLine());
  EXPECT_THAT(ran.err, testing::StartsWith("kinemend: standard input:"));
}

TEST_F(Streams, AClosedPipeIsSuccess) {
  synth("walk.bvh", "walk", "20");
  int pipe_ends[2];
  ASSERT_EQ(pipe(pipe_ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    dup2(pipe_ends[1], STDOUT_FILENO);
    close(pipe_ends[0]);
    close(pipe_ends[1]);
    execute({"convert", "walk.bvh", "-o", "-"}, {});
  }
  close(pipe_ends[1]);
  char first[16];
  EXPECT_EQ(read(pipe_ends[0], first, sizeof first), 16);
  close(pipe_ends[0]);
  EXPECT_EQ(wait_for(child).code, 0);
}

TEST_F(Streams, NothingIsColouredOffATerminal) {
  noisy("walk.bvh");
  const Ran ran = run({"clean", "walk.bvh"}, {"", {}, {{"TERM", "xterm"}}});
  EXPECT_THAT(ran.out, Not(HasSubstr("\033")));
  EXPECT_THAT(run({"clean", "no.bvh"}).err, Not(HasSubstr("\033")));
}

TEST_F(Streams, ANameInAFileCannotCommandTheTerminal) {
  std::string take = hand_take();
  take.replace(take.find("LeftArm"), 7, "Left\033[2JArm\xC2\x9B");
  put(folder / "evil.bvh", take);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"info", "evil.bvh", "--tree", "--noise"},
        {"clean", "evil.bvh", "-m", "weighted-mean", "--verbose"},
        {"compare", "evil.bvh", "evil.bvh", "--per-joint"}}) {
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, 0);
    EXPECT_THAT(ran.out, Not(HasSubstr("\033")));
    EXPECT_THAT(ran.out, Not(HasSubstr("\xC2\x9B")));
    EXPECT_THAT(ran.out, HasSubstr("\\x1b[2J"));
  }
}

TEST_F(Streams, NamesThatAreNoUtf8DoNotBreakTheJson) {
  std::string take = hand_take();
  take.replace(take.find("LeftArm"), 7, "Bra\xE7o");
  put(folder / "latin.bvh", take);
  const Ran ran = run({"info", "latin.bvh", "--json"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(Json::parse(ran.out)["takes"][0]["joints"][1]["name"], "Bra\uFFFDo");
}

TEST_F(Terminal, ColoursTheVerdict) {
  noisy("walk.bvh");
  const std::string text =
      run_on_terminal({"clean", "walk.bvh", "--dry-run"}, {"", {}, {{"TERM", "xterm"}}});
  EXPECT_EQ(code, 0);
  EXPECT_THAT(text, HasSubstr("\033[33mnoisy: "));
}

TEST_F(Terminal, IsLeftUncolouredWhenNoColorIsSet) {
  noisy("walk.bvh");
  const std::string text = run_on_terminal({"clean", "walk.bvh", "--dry-run"},
                                           {"", {}, {{"TERM", "xterm"}, {"NO_COLOR", "1"}}});
  EXPECT_THAT(text, HasSubstr("noisy: "));
  EXPECT_THAT(text, Not(HasSubstr("\033[3")));
}

TEST_F(Terminal, ShowsABarForSeveralTakesOnly) {
  synth("a.bvh");
  synth("b.bvh");
  EXPECT_THAT(run_on_terminal({"clean", "a.bvh", "b.bvh", "--output-dir", "d"}),
              HasSubstr("] 1/2 takes"));
  EXPECT_THAT(run_on_terminal({"clean", "a.bvh", "--output-dir", "e"}), Not(HasSubstr("takes")));
  EXPECT_THAT(run({"clean", "a.bvh", "b.bvh", "--output-dir", "f"}).err, Not(HasSubstr("takes")));
}

TEST_F(Terminal, ShowsTheTimeThatABatchHasLeft) {
  fs::create_directory(folder / "raw");
  for (const std::string name : {"a", "b", "c"}) synth("raw/" + name + ".bvh");
  const std::string text = run_on_terminal({"batch", "raw", "-o", "out", "--jobs", "1"});
  EXPECT_EQ(code, 0);
  EXPECT_THAT(text, testing::ContainsRegex("\\] 1/3 takes, [0-9.]+ (s|min|h) left"));
  EXPECT_THAT(text, Not(HasSubstr("3/3 takes,")));
  EXPECT_THAT(run({"batch", "raw", "-o", "again"}).err, Not(HasSubstr("left")));
}

}  // namespace
}  // namespace kinemend::test
