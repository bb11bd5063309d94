// Tests of `kinemend stream`: pipes, TCP and UDP, lost and late frames, and slow clients.
#include "live_program.hpp"

namespace kinemend::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class StreamCommand : public Program {
 protected:
  std::unique_ptr<Running> start(std::vector<std::string> words) {
    words.insert(words.begin(), "stream");
    return std::make_unique<Running>([&] { execute(words, {}); });
  }

  // Splits a noisy take into header and frames.
  void make_take(const std::string& duration_s = "1") {
    noisy("noisy.bvh", duration_s);
    take_ = contents(folder / "noisy.bvh");
    const std::size_t motion = take_.find('\n', take_.find("Frame Time:")) + 1;
    header_ = take_.substr(0, motion);
    for (const std::string& line : lines_of(take_.substr(motion))) frames_.push_back(line + "\n");
  }
  std::string first(std::size_t count, std::size_t from = 0) const {
    std::string text;
    for (std::size_t f = from; f < from + count; ++f) text += frames_[f];
    return text;
  }
  static Setting fed(std::string text) {
    Setting setting;
    setting.in = std::move(text);
    return setting;
  }
  // The output of a stream of the whole take.
  std::string streamed(std::vector<std::string> words) {
    words.insert(words.begin(), "stream");
    const Ran ran = run(words, fed(take_));
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.out;
  }
  static std::size_t frames_in(const std::string& text) {
    const std::size_t motion = text.find('\n', text.find("Frame Time:")) + 1;
    return lines_of(text.substr(motion)).size();
  }

  std::string take_, header_;
  std::vector<std::string> frames_;
};

TEST_F(StreamCommand, GivesWhatCleanMakesOfTheFile) {
  make_take();
  for (const char* method : {"median", "one-euro"}) {
    put(folder / "live.bvh", streamed({"--method", method}));
    const Ran cleaned =
        run({"clean", "noisy.bvh", "-o", "clean.bvh", "--method", method, "--force"});
    ASSERT_EQ(cleaned.code, 0) << cleaned.err;
    const Ran compared =
        run({"compare", "clean.bvh", "live.bvh", "--max-geodesic-rms-deg", "1e-4"});
    EXPECT_EQ(compared.code, 0) << method << compared.out << compared.err;
  }
}

TEST_F(StreamCommand, SaysTheDelayAndASummary) {
  make_take();
  const Ran ran = run({"stream"}, fed(take_));
  EXPECT_THAT(ran.err,
              AllOf(HasSubstr("kinemend: method median\n"),
                    HasSubstr("31 joints at 60 Hz: 4 frames of delay, 66.7 ms\n"),
                    HasSubstr("frames: 60 in, 60 out, 0 lost, 0 interpolated, 0 held, 0 late, "
                              "0 duplicate, 0 malformed, 0 dropped\n"),
                    HasSubstr("ms at the 99th percentile")));
  EXPECT_EQ(frames_in(ran.out), 60);
  EXPECT_EQ(run({"stream", "--quiet"}, fed(take_)).err, "");
}

