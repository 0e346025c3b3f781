// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/child_process.hpp"
#include "core/confinement.hpp"
#include "core/error.hpp"
#include "core/temporary_directory.hpp"
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace child_process_test {

using fretwork::core::Confinement;
using fretwork::core::run_child;

TEST(ChildProcess, GivesStatusAndBothOutputs) {
  const auto result = run_child({"sh", "-c", "echo out; echo err >&2; exit 7"});
  EXPECT_EQ(result.status, 7);
  EXPECT_EQ(result.output, "out\nerr\n");
}

TEST(ChildProcess, TellsASignal) { EXPECT_EQ(run_child({"sh", "-c", "kill -SEGV $$"}).status, 128 + 11); }

TEST(ChildProcess, TellsAMissingProgram) {
  const auto result = run_child({"no-such-program-anywhere"});
  EXPECT_EQ(result.status, 127);
  EXPECT_NE(result.output.find("no-such-program-anywhere"), std::string::npos);
}

TEST(ChildProcess, ReadsMoreThanAPipeHolds) {
  EXPECT_EQ(run_child({"sh", "-c", "head -c 1000000 /dev/zero | tr '\\0' x"}).output.size(), 1000000u);
}

TEST(ChildProcess, EndsAChildThatTakesTooLongAndItsChildren) {
  constexpr double most_seconds = 20.0; // a busy machine; the child would take an hour
  const auto begin = std::chrono::steady_clock::now();
  const auto result = run_child({"sh", "-c", "sleep 3600 & sleep 3600; echo no"}, {.seconds = 0.2});
  EXPECT_NE(result.stopped.find("it ran for more than"), std::string::npos);
  EXPECT_EQ(result.status, 128 + SIGKILL);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), most_seconds);
}

