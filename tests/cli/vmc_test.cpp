// Tests of `kinemend stream --vmc`, `--neuron` and `--status`, over sockets.
#include "live/vmc_packets.hpp"
#include "live_program.hpp"

namespace kinemend::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class VmcCommand : public Program {
 protected:
  std::unique_ptr<Running> start(std::vector<std::string> words) {
    words.insert(words.begin(), "stream");
    return std::make_unique<Running>([&] { execute(words, {}); });
  }
  std::unique_ptr<Running> relay(const Socket& receiver, std::vector<std::string> more = {}) {
    std::vector<std::string> words = {"--vmc", "0", "--to-vmc", receiver.at(), "-m", "one-euro"};
    words.insert(words.end(), more.begin(), more.end());
    return start(words);
  }
  static std::string end(Running& program) {
    program.tell(SIGINT);
    EXPECT_EQ(program.wait(), 0);
    return program.err.all();
  }
  // The response to a request, with its head.
  static std::string asked(int port, const std::string& path, const std::string& host = {}) {
    const Socket browser = Socket::connected(SOCK_STREAM, port);
    browser.send("GET " + path + " HTTP/1.1\r\nHost: " +
                 (host.empty() ? "127.0.0.1:" + std::to_string(port) : host) +
                 "\r\nConnection: close\r\n\r\n");
    return browser.incoming().all();
  }
  static int status_port(Running& program) {
    const std::string& text = program.err.until("/\n");
    return std::stoi(text.substr(text.find("127.0.0.1:") + 10));
  }
};

TEST_F(VmcCommand, StandsBetweenASenderAndAReceiver) {
  const Socket receiver = Socket::listening(SOCK_DGRAM);
  const auto program = relay(receiver);
  const Socket sender = Socket::connected(SOCK_DGRAM, program->port());
  int changed = 0;
  for (std::size_t f = 0; f < 40; ++f) {
    const std::string datagram = vmc_datagram(f, vmc_noisy(f));
    sender.send(datagram);
    const std::string got = receiver.datagram();
    ASSERT_EQ(without_poses(got), without_poses(datagram));
    changed += got != datagram ? 1 : 0;
  }
  EXPECT_GT(changed, 30);
  EXPECT_THAT(
      end(*program),
      AllOf(HasSubstr("0 frames of delay, 0 ms at 60 Hz\n"), HasSubstr("a sender at 127.0.0.1:"),
            HasSubstr("datagrams: 40 in, 40 out, 0 not OSC, 0 not sent\n"),
            HasSubstr("bones: 800, "), HasSubstr("ms at the 99th percentile")));
}

TEST_F(VmcCommand, GivesEverythingWhenItIsToldToEnd) {
  const Socket receiver = Socket::listening(SOCK_DGRAM);
  const auto program = relay(receiver, {"-m", "median"});
  const Socket sender = Socket::connected(SOCK_DGRAM, program->port());
  const std::string face = osc_message("/VMC/Ext/Blend/Apply", "");
  // The face message arrives last, so it marks the end of the datagrams.
  sender.send(vmc_datagram(0, vmc_noisy(0)));
  sender.send(face);
  EXPECT_EQ(without_poses(receiver.datagram()), without_poses(vmc_datagram(0, vmc_noisy(0))));
  EXPECT_EQ(receiver.datagram(), face);
  EXPECT_THAT(end(*program), HasSubstr("datagrams: 2 in, 2 out"));
}

TEST_F(VmcCommand, KeepsSendersApart) {
  const Socket receiver = Socket::listening(SOCK_DGRAM);
  const auto program = relay(receiver);
  const int port = program->port();
  const Socket first = Socket::connected(SOCK_DGRAM, port),
               second = Socket::connected(SOCK_DGRAM, port);
  const Quat turned = exp(Vec3{2, 0, 0});
  for (int f = 0; f < 20; ++f) {
    first.send(vmc_bone("Head", {{0, 0, 0}, {1, 0, 0, 0}}));
    EXPECT_NEAR(vmc_poses(receiver.datagram()).at("Head").rotation.w, 1, 1e-6);
    second.send(vmc_bone("Head", {{0, 0, 0}, turned}));
    EXPECT_NEAR(vmc_poses(receiver.datagram()).at("Head").rotation.w, turned.w, 1e-6);
  }
  EXPECT_THAT(end(*program), HasSubstr("frames: 40, "));
}

TEST_F(VmcCommand, GoesOnThroughGarbageAndSendersThatStartAgain) {
  const Socket receiver = Socket::listening(SOCK_DGRAM);
  const auto program = relay(receiver);
  const int port = program->port();
  // There are more senders than slots; datagrams of the last ones pass unchanged.
  for (int i = 0; i < 20; ++i) {
    const Socket sender = Socket::connected(SOCK_DGRAM, port);
    for (const std::string& datagram :
         {std::string("garbage"), osc_text("#bundle"), vmc_bone("Head", {{0, 0, 0}, {1, 0, 0, 0}}),
          std::string(60000, '/'),
          osc_bundle({osc_bundle({vmc_root({{1, 2, 3}, {0, 0, 0, 0}})}, 9, 9)}, 8, 8)}) {
      sender.send(datagram);
      ASSERT_EQ(receiver.datagram(), datagram);
    }
  }
  EXPECT_THAT(end(*program), AllOf(HasSubstr("datagrams: 100 in, 100 out, 48 not OSC, 0 not sent"),
                                   HasSubstr("there are 16 senders")));
#if !defined(KINEMEND_SANITIZED)
  EXPECT_LT(program->peak_kilobytes, 60 * 1024);
#endif
}

