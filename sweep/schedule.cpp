// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep/schedule.hpp"
#include "core/error.hpp"
#include <algorithm>

namespace fretwork::sweep {
namespace {

/// Of what is left, the part of a worker that it takes at once: the costs of cases may differ by as much.
constexpr std::int64_t caution = 8;

Row evaluated(std::int64_t number, const std::string& identity,
              const std::function<std::vector<double>(std::int64_t)>& evaluate) {
  Row row{number, identity};
  const auto ended = [&](Outcome outcome, const std::exception& error) {
    row.outcome = outcome;
    row.message = error.what();
  };
  try {
    row.values = evaluate(number);
  } catch (const core::Error& error) {
    ended(Outcome::refused, error);
  } catch (const core::ComputationError& error) {
    ended(Outcome::failed, error);
  } catch (const std::exception& error) {
    ended(Outcome::defect, error);
  }
  return row;
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

void work(const std::vector<std::int64_t>& numbers, int workers, const std::function<std::int64_t()>& take,
          const std::function<std::string(std::int64_t)>& identity,
          const std::function<std::vector<double>(std::int64_t)>& evaluate,
          const std::function<void(const Row&)>& finish) {
  const std::vector<std::int64_t> ends = guided_blocks(static_cast<std::int64_t>(numbers.size()), workers);
  for (std::int64_t block = take(); block < static_cast<std::int64_t>(ends.size()); block = take())
    for (std::int64_t at = block == 0 ? 0 : ends[static_cast<std::size_t>(block - 1)];
         at < ends[static_cast<std::size_t>(block)]; ++at) {
      const std::int64_t number = numbers[static_cast<std::size_t>(at)];
      finish(evaluated(number, identity(number), evaluate));
    }
}

} // namespace fretwork::sweep
