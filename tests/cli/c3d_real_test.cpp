// In real C3D files, an option changes only its own data, or the program names the loss.
#include <cctype>

#include "cli/c3d_law.hpp"
#include "long_tests.hpp"

namespace kinemend::test {
namespace {

class RealC3dFiles : public C3dLaw {};

TEST_F(RealC3dFiles, KeepWhatAnOptionDoesNotConcernOrNameIt) {
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(KINEMEND_DATA_FOLDER)) {
    std::string extension = entry.path().extension();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (extension != ".c3d" || entry.file_size() == 0) continue;
    // Each file takes seconds.
    if (files++ % 4 == 0 || runs_long_tests()) expect_lawful_in_every_option(entry.path());
  }
  EXPECT_GE(files, 90u);
}

}  // namespace
}  // namespace kinemend::test
