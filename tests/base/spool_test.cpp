// Tests of spools, in memory and in a temporary file.
#include "base/files.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/extend/random.hpp"

namespace kinemend {
namespace {

namespace fs = std::filesystem;

// Gives each test a temporary folder.
class SpoolTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "kinemend-spool-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    if (const char* before = std::getenv("TMPDIR")) before_ = before;
    use(folder_);
  }
  void TearDown() override {
    before_.empty() ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", before_.c_str(), 1);
    fs::remove_all(folder_);
  }
  static void use(const fs::path& folder) { ::setenv("TMPDIR", folder.c_str(), 1); }

  fs::path folder_;
  std::string before_;
};

std::vector<std::vector<double>> records() {
  std::vector<std::vector<double>> all;
  Random random(3);
  for (const std::size_t size : {5, 0, 400, 1, 3000, 0, 17}) {
    std::vector<double> record(size);
    for (double& value : record) value = random.normal();
    all.push_back(record);
  }
  return all;
}

TEST_F(SpoolTest, GivesBackWhatWasWrittenWhereverItLies) {
  const auto written = records();
  for (const std::size_t most_memory : {std::size_t{0}, std::size_t{3300}, std::size_t{1} << 20}) {
    Spool spool(most_memory);
    for (std::size_t i = 0; i < written.size(); ++i)
      EXPECT_EQ(append_values<double>(spool, written[i]), i);
    EXPECT_EQ(spool.bytes_in_file() > 0, most_memory < 20'000);
    for (std::size_t i = written.size(); i-- > 0;)
      EXPECT_EQ(read_values<double>(spool, i), written[i]) << i;
    const std::vector<double> part(written[4].begin() + 1000, written[4].begin() + 1500);
    EXPECT_EQ(read_values<double>(spool, 4, 1000, 500), part);
  }
}

TEST_F(SpoolTest, HoldsNoMoreInMemoryThanItMay) {
  const auto written = records();
  std::size_t bytes = 0;
  for (const auto& record : written) bytes += record.size() * sizeof(double);
  Spool spool(3300);
  for (const auto& record : written) append_values<double>(spool, record);
  EXPECT_GE(spool.bytes_in_file(), bytes - 3300);
}

TEST_F(SpoolTest, LeavesNothingInTheTemporaryFolderEvenWhileItIsUsed) {
  Spool spool(0);
  append_values<double>(spool, std::vector<double>(100, 1.5));
  EXPECT_TRUE(fs::is_empty(folder_));
  Spool moved = std::move(spool);
  EXPECT_EQ(read_values<double>(moved, 0, 99, 1), std::vector<double>{1.5});
}

TEST_F(SpoolTest, NamesATemporaryFolderThatIsNotThere) {
  use(folder_ / "none");
  Spool spool(16);
  append_values<double>(spool, std::vector<double>{1, 2});  // needs no file
  try {
    append_values<double>(spool, std::vector<double>{3});
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::cannot_write);
    EXPECT_EQ(std::string(error.what()), (folder_ / "none").string() +
                                             ": temporary file: cannot be made: No such file or "
                                             "directory");
  }
  EXPECT_EQ(read_values<double>(spool, 0), (std::vector<double>{1, 2}));
}

}  // namespace
}  // namespace kinemend
