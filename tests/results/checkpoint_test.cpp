// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "folder.hpp"
#include "results/checkpoint.hpp"
#include <fstream>
#include <gmock/gmock.h>

namespace fretwork::results::checkpoint_test {
namespace {

using testing::HasSubstr;

const RunIdentity mine{"1.2", "abc", 3, "f00"};

std::string made_up_state() {
  std::string state(10'000, '\0');
  for (std::size_t i = 0; i < state.size(); ++i)
    state[i] = static_cast<char>(i * i);
  return state;
}

TEST(Checkpoint, ComesBackBitForBit) {
  const Folder folder;
  write_checkpoint(folder / "checkpoint.h5", mine, {0.1, "short"});
  write_checkpoint(folder / "checkpoint.h5", mine, {0.25, made_up_state()}); // takes the place of the first
  const FoundCheckpoint found = read_checkpoint(folder / "checkpoint.h5", mine);
  ASSERT_TRUE(found.checkpoint);
  EXPECT_EQ(found.checkpoint->time, 0.25);
  EXPECT_EQ(found.checkpoint->state, made_up_state());
  EXPECT_EQ(found.refusal, "");
}

TEST(Checkpoint, ThatIsNotThereIsNoRefusal) {
  const Folder folder;
  const FoundCheckpoint found = read_checkpoint(folder / "checkpoint.h5", mine);
  EXPECT_FALSE(found.checkpoint);
  EXPECT_EQ(found.refusal, "");
}

TEST(Checkpoint, OfAnotherRunIsRefused) {
  const Folder folder;
  write_checkpoint(folder / "checkpoint.h5", mine, {0.1, made_up_state()});
  const auto refusal = [&](const RunIdentity& wanted) {
    const FoundCheckpoint found = read_checkpoint(folder / "checkpoint.h5", wanted);
    EXPECT_FALSE(found.checkpoint);
    return found.refusal;
  };
  EXPECT_THAT(refusal({"1.2", "abc", 3, "f01"}),
              HasSubstr("was written by another build of version 1.2 of the program: the run starts again"));
  EXPECT_THAT(refusal({"1.3", "abc", 3, "f00"}), HasSubstr("is of version 1.2 of the program, this is 1.3"));
  EXPECT_THAT(refusal({"1.2", "abd", 3, "f00"}), HasSubstr("belongs to other inputs: the run starts again"));
  EXPECT_THAT(refusal({"1.2", "abc", 2, "f00"}), HasSubstr("belongs to other inputs"));
}

TEST(Checkpoint, ThatIsDamagedIsRefused) {
  const Folder folder;
  const auto file = folder / "checkpoint.h5";
  write_checkpoint(file, mine, {0.1, made_up_state()});
  std::ifstream in(file, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  const auto refused_as = [&](const std::string& bytes) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
    const FoundCheckpoint found = read_checkpoint(file, mine);
    EXPECT_FALSE(found.checkpoint);
    EXPECT_THAT(found.refusal, HasSubstr("is damaged: the run starts again"));
  };
  std::string changed = whole;
  changed[whole.find(made_up_state()) + 5000] ^= 1; // of the state, one bit
  refused_as(changed);
  refused_as(whole.substr(0, whole.size() / 2));
  refused_as("");
  refused_as("no HDF5 at all");
}

TEST(Checkpoint, ThatCannotBeWrittenIsAnError) {
  const Folder folder;
  std::ofstream(folder / "file") << "in the way";
  EXPECT_THROW(write_checkpoint(folder / "file" / "checkpoint.h5", mine, {0.1, "x"}), core::Error);
}

} // namespace
} // namespace fretwork::results::checkpoint_test
