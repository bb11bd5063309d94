// Tests `kinemend view` with requests that its page never sends, as bytes on the socket of the
// running program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "cli/live_program.hpp"

namespace kinemend::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using Clock = std::chrono::steady_clock;

constexpr std::size_t megabyte = 1 << 20;

class ViewServer : public Program {
 protected:
  void start(std::vector<std::string> words) {
    words.insert(words.begin(), {"view", "--no-open"});
    program = std::make_unique<Running>([&] { execute(words, {}); });
    const std::string& told = program->out.until("/\n");
    const std::string place = "http://127.0.0.1:";
    const std::size_t at = told.find(place);
    ASSERT_NE(at, told.npos) << program->err.all();
    port = std::stoi(told.substr(at + place.size()));
    const std::size_t path_at = told.find('/', at + place.size());
    path = told.substr(path_at, told.find('\n') - path_at);
  }
  void start_with_walk() {
    synth("walk.bvh");
    start({"walk.bvh"});
  }

  Socket connect() const { return Socket::connected(SOCK_STREAM, port); }

  std::string head(const std::string& first_line, const std::string& more = "") const {
    return first_line + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
           "\r\nContent-Type: application/json\r\n" + more + "\r\n";
  }
  static std::string length(std::size_t bytes) {
    return "Content-Length: " + std::to_string(bytes) + "\r\n";
  }

  /// Reads the answers until the program ends the connection.
  static std::string answer(const Socket& socket) { return socket.incoming().all(); }
  std::string answer_to(const std::string& bytes) const {
    const Socket socket = connect();
    socket.send(bytes);
    return answer(socket);
  }
  /// Sends a request as the page does.
  std::string post(const std::string& action, const std::string& body) const {
    return answer_to(head("POST " + path + action, length(body.size()) + "Connection: close\r\n") +
                     body);
  }
  /// Expects that the page is served within two seconds.
  void expect_served() const {
    const auto begun = Clock::now();
    EXPECT_THAT(answer_to(head("GET " + path, "Connection: close\r\n")),
                StartsWith("HTTP/1.1 200 "));
    EXPECT_LT(Clock::now() - begun, std::chrono::seconds(2));
  }

  /// A number in /proc/PID/status.
  long status_of_process(const std::string& name) const {
    const std::string text = contents("/proc/" + std::to_string(program->process()) + "/status");
    const std::size_t at = text.find("\n" + name + ":");
    return at == text.npos ? 0 : std::stol(text.substr(at + name.size() + 2));
  }
  void expect_little_memory(long kilobytes_before) const {
    EXPECT_LT(status_of_process("VmHWM") - kilobytes_before, 32 * 1024);
  }

  std::unique_ptr<Running> program;
  int port = 0;
  std::string path;
};

TEST_F(ViewServer, RefusesBodiesOfUnknownLengthAndKeepsNoneOfThem) {
  start_with_walk();
  expect_served();
  const long before = status_of_process("VmHWM");
  const std::string chunk = "100000\r\n" + std::string(megabyte, ' ') + "\r\n";
  for (const std::string& to : {path + "run", std::string("/run")}) {
    const Socket socket = connect();
    socket.send(head("POST " + to, "Transfer-Encoding: chunked\r\n") + chunk);
    EXPECT_THAT(socket.incoming().until("\r\n"), StartsWith("HTTP/1.1 411 ")) << to;
    // A client that keeps sending is cut off.
    for (int i = 0; i < 300; ++i) socket.send(chunk);
  }
  expect_little_memory(before);
  expect_served();
}

TEST_F(ViewServer, RefusesAFirstLineAndHeadersOfManyMegabytes) {
  start_with_walk();
  const long before = status_of_process("VmHWM");
  const std::string much(megabyte, 'a');
  for (const std::string& begin : {std::string("GET /"), head("GET " + path).substr(0, 60)}) {
    const Socket socket = connect();
    socket.send(begin + much);
    EXPECT_THAT(socket.incoming().until("\r\n"), StartsWith("HTTP/1.1 431 "));
    for (int i = 0; i < 200; ++i) socket.send(much);
  }
  expect_little_memory(before);
  expect_served();
}

TEST_F(ViewServer, RefusesABodyBeforeItIsSent) {
  start_with_walk();
  // Without the token, a body of any length is refused.
  EXPECT_THAT(answer_to(head("POST /run", length(16 * megabyte))), StartsWith("HTTP/1.1 403 "));
  EXPECT_THAT(answer_to(head("POST /run", length(2))), StartsWith("HTTP/1.1 403 "));
  // With the token, a body that is too long or compressed is refused.
  const std::string run = "POST " + path + "run";
  for (const char* digits : {"16777217", "1500000000", "99999999999999999999999"}) {
    EXPECT_THAT(answer_to(head(run, std::string("Content-Length: ") + digits + "\r\n")),
                StartsWith("HTTP/1.1 413 "));
  }
  EXPECT_THAT(answer_to(head(run, length(20) + "Content-Encoding: gzip\r\n")),
              StartsWith("HTTP/1.1 415 "));
  expect_served();
}

