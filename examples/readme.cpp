// The snippet of the README: clean a take from C++.
#include <cstdio>

#include "kinemend/clean.hpp"
#include "kinemend/io.hpp"

int main() {
  using namespace kinemend;

  const Clip noisy = read_clip("takes/noisy_walk.bvh").clip;
  const CleanResult result = clean_clip(noisy, *make_cleaner("auto"));
  for (const TrackSummary& joint : result.report.tracks) {
    std::printf("%-16s noise %.2f degrees, %zu frames repaired\n", joint.name.c_str(), joint.noise,
                joint.frames_repaired);
  }
  const std::string bytes = write_clip(result.clip);  // in the layout of noisy_walk.bvh
  std::printf("%zu bytes\n", bytes.size());
}
