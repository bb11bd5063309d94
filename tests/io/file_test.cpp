// Tests that files are written completely or not at all, and that formats are recognised by
// content.
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "support.hpp"

namespace kinemend {
namespace {

namespace fs = std::filesystem;
using namespace test;

class Files : public testing::Test {
 protected:
  Files() {
    std::string pattern = (fs::temp_directory_path() / "kinemend-io-XXXXXX").string();
    folder = ::mkdtemp(pattern.data());
  }
  ~Files() override {
    std::error_code ignored;
    fs::permissions(folder, fs::perms::owner_all, ignored);
    fs::remove_all(folder, ignored);
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }
  static mode_t mode(const fs::path& path) {
    struct stat info {};
    ::stat(path.c_str(), &info);
    return info.st_mode & 07777;
  }
  fs::path folder;
};

TEST_F(Files, WhatIsWrittenIsRead) {
  const std::string bytes("a\0b\r\n\xff", 6);
  write_file(folder / "a.bvh", bytes, false);
  EXPECT_EQ(read_file(folder / "a.bvh"), bytes);
  write_file(folder / "empty", "", false);
  EXPECT_EQ(read_file(folder / "empty"), "");
  const std::string large(5 << 20, 'x');
  write_file(folder / "large", large, false);
  EXPECT_EQ(read_file(folder / "large"), large);
  EXPECT_EQ(entries(), 3u);
}

TEST_F(Files, NothingIsReplacedWithoutPermission) {
  const fs::path path = folder / "a.bvh";
  write_file(path, "old", false);
  EXPECT_EQ(message_of([&] { write_file(path, "new", false); }, ErrorKind::cannot_write),
            path.string() + ": exists already and may not be replaced");
  EXPECT_EQ(read_file(path), "old");
  write_file(path, "new", true);
  EXPECT_EQ(read_file(path), "new");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(Files, ReplacingKeepsThePermissions) {
  const fs::path path = folder / "a.bvh";
  write_file(path, "old", false);
  const mode_t mask = ::umask(0);
  ::umask(mask);
  EXPECT_EQ(mode(path), 0666 & ~mask);
  ::chmod(path.c_str(), 0640);
  write_file(path, "new", true);
  EXPECT_EQ(mode(path), 0640u);
}

TEST_F(Files, ASymbolicLinkStaysOne) {
  write_file(folder / "target", "old", false);
  fs::create_symlink("target", folder / "link");
  EXPECT_THROW(write_file(folder / "link", "new", false), Error);
  write_file(folder / "link", "new", true);
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(read_file(folder / "target"), "new");
  EXPECT_EQ(entries(), 2u);
}

TEST_F(Files, FailuresLeaveNothingBehind) {
  EXPECT_EQ(
      message_of([&] { write_file(folder / "none" / "a", "x", true); }, ErrorKind::cannot_write),
      (folder / "none" / "a").string() + ": No such file or directory");
  EXPECT_EQ(message_of([&] { write_file(folder, "x", true); }, ErrorKind::cannot_write),
            folder.string() + ": Is a directory");
  // The name of the finished file is too long; that of the temporary file is not.
  const fs::path long_name = folder / std::string(300, 'n');
  EXPECT_EQ(message_of([&] { write_file(long_name, "x", true); }, ErrorKind::cannot_write),
            long_name.string() + ": File name too long");
  EXPECT_EQ(entries(), 0u);
}

TEST_F(Files, ReadOnlyPlacesAreRespected) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  const fs::path path = folder / "a.bvh";
  write_file(path, "old", false);
  ::chmod(path.c_str(), 0444);
  EXPECT_EQ(message_of([&] { write_file(path, "new", true); }, ErrorKind::cannot_write),
            path.string() + ": Permission denied");
  ::chmod(folder.c_str(), 0555);
  EXPECT_THROW(write_file(folder / "b.bvh", "new", true), Error);
  EXPECT_EQ(entries(), 1u);
}

TEST_F(Files, DevicesAreWrittenTo) {
  write_file("/dev/null", "gone", false);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  if (fs::exists("/dev/full")) {
    EXPECT_EQ(message_of([] { write_file("/dev/full", "x", false); }, ErrorKind::cannot_write),
              "/dev/full: No space left on device");
  }
  EXPECT_EQ(read_file("/dev/null"), "");
}

TEST_F(Files, RelativeNamesGoToTheCurrentFolder) {
  const fs::path before = fs::current_path();
  fs::current_path(folder);
  write_file("plain.bvh", "x", false);
  fs::current_path(before);
  EXPECT_EQ(read_file(folder / "plain.bvh"), "x");
  EXPECT_EQ(entries(), 1u);
}

// All formats, as listed in messages.
std::string format_names() {
  std::string names;
  for (const Format& format : formats())
    names += (names.empty() ? "" : ", ") + std::string(format.name);
  return names;
}

TEST(Formats, AreFoundByContentThenByName) {
  const std::string text = read_file(fixture("good/plain.bvh"));
  EXPECT_EQ(read_joints(text, "take").take.source.format, "bvh");
  EXPECT_EQ(read_joints(text, "take.trc").take.source.name, "take.trc");
  EXPECT_EQ(message_of([] { read_joints(std::string("garbage"), "take.BVH"); },
                       ErrorKind::unreadable_input),
            "take.BVH:1: expected HIERARCHY, found \"garbage\"");
  EXPECT_EQ(
      message_of([] { read_joints(std::string("garbage"), "take"); }, ErrorKind::unreadable_input),
      "take:1: not a motion file of a known format (bvh, amc, asf, c3d, trc, tsv, csv, "
      "glb, gltf, fbx, npz)");
  EXPECT_EQ(message_of([] { read_joints(std::string(), "take"); }, ErrorKind::unreadable_input),
            "take:1: the file is empty");
  ReadOptions options;
  options.format = "obj";
  EXPECT_EQ(read_error(text, options, ErrorKind::usage),
            "unknown format \"obj\"; the formats are: " + format_names());
  EXPECT_EQ(message_of([] { write_take(Take{}, "obj"); }, ErrorKind::usage),
            "unknown format \"obj\"; the formats are: " + format_names());
  ASSERT_NE(format_of_path("a/b.Bvh"), nullptr);
  EXPECT_EQ(format_of_path("a/b.Bvh")->name, "bvh");
  EXPECT_EQ(format_of_path("bvh"), nullptr);
}

TEST(Formats, APointerOfGitLfsIsNamed) {
  EXPECT_EQ(message_of(
                [] {
                  read_take(
                      "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 1534272\n",
                      "a.fbx");
                },
                ErrorKind::unreadable_input),
            "a.fbx:1: a Git LFS pointer: the file itself (1,534,272 bytes) was not downloaded; git "
            "lfs pull does that");
  EXPECT_EQ(message_of([] { read_take("version https://git-lfs.github.com/spec/v1\n", "a.fbx"); },
                       ErrorKind::unreadable_input),
            "a.fbx:1: a Git LFS pointer: the file itself was not downloaded");
}

TEST(Formats, AnimationsOfAvatarsAreGltf) { EXPECT_EQ(format_of_path("a.vrma")->name, "glb"); }

TEST(Formats, BvhIsSniffedThroughMarksAndComments) {
  const Format& bvh = formats()[0];
  EXPECT_EQ(bvh.sniff("HIERARCHY"), 100);
  EXPECT_EQ(bvh.sniff("\xEF\xBB\xBF\r\n hierarchy\r\nROOT"), 100);
  EXPECT_EQ(bvh.sniff("# exported\nHIERARCHY"), 100);
  EXPECT_EQ(bvh.sniff("ROOT Hips"), 60);
  EXPECT_EQ(bvh.sniff("HIERARCHYX"), 0);
  EXPECT_EQ(bvh.sniff(""), 0);
}

}  // namespace
}  // namespace kinemend
