// The snippet of the README: clean a take from C++.
#include <cstdio>

#include "kinemend/kinemend.hpp"

// clean_take TAKE.bvh CLEAN.bvh; takes of markers too
int main(int argc, char** argv) try {
  using namespace kinemend;
  if (argc != 3) return 2;

  const Take noisy = read_take(std::filesystem::path(argv[1])).take;
  const CleanResult result = clean_take(noisy, *make_cleaner("learned"));
  const CleanReport& report = result.report;
  for (const TrackSummary& track : report.tracks) {
    std::printf("%-16s noise %.2f %s, frames repaired: %zu\n", track.name.c_str(), track.noise,
                report.unit.c_str(), track.frames_repaired);
  }
  write_file(argv[2], write_take(result.take), /*overwrite=*/true);  // in the layout of TAKE.bvh
} catch (const kinemend::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return static_cast<int>(error.kind());
}
