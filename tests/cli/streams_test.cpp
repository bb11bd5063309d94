#include <pty.h>

#include <cstring>

#include "cli/program.hpp"

// Standard streams: pipes, closed pipes, terminals.
namespace kinemend::test {
namespace {

using Streams = Program;
using testing::HasSubstr;
using testing::Not;

/// What the program prints on a terminal that all of its streams are.
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
  EXPECT_THAT(to_pipe.err, HasSubstr("method auto"));
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

}  // namespace
}  // namespace kinemend::test