TEST_F(VmcCommand, NamesTheBonesThatItCleans) {
  const Socket receiver = Socket::listening(SOCK_DGRAM);
  const auto program = relay(receiver, {"--joints", "Head,Neck"});
  const Socket sender = Socket::connected(SOCK_DGRAM, program->port());
  for (std::size_t f = 0; f < 10; ++f) {
    const VmcBody body = vmc_noisy(f);
    sender.send(vmc_datagram(f, body));
    const VmcBody got = vmc_poses(receiver.datagram());
    for (const auto& [name, pose] : vmc_poses(vmc_datagram(f, body))) {
      if (name != "Head" && name != "Neck") {
        ASSERT_EQ(got.at(name).rotation, pose.rotation) << name;
      }
    }
    if (f > 2) {
      EXPECT_GT(angle_between(got.at("Head").rotation, body.at("Head").rotation), 1e-4);
    }
  }
  end(*program);
}

TEST_F(VmcCommand, HasAStatusPage) {
  const Socket receiver = Socket::listening(SOCK_DGRAM);
  const auto program = relay(receiver, {"--status", "0"});
  const int port = status_port(*program);
  const std::string& said = program->err.until(" (UDP)");
  const Socket sender =
      Socket::connected(SOCK_DGRAM, std::stoi(said.substr(said.find("VMC at 127.0.0.1:") + 17)));
  for (std::size_t f = 0; f < 20; ++f) {
    sender.send(vmc_datagram(f, vmc_noisy(f)));
    receiver.datagram();
  }
  EXPECT_THAT(asked(port, "/"),
              AllOf(HasSubstr("200 OK"), HasSubstr("<title>Kinemend live</title>")));
  const std::string answer = asked(port, "/status.json");
  const Json status = Json::parse(answer.substr(answer.find("\r\n\r\n")));
  EXPECT_EQ(status["method"], "one-euro");
  EXPECT_EQ(status["delay_frames"], 0);
  ASSERT_EQ(status["senders"].size(), 1);
  EXPECT_EQ(status["senders"][0]["counts"]["frames"], 20);
  EXPECT_EQ(status["senders"][0]["tracks"].size(), 20);
  std::size_t sum = 0;
  for (const Json& bar : status["latency"]["bars"]) sum += bar["count"].get<std::size_t>();
  EXPECT_EQ(sum, 20);
  EXPECT_THAT(asked(port, "/other"), HasSubstr("404"));
  EXPECT_THAT(asked(port, "/status.json", "evil.example:" + std::to_string(port)),
              HasSubstr("403"));
  end(*program);
}

TEST_F(VmcCommand, ShowsAStreamOfTextOnTheStatusPageToo) {
  noisy("noisy.bvh", "1");
  const auto program = start({"--status", "0", "-m", "one-euro"});
  const int port = status_port(*program);
  const std::string take = contents(folder / "noisy.bvh");
  program->write(take);
  program->out.until("\n", lines_of(take).size());
  const std::string answer = asked(port, "/status.json");
  const Json status = Json::parse(answer.substr(answer.find("\r\n\r\n")));
  EXPECT_EQ(status["senders"][0]["counts"]["out"], 60);
  EXPECT_EQ(status["senders"][0]["tracks"].size(), 31);
  program->close_in();
  EXPECT_EQ(program->wait(), 0);
}

TEST_F(VmcCommand, RefusesWhatMakesNoSense) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"stream", "--vmc", "0"},
           {"stream", "--vmc", "127.0.0.1:0", "--to-vmc", "127.0.0.1:1"},
           {"stream", "--vmc", "0", "--to-vmc", "1"},
           {"stream", "--vmc", "0", "--udp", "0", "--to-vmc", "127.0.0.1:1"},
           {"stream", "--vmc", "0", "--to-vmc", "127.0.0.1:1", "--numbered"},
           {"stream", "--vmc", "0", "--to-vmc", "127.0.0.1:1", "-m", "recurrent"},
           {"stream", "--to-vmc", "127.0.0.1:1"},
           {"stream", "--bones", "Head"},
           {"stream", "--neuron", "0", "--tcp", "0"}}) {
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, 2) << testing::PrintToString(words) << ran.err;
    EXPECT_THAT(ran.err, IsOneLine());
  }
}

std::string neuron_text(std::size_t frames) {
  std::string text;
  for (std::size_t f = 0; f < frames; ++f) {
    text += "0 Char00";
    for (int v = 0; v < 180; ++v)
      text += " " + std::to_string(0.01 * v + 0.1 * static_cast<double>(f));
    text += " ||\r\n";
  }
  return text;
}

TEST_F(VmcCommand, ReceivesTheBroadcastOfAxisNeuron) {
  const Socket axis = Socket::listening(SOCK_STREAM);
  const auto connected = start({"--neuron", axis.at(), "--once", "-m", "median"});
  axis.accept().send(neuron_text(30));
  const std::string out = connected->out.all();
  EXPECT_EQ(connected->wait(), 0);
  EXPECT_THAT(connected->err.all(), AllOf(HasSubstr("59 joints at 60 Hz: 4 frames of delay"),
                                          HasSubstr("frames: 30 in, 30 out, 0 lost")));
  const auto waiting = start({"--neuron", "0", "--once", "-m", "median"});
  Socket::connected(SOCK_STREAM, waiting->port()).send(neuron_text(30));
  EXPECT_EQ(waiting->out.all(), out);
  EXPECT_EQ(waiting->wait(), 0);
}

}  // namespace
}  // namespace kinemend::test
