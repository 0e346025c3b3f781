// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep/schedule.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <new>

namespace fretwork::sweep {
namespace {

/// Of what is left, the part of a worker that it takes at once: the costs of cases may differ by as much.
constexpr std::int64_t caution = 8;

/// A message that begins with the override of the case, `--set key=value: `, which nobody has typed, names key and value after it too.
std::string without_override(const std::string& message) {
  const auto end = message.find(": ");
  return message.starts_with("--set ") && end != std::string::npos ? message.substr(end + 2) : message;
}

} // namespace

std::vector<std::int64_t> guided_blocks(std::int64_t cases, int workers) {
  std::vector<std::int64_t> ends;
  for (std::int64_t done = 0; done < cases;) {
    done += std::max<std::int64_t>(1, (cases - done) / (caution * workers));
    ends.push_back(done);
  }
  return ends;
}

Row evaluated(std::int64_t number, const std::string& identity, const std::function<CaseResult()>& evaluate) {
  Row row{number, identity};
  const auto ended = [&](Outcome outcome, const char* message) {
    row.outcome = outcome;
    row.message = without_override(message);
  };
  try {
    CaseResult result = evaluate();
    row.values = std::move(result.values);
    row.message = fmt::format("{}", fmt::join(result.warnings, Row::between));
  } catch (const core::Error& error) {
    ended(Outcome::refused, error.what());
  } catch (const core::ComputationError& error) {
    ended(Outcome::failed, error.what());
  } catch (const std::bad_alloc&) {
    ended(Outcome::failed, "the case needs more memory than there is");
  } catch (const std::exception& error) {
    ended(Outcome::defect, error.what());
  }
  return row;
}

void work(const std::vector<std::int64_t>& numbers, int workers, const std::function<std::int64_t()>& take,
          const std::function<Row(std::int64_t)>& evaluate, const std::function<void(const Row&)>& finish) {
  const std::vector<std::int64_t> ends = guided_blocks(static_cast<std::int64_t>(numbers.size()), workers);
  for (std::int64_t block = take(); block < static_cast<std::int64_t>(ends.size()); block = take())
    for (std::int64_t at = block == 0 ? 0 : ends[static_cast<std::size_t>(block - 1)];
         at < ends[static_cast<std::size_t>(block)]; ++at)
      finish(evaluate(numbers[static_cast<std::size_t>(at)]));
}

} // namespace fretwork::sweep
