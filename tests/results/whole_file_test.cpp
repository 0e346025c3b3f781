// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "folder.hpp"
#include "results/text_file.hpp"
#include "results/whole_file.hpp"
#include <csignal>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

namespace fretwork::results::whole_file_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const core::Error& error) {
    return error.what();
  }
  return {};
}

TEST(WriteWhole, ReplacesTheFileAndLeavesNothingElse) {
  const Folder folder;
  write_bytes(folder / "a", "old");
  write_whole(folder / "a", {"ne", "w"});
  EXPECT_EQ(bytes_of(folder / "a"), "new");
  EXPECT_EQ(folder.files(), 1u);
}

/// While it lives no file grows beyond a size, as on a disk that is full.
class FullDisk {
public:
  explicit FullDisk(rlim_t bytes) : before_(std::signal(SIGXFSZ, SIG_IGN)) {
    (void)getrlimit(RLIMIT_FSIZE, &limit_);
    const rlimit less{bytes, limit_.rlim_max};
    (void)setrlimit(RLIMIT_FSIZE, &less);
  }
  ~FullDisk() {
    (void)setrlimit(RLIMIT_FSIZE, &limit_);
    (void)std::signal(SIGXFSZ, before_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

private:
  rlimit limit_{};
  void (*before_)(int);
};

TEST(WriteWhole, LeavesTheOldFileAndNoOtherWhenAWriteFails) {
  const Folder folder;
  write_bytes(folder / "a", "old");
  std::string message;
  {
    const FullDisk full(1000);
    message = refusal([&] { write_whole(folder / "a", {std::string(600, 'x'), std::string(600, 'y')}); });
  }
  EXPECT_THAT(message, HasSubstr((folder / "a").string() + ": cannot be written: File too large"));
  EXPECT_EQ(bytes_of(folder / "a"), "old");
  EXPECT_EQ(folder.files(), 1u);
}

TEST(WriteWhole, FollowsNoSymbolicLink) {
  const Folder folder;
  write_bytes(folder / "precious", "kept");
  fs::create_symlink(folder / "precious", folder / "a.part.h5");
  write_whole(folder / "a.h5", {"new"});
  EXPECT_EQ(bytes_of(folder / "precious"), "kept");
  EXPECT_EQ(bytes_of(folder / "a.h5"), "new");
  EXPECT_EQ(folder.files(), 2u);
}

TEST(WriteWhole, MakesTheFolder) {
  const Folder folder;
  write_text(folder.path() / "b" / "c" / "a", "text");
  EXPECT_EQ(bytes_of(folder.path() / "b" / "c" / "a"), "text");
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
} // namespace fretwork::results::whole_file_test
