// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/hash.hpp"
#include "folder.hpp"
#include "results/checksum.hpp"
#include "results/hdf5.hpp"
#include "results/summary_file.hpp"
#include "results/write.hpp"
#include "synthetic.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

namespace fretwork::results::checksum_test {
namespace {

using testing::HasSubstr;

constexpr std::size_t probes = 97; ///< places of a file that are changed, evenly spread

TEST(Checksum, IsThatOfAllAfterTheUserBlock) {
  const Folder folder;
  write_archive(folder / "results.h5", made_up());
  const std::string bytes = bytes_of(folder / "results.h5");
  EXPECT_THAT(bytes.substr(0, user_block_bytes),
              HasSubstr(core::sha256(bytes.substr(user_block_bytes)) + "\n"));
  EXPECT_EQ(checksum_refusal(folder / "results.h5"), "");
}

TEST(Checksum, RevealsAChangeOfAnyByteOfAnArchive) {
  const Folder folder;
  const RunResults results = made_up();
  write_archive(folder / "results.h5", results);
  EXPECT_EQ(archive_refusal(folder / "results.h5", results.record.input_sha256), "");
  const std::string bytes = bytes_of(folder / "results.h5");
  for (std::size_t at = 0; at < bytes.size(); at += bytes.size() / probes) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x80);
    write_bytes(folder / "results.h5", damaged);
    EXPECT_NE(archive_refusal(folder / "results.h5", results.record.input_sha256), "") << "byte " << at;
    EXPECT_THROW((void)read_archive(folder.path()), std::runtime_error) << "byte " << at;
  }
}

TEST(Checksum, OfAnotherRunIsNotThatOfThisOne) {
  const Folder folder;
  write_archive(folder / "results.h5", made_up());
  EXPECT_EQ(archive_refusal(folder / "results.h5", "of other inputs"), "it is of another run");
}

TEST(Checksum, IsNotWaitedForAtAPipe) {
  const Folder folder;
  ASSERT_EQ(mkfifo((folder / "results.h5").c_str(), 0600), 0);
  EXPECT_EQ(checksum_refusal(folder / "results.h5"), "it is no regular file");
}

TEST(Checksum, RevealsAChangeOfAnyByteOfASummary) {
  const Folder folder;
  write_summary(folder / "summary.json", made_up());
  EXPECT_TRUE(read_summary(folder / "summary.json").summary.is_object());
  const std::string text = bytes_of(folder / "summary.json");
  for (std::size_t at = 0; at < text.size(); at += text.size() / probes) {
    std::string changed = text;
    changed[at] = changed[at] == '7' ? '8' : '7';
    write_bytes(folder / "summary.json", changed);
    const FoundSummary found = read_summary(folder / "summary.json");
    EXPECT_TRUE(found.summary.is_null()) << "byte " << at;
    EXPECT_THAT(found.refusal, HasSubstr("summary.json is not as it was written")) << "byte " << at;
  }
}

TEST(Checksum, OfASummaryThatIsNotThereIsNoRefusal) {
  const Folder folder;
  EXPECT_EQ(read_summary(folder / "summary.json").refusal, "");
}

} // namespace
} // namespace fretwork::results::checksum_test