TEST_F(ViewServer, RefusesHeadsOfAnotherForm) {
  start_with_walk();
  const std::string run = "POST " + path + "run";
  for (const std::string& bytes :
       {std::string("nonsense\r\n\r\n"), std::string("GET\r\n\r\n"),
        std::string("GET http://x/ HTTP/1.1\r\n\r\n"),
        std::string("GET / HTTP/1.1\r\nno colon\r\n\r\n"),
        std::string("GET / HTTP/1.1\r\nA: 1\r\n B: folded\r\n\r\n"),
        std::string("G\0T / HTTP/1.1\r\n\r\n", 18), head(run, length(2) + length(3)),
        head(run, "Content-Length: -1\r\n"), head(run, "Content-Length: 0x10\r\n"),
        head(run, "Content-Length: \r\n"), head(run, "Host: 127.0.0.1\r\n")})
    EXPECT_THAT(answer_to(bytes), StartsWith("HTTP/1.1 400 ")) << bytes;
  EXPECT_THAT(answer_to("GET / HTTP/2.0\r\n\r\n"), StartsWith("HTTP/1.1 505 "));
  EXPECT_THAT(answer_to(head("PUT " + path + "run")), StartsWith("HTTP/1.1 405 "));
  expect_served();
}

TEST_F(ViewServer, ServesOthersWhileHundredsOfConnectionsAreSlow) {
  start_with_walk();
  std::vector<Socket> slow;
  const auto open = [&](int count, const std::string& bytes) {
    for (int i = 0; i < count; ++i) {
      slow.push_back(connect());
      slow.back().send(bytes);
    }
    expect_served();
  };
  open(10, head("POST " + path + "run", length(1000)));
  open(150, "");
  open(150, "GET ");
  EXPECT_LT(status_of_process("Threads"), 100);
}

TEST_F(ViewServer, DoesNotWaitForARequestForEver) {
  start_with_walk();
  const Socket slow_head = connect(), slow_body = connect();
  slow_head.send("GET " + path);
  slow_body.send(head("POST " + path + "run", length(1000)) + "{");
  EXPECT_THAT(answer(slow_head), StartsWith("HTTP/1.1 408 "));
  EXPECT_THAT(answer(slow_body), StartsWith("HTTP/1.1 408 "));
}

TEST_F(ViewServer, AnswersSeveralRequestsOnOneConnection) {
  start_with_walk();
  const std::string body = R"({"command": "clean"})";
  const std::string leave = head("POST " + path + "leave", length(body.size())) + body;
  const Socket socket = connect();
  socket.send(leave + leave);
  EXPECT_THAT(socket.incoming().until("200 OK", 2), HasSubstr("200 OK"));
  // The client sends the body in parts, after the program's 100 response.
  const Socket patient = connect();
  patient.send(head("POST " + path + "leave", length(body.size()) + "Expect: 100-continue\r\n"));
  EXPECT_THAT(patient.incoming().until("\r\n\r\n"), StartsWith("HTTP/1.1 100 "));
  patient.send(body.substr(0, 5));
  patient.send(body.substr(5));
  EXPECT_THAT(patient.incoming().until("200 OK"), StartsWith("HTTP/1.1 200 "));
}

