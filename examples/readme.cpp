// The snippet of the README: clean a take from C++.
#include <cstdio>

#include "kinemend/clean.hpp"
#include "kinemend/error.hpp"
#include "kinemend/io.hpp"

// clean_take TAKE.bvh CLEAN.bvh
int main(int argc, char** argv) try {
  using namespace kinemend;
  if (argc != 3) return 2;

  const Clip noisy = read_clip(std::filesystem::path(argv[1])).clip;
  const CleanResult result = clean_clip(noisy, *make_cleaner("learned"));
  for (const TrackSummary& joint : result.report.tracks) {
    std::printf("%-16s noise %.2f degrees, %zu frames repaired\n", joint.name.c_str(), joint.noise,
                joint.frames_repaired);
  }
  write_file(argv[2], write_clip(result.clip), /*overwrite=*/true);  // in the layout of TAKE.bvh
} catch (const kinemend::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return static_cast<int>(error.kind());
}
