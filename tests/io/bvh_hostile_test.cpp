#include <malloc.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <new>

#include "kinemend/random.hpp"
#include "support.hpp"

#if !defined(__SANITIZE_ADDRESS__)
#define KINEMEND_COUNTS_MEMORY 1

namespace {

std::atomic<std::size_t> memory_now{0}, memory_peak{0};

void* count(void* block) {
  if (block == nullptr) throw std::bad_alloc();
  const std::size_t now = memory_now += ::malloc_usable_size(block);
  std::size_t peak = memory_peak;
  while (now > peak && !memory_peak.compare_exchange_weak(peak, now)) {
  }
  return block;
}

void uncount(void* block) {
  if (block != nullptr) memory_now -= ::malloc_usable_size(block);
  std::free(block);
}

}  // namespace

void* operator new(std::size_t size) { return count(std::malloc(size)); }
void* operator new[](std::size_t size) { return count(std::malloc(size)); }
void operator delete(void* block) noexcept { uncount(block); }
void operator delete[](void* block) noexcept { uncount(block); }
void operator delete(void* block, std::size_t) noexcept { uncount(block); }
void operator delete[](void* block, std::size_t) noexcept { uncount(block); }
#endif

namespace kinemend {
namespace {

using namespace test;

// Most memory that `action` held at once beyond what was held before; 0 where it is not counted.
template <class Action>
std::size_t peak_memory(Action&& action) {
#if defined(KINEMEND_COUNTS_MEMORY)
  const std::size_t before = memory_now;
  memory_peak = before;
  action();
  return memory_peak - before;
#else
  action();
  return 0;
#endif
}

constexpr std::size_t memory_allowed = 50u << 20;

// Whatever the bytes are: a clip that keeps the rules and writes back the same, or an error that
// names the file.
void expect_clip_or_error(const std::string& bytes) {
  const std::size_t peak = peak_memory([&] {
    try {
      const Clip clip = read_clip(bytes, "take.bvh").clip;
      clip.validate();
      ASSERT_EQ(write_clip(clip), bytes);
    } catch (const Error& error) {
      const std::string message = error.what();
      ASSERT_EQ(error.kind(), ErrorKind::unreadable_input) << message;
      ASSERT_EQ(message.substr(0, 9), "take.bvh:") << message;
      ASSERT_EQ(message.find_first_of("\r\n"), message.npos);
    }
  });
  ASSERT_LT(peak, memory_allowed);
}

std::vector<std::string> all_fixtures() {
  std::vector<std::string> texts;
  for (const char* folder : {"good", "bad", "found"}) {
    if (!std::filesystem::exists(fixture(folder))) continue;
    for (const auto& path : fixtures_in(folder)) texts.push_back(read_file(path));
  }
  return texts;
}

TEST(HostileBvh, EveryFixtureIsReadOrRefused) {
  for (const std::string& text : all_fixtures()) expect_clip_or_error(text);
}

TEST(HostileBvh, CutAtAnyLength) {
  for (const std::string& text : all_fixtures()) {
    for (std::size_t length = 0; length < text.size(); ++length) {
      ASSERT_NO_FATAL_FAILURE(expect_clip_or_error(text.substr(0, length)));
    }
  }
}

TEST(HostileBvh, PatchedAtAnyByte) {
  Random random(99);
  const std::string likely = std::string("{} \n\r\t.-,#/0915eEnN:", 20) + '\0';
  for (const std::string& text : all_fixtures()) {
    for (std::size_t at = 0; at < text.size(); ++at) {
      std::string patched = text;
      const std::size_t count = 1 + random.below(3);
      for (std::size_t i = 0; i < count && at + i < text.size(); ++i) {
        patched[at + i] = random.chance(0.7) ? likely[random.below(likely.size())]
                                             : static_cast<char>(random.below(256));
      }
      ASSERT_NO_FATAL_FAILURE(expect_clip_or_error(patched));
    }
  }
}

TEST(HostileBvh, PiecesMovedAndRepeated) {
  Random random(100);
  const auto texts = all_fixtures();
  for (int i = 0; i < 3000; ++i) {
    std::string text = texts[random.below(texts.size())];
    const std::string& other = texts[random.below(texts.size())];
    if (text.empty() || other.empty()) continue;
    const std::size_t from = random.below(other.size());
    text.insert(random.below(text.size()), other.substr(from, random.below(200)));
    ASSERT_NO_FATAL_FAILURE(expect_clip_or_error(text));
  }
}

std::string repeated(const std::string& piece, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += piece;
  return text;
}

TEST(HostileBvh, LargeNonsenseIsRefusedQuicklyAndInLittleMemory) {
  const std::string head =
      "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n";
  const std::string motion = "MOTION\nFrames: 1000000\nFrame Time: 0.01\n";
  Random random(8);
  std::string noise(1 << 20, '\0');
  for (char& c : noise) c = static_cast<char>(random.below(256));
  const std::pair<const char*, std::string> files[] = {
      {"deep nesting", "HIERARCHY\nROOT a{" + repeated("JOINT a{", 100000)},
      {"many joints", head + repeated("JOINT a{}", 200000) + "}" + motion},
      {"many end sites", head + repeated("End Site{}", 200000) + "}" + motion},
      {"fixed joints, many frames",
       head + repeated("JOINT a{}", 10000) + "}\nMOTION\nFrame Time: 1\n" + repeated("0 ", 300000)},
      {"no channels, many frames", "HIERARCHY\nROOT a{OFFSET 0 0 0}" + motion},
      {"noise", noise},
      {"noise as motion", head + "}" + motion + noise},
      {"zero bytes", std::string(1 << 20, '\0')},
      {"one endless word", head + "}" + motion + std::string(1 << 20, '1')},
      {"one endless name", "HIERARCHY\nROOT " + std::string(1 << 20, 'n')},
      {"not a number", head + "}" + motion + repeated("nan ", 300000)},
      {"comments", head + "}" + motion + repeated("#\n", 500000)},
      {"commas", head + "}" + motion + repeated("0,", 500000)},
      {"commas in an offset", "HIERARCHY\nROOT a{OFFSET 1 2" + repeated(" ,", 500000) + "3"},
      {"braces", "HIERARCHY\nROOT a" + repeated("{", 500000)},
      {"uneven lines", head + "}" + motion + repeated("0 0\n0 0 0\n", 100000)},
  };
  for (const auto& [name, bytes] : files) {
    SCOPED_TRACE(name);
    const auto start = std::chrono::steady_clock::now();
    const std::size_t peak = peak_memory([&, text = bytes]() mutable {
      try {
        read_clip(std::move(text), "take.bvh").clip.validate();
      } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).substr(0, 9), "take.bvh:") << error.what();
      }
    });
    EXPECT_LT(peak, memory_allowed);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
  }
}

}  // namespace
}  // namespace kinemend
