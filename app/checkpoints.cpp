// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/checkpoints.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include <cerrno>
#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <regex>
#include <sys/wait.h>
#include <unistd.h>

namespace fretwork::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* file_start = "checkpoint";

results::Checkpoint checkpoint_of(transient::Run& run) {
  core::StateArchive state;
  state(run);
  return {run.time(), std::move(state).bytes()};
}

/// What tells builds of one version apart: the hash of the executable. Where it cannot be read (no /proc) the version alone does.
const std::string& build() {
  static const std::string hash = [] {
    std::ifstream in("/proc/self/exe", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    return bytes.empty() ? std::string() : core::sha256(bytes);
  }();
  return hash;
}

} // namespace

Checkpoints::Checkpoints(CheckpointOptions options) : options_(std::move(options)) {
  if (options_.every > 0.0)
    signal_.emplace();
}

std::string Checkpoints::found(std::size_t run) const {
  if (!options_.resume || !fs::exists(file(run)))
    return {};
  const results::FoundCheckpoint found = results::read_checkpoint(file(run), identity(run));
  if (!found.refusal.empty())
    options_.tell(found.refusal);
  if (!found.checkpoint)
    return {};
  options_.tell(fmt::format("going on from {}, at t = {:.6g} s", file(run).string(), found.checkpoint->time));
  return found.checkpoint->state;
}

void Checkpoints::refuse(std::size_t run) const {
  options_.tell(fmt::format("{} was written by another build of the program: the run starts again",
                            file(run).string()));
}

void Checkpoints::look(std::size_t run, transient::Run& state) {
  const auto due = [&] {
    return std::chrono::duration<double>(Clock::now() - last_).count() >= options_.every;
  };
  if (!(options_.every > 0.0))
    return;
  const std::string ended_by = EndSignal::came();
  if (ended_by.empty() && !due())
    return;
  if (ended_by.empty()) {
    pending_.push_back({run, checkpoint_of(state)});
    (void)write();
    return;
  }
  const bool saved = write_apart(run, state);
  throw core::Interrupted(
      fmt::format("ended by {} at t = {:.6g} s{}", ended_by, state.time(),
                  saved ? "; the same command goes on from there" : ", without a checkpoint"));
}

bool Checkpoints::write_apart(std::size_t run, transient::Run& state) {
  const auto save = [&] {
    pending_.push_back({run, checkpoint_of(state)});
    return write();
  };
  (void)std::fflush(nullptr); // what is not yet written would be written twice
  const pid_t writer = ::fork();
  if (writer < 0)
    return save();
  if (writer == 0) { // one thread, the memory as it was; nothing of MPI is used, and nothing of it ended
    (void)::setsid();
    int status = 1;
    try {
      status = save() ? 0 : 1;
    } catch (const std::exception& error) { // out of memory
      options_.tell(fmt::format("no checkpoint: {}", error.what()));
    }
    ::_exit(status);
  }
  // Here too, before the message: a signal to the process group of this process misses it even where it has not yet started.
  (void)::setpgid(writer, writer);
  options_.tell(fmt::format("{} at t = {:.6g} s: process {} saves the checkpoint", EndSignal::came(),
                            state.time(), writer));
  int status = 0;
  while (::waitpid(writer, &status, 0) < 0)
    if (errno != EINTR)
      return false;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void Checkpoints::ended(std::size_t run, transient::Run& state) {
  if (options_.every > 0.0)
    pending_.push_back({run, checkpoint_of(state)});
}

bool Checkpoints::write() {
  bool done = true;
  try {
    for (const Pending& p : pending_)
      results::write_checkpoint(file(p.run), identity(p.run), p.checkpoint);
  } catch (const core::Error& error) { // the results do not depend on it
    if (!failed_)
      options_.tell(fmt::format("no checkpoint: {}", error.what()));
    failed_ = true;
    done = false;
  }
  pending_.clear();
  last_ = Clock::now(); // writing does not count: a run with huge series still gets on
  return done;
}

fs::path Checkpoints::file(std::size_t run) const {
  return options_.directory /
         (run == 0 ? fmt::format("{}.h5", file_start) : fmt::format("{}-{}.h5", file_start, run + 1));
}

results::RunIdentity Checkpoints::identity(std::size_t run) const {
  return {options_.version, options_.input_sha256, static_cast<std::int64_t>(run), build()};
}

void Checkpoints::remove(const fs::path& directory) {
  const std::regex of_a_run(fmt::format(R"({}(-[0-9]+)?(\.part)?\.h5)", file_start));
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(directory))
    if (std::regex_match(entry.path().filename().string(), of_a_run))
      files.push_back(entry.path());
  std::error_code ignored;
  for (const fs::path& file : files)
    fs::remove(file, ignored);
}

} // namespace fretwork::app