TEST_F(StreamCommand, RefusesAMethodThatNeedsTheWholeTakeAndNamesTheOthers) {
  const Ran ran = run({"stream", "--method", "auto"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_THAT(
      ran.err,
      AllOf(IsOneLine(), HasSubstr("auto needs the whole take; methods that run live: bilateral"),
            HasSubstr("nonlocal --causal"), HasSubstr("one-euro")));
}

TEST_F(StreamCommand, ListsTheMethodsThatRunLiveAlone) {
  for (const char* help : {"-h", "--help"}) {
    const std::string text = run({"stream", help}).out;
    EXPECT_THAT(text, AllOf(HasSubstr("bilateral"), HasSubstr("kalman"), HasSubstr("one-euro"),
                            HasSubstr("recurrent")));
    for (const char* listed : {"(auto,", "\n  auto ", "--method auto:", "wiener"})
      EXPECT_THAT(text, Not(HasSubstr(listed))) << help;
  }
  EXPECT_THAT(run({"completion", "fish"}).out,
              HasSubstr("from stream' -l method -s m -d 'how to clean: a method that runs live' -x "
                        "-a 'bilateral nonlocal"));
}

TEST_F(StreamCommand, LeavesTheLastFramesOutOfTheLatency) {
  make_take();
  // The method looks four frames ahead, so all of these frames wait for the end.
  const Ran ran = run({"stream"}, fed(header_ + first(4)));
  EXPECT_THAT(ran.err, AllOf(HasSubstr("frames: 4 in, 4 out"), Not(HasSubstr("latency: "))));
}

TEST_F(StreamCommand, PutsDatagramsThatOvertookEachOtherInOrder) {
  make_take();
  const Socket client = Socket::listening(SOCK_DGRAM);
  const auto program =
      start({"--udp", "0", "--numbered", "--to-udp", client.at(), "--method", "one-euro"});
  const Socket sender = Socket::connected(SOCK_DGRAM, program->port());
  sender.send(header_);
  std::string all = client.datagram();
  for (const std::size_t f : {0, 1, 3, 2, 4}) sender.send(std::to_string(f) + " " + frames_[f]);
  for (int i = 0; i < 5; ++i) all += client.datagram();
  program->tell(SIGINT);
  EXPECT_EQ(program->wait(), 0);
  const std::string whole = streamed({"--method", "one-euro"});
  EXPECT_EQ(all, whole.substr(0, all.size()));
  EXPECT_THAT(program->err.all(),
              AllOf(HasSubstr("frames: 5 in, 5 out, 0 lost, 0 interpolated, 0 held, 0 late"),
                    HasSubstr("frames that arrived out of order and were put in their place: 1")));
}

TEST_F(StreamCommand, MakesNoFrameOfGarbageDatagrams) {
  make_take();
  const Socket client = Socket::listening(SOCK_DGRAM);
  const auto program = start({"--udp", "0", "--to-udp", client.at(), "--method", "one-euro"});
  const Socket sender = Socket::connected(SOCK_DGRAM, program->port());
  sender.send(header_);
  client.datagram();
  for (const std::string& datagram :
       {frames_[0], std::string("1 2 3"), std::string("\xff\x00\x13", 3), frames_[1]})
    sender.send(datagram);
  for (int i = 0; i < 2; ++i) client.datagram();
  program->tell(SIGINT);
  EXPECT_EQ(program->wait(), 0);
  EXPECT_THAT(program->err.all(),
              HasSubstr("frames: 2 in, 2 out, 0 lost, 0 interpolated, 0 held, 0 "
                        "late, 0 duplicate, 2 malformed"));
}

TEST_F(StreamCommand, LetsSendersQueueWhileOneIsConnected) {
  make_take();
  const auto program = start({"--tcp", "0", "--method", "one-euro"});
  const int port = program->port();
  std::vector<Socket> senders;
  for (std::size_t i = 0; i < 8; ++i) {
    senders.push_back(Socket::connected(SOCK_STREAM, port));
    senders.back().send(header_ + first(2, 2 * i));
  }
  for (Socket& sender : senders) sender.close();
  program->err.until("the sender disconnected", senders.size());
  program->tell(SIGTERM);
  EXPECT_EQ(program->wait(), 0);
  EXPECT_THAT(program->err.all(), HasSubstr("frames: 16 in, 16 out"));
}

TEST_F(StreamCommand, KeepsNoHeadersForAClientThatDoesNotRead) {
  make_take();
  const Socket client = Socket::listening(SOCK_STREAM);
  const auto program =
      start({"--tcp", "0", "--once", "--to-tcp", client.at(), "--queue", "5", "-m", "one-euro"});
  const Socket received = client.accept();
  // The rate alternates, and each change sends the client a new header.
  std::string faster = header_;
  faster.replace(faster.find("Frame Time:"), faster.npos, "Frame Time: 0.01\n");
  constexpr std::size_t rounds = 8000;
  {
    const Socket sender = Socket::connected(SOCK_STREAM, program->port());
    std::string many;
    for (int i = 0; i < 100; ++i) many += header_ + faster;
    for (std::size_t sent = 100; sent <= rounds; sent += 100) {
      sender.send(many);
      program->err.until(" at 100 Hz", sent);
    }
  }
  EXPECT_EQ(program->wait(), 0);
#if !defined(KINEMEND_SANITIZED)
  EXPECT_LT(program->peak_kilobytes, 50 * 1024);
#endif
}

TEST_F(StreamCommand, RefusesWhatMakesNoSense) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"stream", "--tcp", "x"},
                                             {"stream", "--tcp", "70000"},
                                             {"stream", "--tcp", "0", "--udp", "0"},
                                             {"stream", "--udp", "localhost:0"},
                                             {"stream", "--to-tcp", "7000"},
                                             {"stream", "--bind", "0.0.0.0"},
                                             {"stream", "--udp", "0", "--reorder", "4"},
                                             {"stream", "--to-tcp", "a:1", "--to-udp", "a:1"}}) {
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, 2) << ran.err;
    EXPECT_THAT(ran.err, IsOneLine());
  }
}

