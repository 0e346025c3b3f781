// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/child_process.hpp"
#include "core/confinement.hpp"
#include "core/error.hpp"
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fretwork::core {
namespace {

constexpr int not_started = 127;
constexpr int of_a_signal = 128;
constexpr std::chrono::milliseconds between_looks{50}; ///< at the clock and at signals

volatile std::sig_atomic_t ended_by = 0; ///< the signal that is to end this process

/// While it lives a signal that would end this process is noted instead.
class NotedSignals {
public:
  NotedSignals() {
    ended_by = 0;
    for (std::size_t i = 0; i < signals.size(); ++i) {
      struct sigaction note {};
      note.sa_handler = [](int signal) { ended_by = signal; };
      (void)sigaction(signals[i], nullptr, &before_[i]);
      if (before_[i].sa_handler == SIG_DFL)
        (void)sigaction(signals[i], &note, nullptr);
    }
  }
  ~NotedSignals() {
    for (std::size_t i = 0; i < signals.size(); ++i)
      (void)sigaction(signals[i], &before_[i], nullptr);
  }
  NotedSignals(const NotedSignals&) = delete;
  NotedSignals& operator=(const NotedSignals&) = delete;

private:
  static constexpr std::array<int, 3> signals{SIGTERM, SIGINT, SIGHUP};
  std::array<struct sigaction, 3> before_{};
};

void limit(decltype(RLIMIT_AS) resource, std::uint64_t most) {
  const rlimit value{most, most};
  if (most > 0)
    (void)setrlimit(resource, &value);
}

/// The child between fork and exec: system calls only. @return only if it cannot become the program
void become(char* const* argv, int output, pid_t parent, const ChildLimits& limits,
            const Confinement* confinement) {
  (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent)
    _exit(not_started); // it has died before the line above
  if (limits.seconds > 0.0)
    (void)setsid(); // a group that can be ended as a whole, without a terminal to type into
  const int nothing = open("/dev/null", O_RDONLY);
  (void)dup2(nothing, STDIN_FILENO);
  (void)dup2(output, STDOUT_FILENO);
  (void)dup2(output, STDERR_FILENO);
  (void)close_range(STDERR_FILENO + 1, ~0u,
                    CLOSE_RANGE_CLOEXEC); // what this process was given is not the child's
#ifndef FRETWORK_SANITIZED                // whose shadow memory alone spans 16 TB of addresses
  limit(RLIMIT_AS, limits.memory_bytes);
#endif
  limit(RLIMIT_FSIZE, limits.file_bytes);
  if (confinement && !confinement->enforce())
    return;
  (void)execvp(argv[0], argv);
}

/// Reads until all writers have closed their ends, or a limit is passed. @return why it stopped; empty: they have
std::string read_all(int end, const ChildLimits& limits, std::string& output) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  std::array<char, 65536> buffer;
  for (;;) {
    pollfd waiting{end, POLLIN, 0};
    const int ready = poll(&waiting, 1, static_cast<int>(between_looks.count()));
    if (ended_by != 0)
      return strsignal(ended_by);
    if (limits.seconds > 0.0 && std::chrono::duration<double>(Clock::now() - begin).count() > limits.seconds)
      return "it ran for more than " + std::to_string(std::lround(limits.seconds)) + " s";
    if (ready <= 0)
      continue;
    const ssize_t got = read(end, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR)
      continue;
    if (got <= 0)
      return {};
    output.append(buffer.data(), static_cast<std::size_t>(got));
    if (limits.output_bytes > 0 && output.size() > limits.output_bytes)
      return "it wrote more than " + std::to_string(limits.output_bytes) + " bytes of messages";
  }
}

} // namespace

ChildResult run_child(const std::vector<std::string>& arguments, const ChildLimits& limits,
                      const Confinement* confinement) {
  int ends[2], failures[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    return {not_started, std::string("no pipe: ") + std::strerror(errno)};
  if (pipe2(failures, O_CLOEXEC) != 0) {
    const int failure = errno;
    (void)close(ends[0]);
    (void)close(ends[1]);
    return {not_started, std::string("no pipe: ") + std::strerror(failure)};
  }
  std::vector<char*> argv;
  for (const auto& argument : arguments)
    argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const NotedSignals noted;
  const pid_t parent = getpid(), child = fork();
  if (child == 0) {
    become(argv.data(), ends[1], parent, limits, confinement);
    const int failure = errno;
    (void)!write(failures[1], &failure, sizeof failure);
    _exit(not_started);
  }
  int failure = child < 0 ? errno : 0;
  (void)close(ends[1]);
  (void)close(failures[1]);
  if (child > 0 && read(failures[0], &failure, sizeof failure) < 0)
    failure = 0;
  (void)close(failures[0]);
  ChildResult result;
  if (failure == 0)
    result.stopped = read_all(ends[0], limits, result.output);
  if (child > 0 && !result.stopped.empty()) // before its pipe is closed, which would end it by SIGPIPE
    (void)kill(limits.seconds > 0.0 ? -child : child, SIGKILL);
  (void)close(ends[0]);
  if (child < 0)
    return {not_started, arguments[0] + ": " + std::strerror(failure)};
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (ended_by != 0)
    throw Interrupted("ended while " + arguments[0] + " was at work: " + result.stopped);
  if (failure != 0)
    return {not_started, arguments[0] + ": " + std::strerror(failure)};
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : of_a_signal + WTERMSIG(status);
  return result;
}

std::string executable_directory() {
  std::error_code ignored;
  return std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path().string();
}

} // namespace fretwork::core