TEST(ChildProcess, EndsAChildThatWritesTooMuch) {
  const auto result = run_child({"yes"}, {.seconds = 60.0, .output_bytes = 100'000});
  EXPECT_EQ(result.stopped, "it wrote more than 100000 bytes of messages");
  EXPECT_EQ(result.status, 128 + SIGKILL);
}

TEST(ChildProcess, LimitsFiles) {
  EXPECT_EQ(run_child({"sh", "-c", "ulimit -f"}, {.file_bytes = 1ull << 20}).output, "2048\n");
}

TEST(ChildProcess, LimitsMemory) { // not under the sanitizers: tests/sanitize.sh
  EXPECT_EQ(run_child({"sh", "-c", "ulimit -v"}, {.memory_bytes = 1ull << 30}).output, "1048576\n");
}

/// Runs `script` in a child process of its own that runs it by run_child, kills that child by `signal` when the script has written its process
/// number to `file`, and tells whether the script outlives it.
bool script_outlives_its_parent(const std::string& file, int signal) {
  const pid_t parent = fork();
  if (parent == 0) {
    try {
      (void)run_child(
          {"sh", "-c", "echo $$ > " + file + ".part; mv " + file + ".part " + file + "; exec sleep 3600"});
    } catch (const fretwork::core::ComputationError&) {
    }
    _exit(0);
  }
  const auto moment = std::chrono::milliseconds(10);
  constexpr int most_moments = 2000; // 20 s
  for (int i = 0; i < most_moments && !std::filesystem::exists(file); ++i)
    std::this_thread::sleep_for(moment);
  pid_t script = 0;
  std::ifstream(file) >> script;
  (void)kill(parent, signal);
  (void)waitpid(parent, nullptr, 0);
  for (int i = 0; i < most_moments && script > 0; ++i) {
    std::string state; // a zombie that nobody waits for has ended too
    std::ifstream stat("/proc/" + std::to_string(script) + "/stat");
    std::string number, name;
    if (!(stat >> number >> name >> state) || state == "Z")
      return false;
    std::this_thread::sleep_for(moment);
  }
  return true;
}

TEST(ChildProcess, DiesWithItsParent) {
  const auto folder = std::filesystem::temp_directory_path() / ("fretwork_child_" + std::to_string(getpid()));
  std::filesystem::create_directory(folder);
  EXPECT_FALSE(script_outlives_its_parent((folder / "killed").string(), SIGKILL));
  EXPECT_FALSE(script_outlives_its_parent((folder / "ended").string(), SIGTERM));
  std::filesystem::remove_all(folder);
}

TEST(ChildProcess, IsGivenNoOpenFilesOfItsParent) {
  const fretwork::core::TemporaryDirectory folder;
  const std::string file = (folder.path() / "a").string();
  const int open_file = open(file.c_str(), O_WRONLY | O_CREAT, 0600); // without O_CLOEXEC
  ASSERT_GE(open_file, 0);
  EXPECT_NE(run_child({"sh", "-c", "echo text >&" + std::to_string(open_file)}).status, 0);
  (void)close(open_file);
  EXPECT_EQ(std::filesystem::file_size(file), 0u);
}

TEST(ChildProcess, WithALimitOfTimeHasASessionAndNoTerminal) {
  // its process, its state, its parent, its group, its session
  const auto result = run_child(
      {"sh", "-c", "read -r all < /proc/self/stat; set -- $all; echo $(($1 - $6)) $7"}, {.seconds = 60.0});
  EXPECT_EQ(result.output, "0 0\n");
}

class Confined : public testing::Test {
protected:
  /// Makes a system call in a confined process. @return its errno; 0: it went well
  template <class Call> static int error_of(const Confinement& confinement, Call call) {
    const pid_t child = fork();
    if (child == 0)
      _exit(!confinement.enforce() ? 255 : call() >= 0 ? 0 : errno);
    int status = 0;
    (void)waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  void SetUp() override {
    if (!Confinement::available())
      GTEST_SKIP() << "this kernel has no Landlock or no seccomp";
  }
  fretwork::core::TemporaryDirectory folder_, outside_;
};

TEST_F(Confined, ChildrenWriteInOneFolderOnly) {
  const Confinement confinement(folder_.path());
  const auto write = [&](const std::filesystem::path& file) {
    return run_child({"/bin/sh", "-c", "echo text > " + file.string()}, {}, &confinement).status;
  };
  EXPECT_EQ(write(folder_.path() / "a"), 0);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "a"));
  EXPECT_NE(write(outside_.path() / "a"), 0);
  EXPECT_FALSE(std::filesystem::exists(outside_.path() / "a"));
  std::filesystem::create_symlink(outside_.path() / "a", folder_.path() / "link");
  EXPECT_NE(write(folder_.path() / "link"), 0);
  EXPECT_FALSE(std::filesystem::exists(outside_.path() / "a"));
}

TEST_F(Confined, ChildrenStartNoProcess) {
  const Confinement confinement(folder_.path());
  EXPECT_EQ(run_child({"/bin/sh", "-c", "/bin/true; echo still here"}, {}, &confinement).status,
            128 + fretwork::core::process_refused);
}

TEST_F(Confined, ChildrenRemoveAndChangeNothingElse) {
  const Confinement confinement(folder_.path());
  const auto file = outside_.path() / "a";
  std::ofstream(file) << "kept";
  for (const char* command : {"rm", "chmod 777", "truncate -s 0", "touch -d 2001-01-01"}) {
    const auto before = std::filesystem::last_write_time(file);
    EXPECT_NE(
        run_child({"/bin/sh", "-c", std::string("exec ") + command + " " + file.string()}, {}, &confinement)
            .status,
        0)
        << command;
    ASSERT_TRUE(std::filesystem::exists(file)) << command;
    EXPECT_EQ(std::filesystem::file_size(file), 4u) << command;
    EXPECT_EQ(std::filesystem::last_write_time(file), before) << command;
  }
}

TEST_F(Confined, ChildrenEmptyNoFileByOpeningItForReading) {
  const Confinement confinement(folder_.path());
  const auto file = outside_.path() / "a";
  std::ofstream(file) << "kept";
  for (const int access : {O_RDONLY, O_ACCMODE, O_WRONLY})
    EXPECT_NE(error_of(confinement, [&] { return open(file.c_str(), access | O_TRUNC); }), 0) << access;
  EXPECT_NE(error_of(confinement, [&] { return syscall(SYS_open, file.c_str(), O_RDONLY | O_TRUNC); }), 0);
  EXPECT_EQ(std::filesystem::file_size(file), 4u);
  EXPECT_EQ(error_of(confinement, [&] { return open(file.c_str(), O_RDONLY); }), 0);
  const auto own = folder_.path() / "a";
  EXPECT_EQ(error_of(confinement, [&] { return open(own.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600); }), 0);
}

TEST_F(Confined, ChildrenHaveNoCallsOfLaterKernels) {
  const Confinement confinement(folder_.path());
  const auto file = outside_.path() / "a";
  std::ofstream(file) << "kept";
  std::filesystem::permissions(file, std::filesystem::perms::owner_read);
  constexpr long fchmodat2 = 452; // of Linux 6.6
  EXPECT_EQ(error_of(confinement, [&] { return syscall(fchmodat2, AT_FDCWD, file.c_str(), 0777, 0); }),
            ENOSYS);
  EXPECT_EQ(std::filesystem::status(file).permissions(), std::filesystem::perms::owner_read);
}

TEST_F(Confined, ChildrenSendNoSignals) {
  const Confinement confinement(folder_.path());
  const pid_t self = getpid();
  EXPECT_EQ(error_of(confinement, [&] { return kill(self, 0); }), EPERM);
  EXPECT_EQ(error_of(confinement, [&] { return syscall(SYS_tgkill, self, self, 0); }), EPERM);
}

TEST(TemporaryDirectory, IsRemovedAlsoWhereItsProcessWasKilled) {
  const auto left_over = std::filesystem::temp_directory_path() / "fretwork-KiLLeD";
  std::filesystem::create_directory(left_over);
  std::ofstream(left_over / "a") << "text";
  std::filesystem::last_write_time(left_over,
                                   std::filesystem::file_time_type::clock::now() - std::chrono::hours(1));
  std::filesystem::path path;
  {
    const fretwork::core::TemporaryDirectory fresh;
    path = fresh.path();
    EXPECT_FALSE(std::filesystem::exists(left_over));
    const fretwork::core::TemporaryDirectory another;
    EXPECT_TRUE(std::filesystem::exists(path)) << "a folder in use";
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

} // namespace child_process_test