TEST_F(StreamCommand, EndsWithACodeWhereItCannotReadOrWrite) {
  make_take();
  EXPECT_EQ(run({"stream"}, fed("")).code, 3);
  EXPECT_EQ(run({"stream"}, fed("HIERARCHY\nnonsense\n")).code, 3);
  EXPECT_EQ(run({"stream", "--skeleton", "none.bvh"}).code, 3);
  int port = 0;
  {
    const Socket closed = Socket::listening(SOCK_STREAM);
    port = closed.port();
  }
  const std::string place = "127.0.0.1:" + std::to_string(port);
  EXPECT_EQ(run({"stream", "--to-tcp", place}, fed(take_)).code, 4);
  EXPECT_EQ(run({"stream", "--tcp", place}).code, 3);
}

TEST_F(StreamCommand, TakesFramesOverTcpAndGivesThemOverTcp) {
  make_take();
  const Socket client = Socket::listening(SOCK_STREAM);
  const auto program = start({"--tcp", "0", "--once", "--to-tcp", client.at()});
  const Socket received = client.accept();
  {
    const Socket sender = Socket::connected(SOCK_STREAM, program->port());
    sender.send(take_);
  }
  EXPECT_EQ(received.incoming().all(), streamed({}));
  EXPECT_EQ(program->wait(), 0) << program->err.all();
}

TEST_F(StreamCommand, ConnectsToASender) {
  make_take();
  const Socket server = Socket::listening(SOCK_STREAM);
  const auto program = start({"--tcp", server.at(), "--once"});
  {
    const Socket sender = server.accept();
    sender.send(take_);
  }
  EXPECT_EQ(program->out.all(), streamed({}));
  EXPECT_EQ(program->wait(), 0);
}

TEST_F(StreamCommand, TakesDatagramsAndGivesOneAFrame) {
  make_take();
  const Socket client = Socket::listening(SOCK_DGRAM);
  const auto program = start({"--udp", "0", "--to-udp", client.at(), "--method", "one-euro"});
  const Socket sender = Socket::connected(SOCK_DGRAM, program->port());
  sender.send(header_);
  std::string all = client.datagram();
  EXPECT_EQ(all, header_);
  for (std::string frame : frames_) {
    frame.pop_back();  // the end of a datagram ends its line
    sender.send(frame);
    all += client.datagram();
  }
  program->tell(SIGINT);
  EXPECT_EQ(program->wait(), 0);
  EXPECT_EQ(all, streamed({"--method", "one-euro"}));
}

TEST_F(StreamCommand, GivesWhatIsInTheWindowWhenItIsToldToEnd) {
  make_take();
  const auto program = start({"--method", "median"});
  program->write(header_ + first(20));
  program->out.until("\n", lines_of(header_).size() + 16);
  program->tell(SIGTERM);
  EXPECT_EQ(program->wait(), 0);
  EXPECT_EQ(frames_in(program->out.all()), 20);
  EXPECT_THAT(program->err.all(), HasSubstr("frames: 20 in, 20 out"));
}

TEST_F(StreamCommand, GoesOnWhenTheSenderComesBack) {
  make_take();
  const auto program = start({"--tcp", "0", "--method", "one-euro"});
  const int port = program->port();
  const std::size_t head = lines_of(header_).size();
  for (const std::size_t round : {0, 1}) {
    const Socket sender = Socket::connected(SOCK_STREAM, port);
    sender.send(header_ + first(10, 10 * round));
    program->out.until("\n", head + 10 * (round + 1));
  }
  program->err.until("the sender disconnected", 2);
  program->tell(SIGTERM);
  EXPECT_EQ(program->wait(), 0);
  const std::string whole = streamed({"--method", "one-euro"});
  EXPECT_EQ(program->out.all(), whole.substr(0, program->out.all().size()));
  EXPECT_EQ(frames_in(program->out.all()), 20);
}