TEST_F(ViewServer, RefusesJsonThatIsNestedDeeply) {
  start_with_walk();
  for (const std::size_t levels : {std::size_t{70}, std::size_t{100'000}, std::size_t{1'000'000}}) {
    for (const char* open : {"[", "{\"a\":"}) {
      std::string body = R"({"command": "clean", "flags": )";
      for (std::size_t i = 0; i < levels; ++i) body += open;
      const std::string told = post("run", body);
      EXPECT_THAT(told, StartsWith("HTTP/1.1 400 "));
      EXPECT_THAT(told, HasSubstr("nested more than 64 levels deep"));
    }
  }
  EXPECT_THAT(post("run", R"({"flags": {"joints": [1]}})"), StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(post("run", R"({"flags": 7})"), StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(post("run", R"({"command": "batch"})"), StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(post("run", "7"), StartsWith("HTTP/1.1 400 "));
  expect_served();
}

TEST_F(ViewServer, RefusesAValueOutOfRangeWithTheRange) {
  start_with_walk();
  const std::string told = post("run", R"({"command": "clean", "flags": {"strength": 5}})");
  EXPECT_THAT(told, StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(told, HasSubstr("--strength"));
  EXPECT_THAT(told, HasSubstr("0 to 1"));
}

TEST_F(ViewServer, RunsAPresetWithOptionsOfItsMethod) {
  start_with_walk();
  EXPECT_THAT(post("run", R"({"flags": {"preset": "biomech", "cutoff_hz": 5}})"),
              StartsWith("HTTP/1.1 200 "));
  // Without the preset, the method does not have this option.
  EXPECT_THAT(post("run", R"({"flags": {"cutoff_hz": 5}})"), StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(post("run", R"({"flags": {"preset": "none such"}})"), HasSubstr("live, biomech"));
  const std::string saved = post("save", R"({"flags": {"preset": "biomech"}, "file": "lab.bvh"})");
  EXPECT_THAT(saved, HasSubstr("--preset=biomech"));
  ASSERT_EQ(run({"clean", "walk.bvh", "--preset", "biomech", "-o", "cli.bvh"}).code, 0);
  EXPECT_EQ(contents(folder / "lab.bvh"), contents(folder / "cli.bvh"));
}

TEST_F(ViewServer, SavesUnderANameAndReplacesOnlyWhatIsConfirmed) {
  start_with_walk();
  const std::string plain = R"({"command": "clean", "file": "mine.bvh"})";
  EXPECT_THAT(post("save", plain), HasSubstr("\"mine.bvh\""));
  const std::string made = contents(folder / "mine.bvh");
  // The page may overwrite files that it saved itself.
  EXPECT_THAT(post("save", plain), StartsWith("HTTP/1.1 200 "));
  put(folder / "old.bvh", "old");
  const std::string told = post("save", R"({"command": "clean", "file": "old.bvh"})");
  EXPECT_THAT(told, StartsWith("HTTP/1.1 409 "));
  EXPECT_THAT(told, HasSubstr("\"existing\""));
  EXPECT_THAT(told, HasSubstr("old.bvh: exists already"));
  EXPECT_EQ(contents(folder / "old.bvh"), "old");
  EXPECT_THAT(post("save", R"({"command": "clean", "file": "old.bvh", "replace": true})"),
              StartsWith("HTTP/1.1 200 "));
  EXPECT_EQ(contents(folder / "old.bvh"), made);
}

TEST_F(ViewServer, SavesNowhereElseAndNeverOverTheTake) {
  synth("walk.bvh");
  fs::create_directory(folder / "out");
  start({"walk.bvh", "-o", "out/cleaned.bvh"});
  const std::string take = contents(folder / "walk.bvh");
  const std::vector<std::string> before = files();
  for (const char* name : {"../walk.bvh", "/tmp/x.bvh", "a/b.bvh", "..", ".", "a\\\\b.bvh",
                           "a\\u0000.bvh", "a\\n.bvh"}) {
    const std::string told =
        post("save", std::string(R"({"replace": true, "file": ")") + name + "\"}");
    EXPECT_THAT(told, StartsWith("HTTP/1.1 400 ")) << name;
    EXPECT_THAT(told, HasSubstr("expected a file name without a folder")) << name;
  }
  EXPECT_EQ(files(), before);
  EXPECT_THAT(post("save", R"({"file": "other.bvh"})"), StartsWith("HTTP/1.1 200 "));
  EXPECT_TRUE(fs::exists(folder / "out" / "other.bvh"));
  start({"walk.bvh"});
  EXPECT_THAT(post("save", R"({"file": "walk.bvh", "replace": true})"), HasSubstr("would be lost"));
  EXPECT_EQ(contents(folder / "walk.bvh"), take);
}

TEST_F(ViewServer, TakesAFileWhoseNameBeginsWithADash) {
  synth("walk.bvh");
  fs::rename(folder / "walk.bvh", folder / "-dash.bvh");
  start({"--", "-dash.bvh"});
  EXPECT_THAT(post("run", R"({"command": "clean"})"), StartsWith("HTTP/1.1 200 "));
  const std::string told = post("save", R"({"command": "clean"})");
  EXPECT_THAT(told, StartsWith("HTTP/1.1 200 "));
  EXPECT_THAT(told, HasSubstr("./-dash.clean.bvh"));
  EXPECT_TRUE(fs::exists(folder / "-dash.clean.bvh"));
  EXPECT_THAT(post("save", R"({"command": "clean", "file": "-x.bvh"})"),
              StartsWith("HTTP/1.1 200 "));
  EXPECT_TRUE(fs::exists(folder / "-x.bvh"));
}

TEST_F(ViewServer, CleansWithItsSourceUnlessThePageChoosesAnother) {
  noisy("walk.bvh", "1");
  start({"walk.bvh", "--source", "keyframed"});
  EXPECT_THAT(post("save", R"({"file": "keyed.bvh"})"), HasSubstr("--source=keyframed"));
  EXPECT_EQ(contents(folder / "keyed.bvh"), contents(folder / "walk.bvh"));
  EXPECT_THAT(post("save", R"({"flags": {"source": "unknown"}, "file": "other.bvh"})"),
              AllOf(HasSubstr("--source=unknown"), Not(HasSubstr("keyframed"))));
  EXPECT_NE(contents(folder / "other.bvh"), contents(folder / "walk.bvh"));
}

TEST_F(ViewServer, EndsAtOnceWhileConnectionsAreOpen) {
  start_with_walk();
  const Socket idle = connect(), slow = connect();
  slow.send(head("POST " + path + "run", length(1000)));
  expect_served();
  const auto begun = Clock::now();
  program->tell(SIGINT);
  EXPECT_EQ(program->wait(), 0);
  EXPECT_LT(Clock::now() - begun, std::chrono::seconds(2));
}

}  // namespace
}  // namespace kinemend::test
