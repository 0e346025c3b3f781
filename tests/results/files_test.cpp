// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "folder.hpp"
#include "results/text_file.hpp"
#include "results/write.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fretwork::results {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(WriteWhole, ReplacesTheFileAndLeavesNothingElse) {
  const Folder folder;
  write_bytes(folder / "a", "old");
  write_whole(folder / "a", [](const fs::path& part) { write_bytes(part, "new"); });
  EXPECT_EQ(bytes_of(folder / "a"), "new");
  EXPECT_EQ(folder.files(), 1u);
}

TEST(WriteWhole, KeepsTheOldFileWhileTheNewOneIsWritten) {
  const Folder folder;
  write_bytes(folder / "a", "old");
  write_whole(folder / "a", [&](const fs::path& part) {
    EXPECT_NE(part, folder / "a");
    EXPECT_EQ(bytes_of(folder / "a"), "old");
    write_bytes(part, "new");
  });
}

TEST(WriteWhole, LeavesTheOldFileAndNoOtherWhenTheWriterFails) {
  const Folder folder;
  write_bytes(folder / "a", "old");
  const auto failing = [](const fs::path& part) {
    write_bytes(part, "half");
    throw core::Error("the writer's own message");
  };
  try {
    write_whole(folder / "a", failing);
    FAIL() << "the error was lost";
  } catch (const core::Error& error) {
    EXPECT_STREQ(error.what(), "the writer's own message");
  }
  EXPECT_EQ(bytes_of(folder / "a"), "old");
  EXPECT_EQ(folder.files(), 1u);
}

TEST(WriteWhole, MakesTheFolder) {
  const Folder folder;
  write_text(folder.path() / "b" / "c" / "a", "text");
  EXPECT_EQ(bytes_of(folder.path() / "b" / "c" / "a"), "text");
}

std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const core::Error& error) {
    return error.what();
  }
  return {};
}

TEST(WriteWhole, NamesTheFileWhenItsFolderIsAFile) {
  const Folder folder;
  write_bytes(folder / "a", "not a folder");
  const std::string message = refusal([&] { write_text(folder.path() / "a" / "b", "text"); });
  EXPECT_THAT(message, HasSubstr((folder.path() / "a" / "b").string() + ": cannot be written"));
  EXPECT_THAT(message, HasSubstr("check the folder, its permissions and the space left"));
}

TEST(WriteWhole, NamesTheFileWhenItIsAFolder) {
  const Folder folder;
  fs::create_directories(folder.path() / "a" / "b");
  const std::string message = refusal([&] { write_text(folder / "a", "text"); });
  EXPECT_THAT(message, HasSubstr((folder / "a").string() + ": cannot be written"));
  EXPECT_EQ(folder.files(), 1u);
}

TEST(WriteText, NamesTheFileWhenTheDiskIsFull) {
  if (!fs::exists("/dev/full"))
    GTEST_SKIP() << "no /dev/full on this system";
  const Folder folder;
  fs::create_symlink("/dev/full", folder / "a.part");
  const std::string message = refusal([&] { write_text(folder / "a", std::string(100000, 'x')); });
  EXPECT_THAT(message, HasSubstr((folder / "a").string() + ": cannot be written"));
  EXPECT_EQ(folder.files(), 0u);
}

TEST(PathName, KeepsUsualNamesAndTellsOthersApart) {
  EXPECT_EQ(path_name("tsp[0] (hot)-1.5"), "tsp[0] (hot)-1.5");
  EXPECT_EQ(path_name("leg/tsp"), "leg%2Ftsp");
  EXPECT_EQ(path_name("leg%2Ftsp"), "leg%252Ftsp");
  EXPECT_EQ(path_name("."), "%2E");
  EXPECT_EQ(path_name(".."), "%2E.");
  EXPECT_EQ(path_name("a\nb"), "a%0Ab");
  EXPECT_EQ(path_name("t\xc3\xb4le"), "t\xc3\xb4le");
}

} // namespace
} // namespace fretwork::results
