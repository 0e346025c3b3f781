// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/case_worker.hpp"
#include "app/case_run.hpp"
#include "app/chain.hpp"
#include "core/error.hpp"
#include "core/launcher.hpp"
#include "core/petsc.hpp"
#include "sweep/schedule.hpp"
#include <csignal>
#include <cstdio>
#include <fmt/format.h>
#include <iostream>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace fretwork::app {
namespace {

using nlohmann::json;

constexpr int attempts = 2; ///< the second one in a process that has computed no other case

std::string line_of(const json& message) {
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

/// The facts, or why the nominal case has none, by the name of the outcome.
json nominal_answer(const Request& request, bool with_warnings, Inputs& inputs,
                    std::optional<CaseRunner>& runner) {
  std::vector<std::string> warnings;
  const sweep::Row row = sweep::evaluated(0, "", [&]() -> sweep::CaseResult {
    inputs = read_inputs(request);
    use_made_mesh(inputs);
    make_keys(request, inputs);
    runner.emplace(study::parse(request.study), request.overrides, inputs);
    runner->compute_nominal(study::read_sweep(study::load(request.study, request.overrides)).keep > 0);
    if (with_warnings)
      warnings = warnings_of_case(request);
    return {};
  });
  if (row.outcome != sweep::Outcome::done)
    return {{name_of(row.outcome), row.message}};
  json out{{"key", inputs.whole_key}, {"columns", json::array()}, {"contacts", json::array()}};
  for (const sweep::Column& column : runner->columns())
    out["columns"].push_back({column.name, column.unit, column.contacts});
  for (const auto& [name, node] : runner->contacts())
    out["contacts"].push_back({name, node});
  out["warnings"] = warnings;
  return out;
}

SweepFacts facts_of(const json& answer) {
  if (answer.contains("refused"))
    throw core::Error(answer["refused"].get<std::string>());
  if (answer.contains("failed"))
    throw core::ComputationError(answer["failed"].get<std::string>());
  if (answer.contains("defect"))
    throw std::runtime_error(answer["defect"].get<std::string>());
  SweepFacts out{answer.at("key").get<std::string>(), {}, {}, answer.at("warnings")};
  for (const json& column : answer.at("columns"))
    out.columns.push_back({column[0].get<std::string>(), column[1].get<std::string>(),
                           column[2].get<std::vector<std::string>>()});
  for (const json& contact : answer.at("contacts"))
    out.contacts.emplace_back(contact[0].get<std::string>(), contact[1].get<core::Index>());
  return out;
}

/// The channel to the rank: standard output, which is then standard error for all else.
class Answers {
public:
  Answers() : file_(fdopen(dup(STDOUT_FILENO), "w")) { (void)dup2(STDERR_FILENO, STDOUT_FILENO); }
  ~Answers() { (void)std::fclose(file_); }
  Answers(const Answers&) = delete;
  Answers& operator=(const Answers&) = delete;
  void write(const std::string& line) const {
    (void)std::fwrite(line.data(), 1, line.size(), file_);
    (void)std::fflush(file_);
  }

private:
  std::FILE* file_;
};

} // namespace

CaseWorker::CaseWorker(Request request, std::string key, bool with_warnings, std::function<void()> between)
    : request_(std::move(request)), key_(std::move(key)), between_(std::move(between)) {
  start(with_warnings);
}

void CaseWorker::start(bool with_warnings) {
  std::vector<std::string> arguments{std::filesystem::read_symlink("/proc/self/exe").string(), "sweep-cases",
                                     request_.study.string(), "-o", request_.directory.value().string()};
  for (const std::string& text : request_.overrides)
    arguments.insert(arguments.end(), {"--set", text});
  if (with_warnings)
    arguments.emplace_back("--warnings");
  facts_.reset();
  process_.emplace(arguments, core::environment_without_launcher());
}

const SweepFacts& CaseWorker::facts() {
  if (facts_)
    return *facts_;
  if (!process_)
    start(false);
  const auto line = process_->read(between_);
  if (!line)
    throw core::ComputationError(
        fmt::format("the process that computes the cases ended before the first one ({}); try the study by "
                    "fretwork run",
                    process_->end()));
  facts_ = facts_of(json::parse(*line));
  if (facts_->key != key_)
    throw core::Error(fmt::format("{} has been changed while its sweep runs; give the same command again",
                                  request_.study.string()));
  return *facts_;
}

sweep::Row CaseWorker::operator()(std::int64_t number, const std::string& identity,
                                  const std::vector<std::string>& overrides) {
  std::string end;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    (void)facts();
    process_->write(line_of({{"case", number}, {"identity", identity}, {"overrides", overrides}}));
    if (const auto line = process_->read(between_))
      if (auto row = sweep::row_of(*line); row && row->number == number && row->identity == identity)
        return std::move(*row);
    end = process_->end();
    process_.reset();
    facts_.reset();
  }
  return {number, identity, sweep::Outcome::crashed, {}, fmt::format("its process ended: {}", end)};
}

void serve_cases(const Request& request, bool with_warnings) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    (void)std::signal(signal, SIG_IGN);
  const Answers answers;
  const core::PetscSession petsc(MPI_COMM_SELF);
  Inputs inputs;
  std::optional<CaseRunner> runner;
  answers.write(line_of(nominal_answer(request, with_warnings, inputs, runner)) + "\n");
  for (std::string line; runner && std::getline(std::cin, line);) {
    const json asked = json::parse(line);
    answers.write(sweep::line_of(
        sweep::evaluated(asked.at("case").get<std::int64_t>(), asked.at("identity").get<std::string>(),
                         [&] { return (*runner)(asked.at("overrides").get<std::vector<std::string>>()); })));
  }
}

} // namespace fretwork::app
