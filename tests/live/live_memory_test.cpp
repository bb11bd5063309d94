// After warm-up, a line of text in a live stream allocates no memory.
#include "counting_allocation.hpp"

#include "kinemend/methods.hpp"
#include "live_run.hpp"

#if !defined(KINEMEND_SANITIZED) && defined(__GLIBC__)

namespace kinemend::test {
namespace {

TEST(LiveMemory, ALineOfTextTakesNoneOnceTheStreamIsWarm) {
  const StreamText stream = stream_text(noisy_clip(400));
  for (const LiveMethod& method : live_methods()) {
    for (const LiveFormat format : {LiveFormat::bvh, LiveFormat::jsonl}) {
      const auto cleaner = make_cleaner(method.name, method.options);
      LiveOptions options;
      options.format = format;
      options.strength = 0.5;
      std::size_t bytes = 0;
      LiveSession session(*cleaner, options,
                          [&](const LivePiece& piece) { bytes += piece.text.size(); });
      session.feed(stream.header);
      for (std::size_t f = 0; f < 300; ++f) session.feed(stream.frames[f]);
      const std::size_t before = memory_taken;
      for (std::size_t f = 300; f < 400; ++f) session.feed(stream.frames[f]);
      EXPECT_EQ(memory_taken - before, 0) << method.name;
      EXPECT_GT(bytes, 0);
    }
  }
}

}  // namespace
}  // namespace kinemend::test

#endif