TEST_F(StreamCommand, DropsTheOldestFramesOfAClientThatDoesNotRead) {
  make_take();
  const Socket client = Socket::listening(SOCK_STREAM);
  const auto program =
      start({"--tcp", "0", "--once", "--to-tcp", client.at(), "--queue", "5", "-m", "one-euro"});
  const Socket received = client.accept();
  {
    const Socket sender = Socket::connected(SOCK_STREAM, program->port());
    sender.send(header_);
    for (int round = 0; round < 600; ++round) sender.send(first(60));
  }
  EXPECT_EQ(program->wait(), 0);
  const std::string said = program->err.all();
  EXPECT_THAT(said, HasSubstr("frames: 36000 in, 36000 out"));
  const std::size_t at = said.find(" dropped");
  const std::size_t before = said.rfind(' ', at - 1) + 1;
  EXPECT_GT(std::stoi(said.substr(before, at - before)), 100) << said;
  // Every received line is complete, except the one in transit.
  std::vector<std::string> lines = lines_of(received.incoming().all());
  lines.pop_back();
  for (std::size_t i = lines_of(header_).size(); i < lines.size(); ++i)
    ASSERT_EQ(std::count(lines[i].begin(), lines[i].end(), ' '), 95) << i;
}

TEST_F(StreamCommand, EndsWithoutFailureWhenTheReaderOfItsPipeGoes) {
  make_take();
  const auto program = start({});
  program->write(header_ + first(10));
  program->out.until("MOTION");
  program->close_out();
  program->write(first(40, 10));
  EXPECT_EQ(program->wait(), 0);
  EXPECT_THAT(program->err.all(), HasSubstr("frames: "));
}

TEST_F(StreamCommand, HoldsTheLastFrameWhileTheSenderIsSilent) {
  make_take();
  const auto program = start({"--stall-ms", "1", "--on-stall", "hold", "-m", "one-euro"});
  const std::size_t head = lines_of(header_).size();
  program->write(header_ + first(1));
  program->out.until("\n", head + 4);
  program->write(first(1, 1));
  program->err.until("frames arrive again");
  program->close_in();
  EXPECT_EQ(program->wait(), 0);
  const std::vector<std::string> lines = lines_of(program->out.all());
  EXPECT_EQ(lines[head + 1], lines[head]);
  EXPECT_EQ(lines[head + 3], lines[head]);
  EXPECT_NE(lines.back(), lines[head]);
}

TEST_F(StreamCommand, CountsLostLateDoubledAndMalformedFrames) {
  make_take();
  std::string text = header_;
  for (const std::size_t f : {0, 1, 2, 5, 4, 5, 6}) text += std::to_string(f) + " " + frames_[f];
  text += "7 1 2 3\n";
  const Ran ran = run({"stream", "--numbered", "--format", "jsonl"}, fed(text));
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.err, HasSubstr("frames: 5 in, 7 out, 2 lost, 2 interpolated, 0 held, 1 late, 1 "
                                 "duplicate, 1 malformed, 0 dropped\n"));
  const std::vector<std::string> lines = lines_of(ran.out);
  ASSERT_EQ(lines.size(), 8);
  EXPECT_EQ(Json::parse(lines[0])["delay_frames"], 4);
  EXPECT_EQ(Json::parse(lines[7])["frame"], 6);
}

TEST_F(StreamCommand, CleansMarkers) {
  const Ran ran = run({"stream", "-m", "one-euro", "--body-height", "1700"},
                      fed("MARKERS 100 LASI,RASI\n1,2,3,,,\n1,2,3,4,5,6\n"));
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(lines_of(ran.out),
              ElementsAre("MARKERS 100 LASI,RASI", "1.000000,2.000000,3.000000,,,",
                          "1.000000,2.000000,3.000000,4.000000,5.000000,6.000000"));
}

}  // namespace
}  // namespace kinemend::test
