// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "core/input_file.hpp"
#include "core/temporary_directory.hpp"
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <sys/stat.h>

namespace fretwork::core::input_file_test {
namespace {

std::string refusal(const std::filesystem::path& file, std::uintmax_t most = 0) {
  try {
    (void)read_input_file(file, "file a", most);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(InputFile, IsRead) {
  const TemporaryDirectory folder;
  std::ofstream(folder.path() / "a") << std::string("te\0xt", 5);
  EXPECT_EQ(read_input_file(folder.path() / "a", "file a"), std::string("te\0xt", 5));
}

TEST(InputFile, IsARegularFile) {
  const TemporaryDirectory folder;
  ASSERT_EQ(mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
  EXPECT_TRUE(says(refusal(folder.path() / "pipe"), "file a is not a regular file"));
  EXPECT_TRUE(says(refusal("/dev/zero"), "file a is not a regular file"));
  EXPECT_TRUE(says(refusal(folder.path()), "file a is a directory"));
  EXPECT_TRUE(says(refusal(folder.path() / "none"), "file a does not exist"));
}

TEST(InputFile, HasALimit) {
  const TemporaryDirectory folder;
  std::ofstream(folder.path() / "a") << "12345";
  EXPECT_EQ(refusal(folder.path() / "a", 5), "");
  EXPECT_TRUE(says(refusal(folder.path() / "a", 4), "file a has 5 bytes, more than 4"));
}

} // namespace
} // namespace fretwork::core::input_file_test
