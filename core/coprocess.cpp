// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coprocess.hpp"
#include "core/error.hpp"
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fretwork::core {
namespace {

constexpr int no_program = 127;
constexpr std::chrono::milliseconds between_looks_at_stop{100};

std::vector<char*> pointers(const std::vector<std::string>& texts) {
  std::vector<char*> out;
  for (const std::string& text : texts)
    out.push_back(const_cast<char*>(text.c_str()));
  out.push_back(nullptr);
  return out;
}

} // namespace

Coprocess::Coprocess(const std::vector<std::string>& arguments, const std::vector<std::string>& environment) {
  const std::vector<char*> argv = pointers(arguments), envp = pointers(environment);
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw ComputationError(arguments[0] + ": no socket: " + std::strerror(errno));
  const pid_t parent = getpid();
  child_ = fork();
  if (child_ == 0) { // system calls only
    (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() == parent && dup2(ends[1], STDIN_FILENO) >= 0 && dup2(ends[1], STDOUT_FILENO) >= 0)
      (void)execvpe(argv[0], argv.data(), envp.data());
    _exit(no_program);
  }
  const int failure = errno;
  (void)close(ends[1]);
  socket_ = ends[0];
  if (child_ < 0) {
    (void)close(socket_);
    throw ComputationError(arguments[0] + ": no process: " + std::strerror(failure));
  }
}

Coprocess::~Coprocess() {
  (void)end();
  (void)close(socket_);
}

void Coprocess::write(const std::string& line) {
  const std::string text = line + "\n";
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t sent = send(socket_, text.data() + done, text.size() - done, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR)
      continue;
    if (sent < 0)
      return;
    done += static_cast<std::size_t>(sent);
  }
}

std::optional<std::string> Coprocess::read(const std::function<void()>& between) {
  std::array<char, 65536> buffer;
  for (std::size_t searched = 0;;) {
    if (const std::size_t line = received_.find('\n', searched); line != std::string::npos) {
      const std::string out = received_.substr(0, line);
      received_.erase(0, line + 1);
      return out;
    }
    searched = received_.size();
    pollfd waiting{socket_, POLLIN, 0};
    if (poll(&waiting, 1, static_cast<int>(between_looks_at_stop.count())) <= 0) {
      between();
      continue;
    }
    const ssize_t got = recv(socket_, buffer.data(), buffer.size(), 0);
    if (got < 0 && errno == EINTR)
      continue;
    if (got <= 0)
      return {};
    received_.append(buffer.data(), static_cast<std::size_t>(got));
  }
}

std::string Coprocess::end() {
  if (child_ < 0)
    return {};
  (void)kill(child_, SIGKILL); // changes nothing of one that is ending
  int status = 0;
  while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  if (WIFEXITED(status))
    return "exit status " + std::to_string(WEXITSTATUS(status));
  const char* name = sigabbrev_np(WTERMSIG(status));
  return "signal " + std::to_string(WTERMSIG(status)) + (name ? " (SIG" + std::string(name) + ")" : "");
}

} // namespace fretwork::core
