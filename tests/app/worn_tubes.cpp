// SPDX-License-Identifier: GPL-3.0-or-later
#include "worn_tubes.hpp"
#include "study_text.hpp"
#include <fmt/format.h>

namespace fretwork::app::test::worn_tubes {

const std::string archard = "coefficient = 2.0e-14\nlength = 0.02\n";
const std::string short_run =
    "[transient]\nduration = 0.3\n[output]\nevery = 1.0e-3\nstatistics_from = 0.05\n";

std::string worn_bundle(const Workshop& folder, int tubes, const std::string& wear, const std::string& run) {
  std::string study = bundle(folder, tubes, run);
  for (int i = 0; i < tubes; ++i)
    study += across(fmt::format("drive{}", i), 0.1);
  return study + "[[wear]]\n" + wear;
}

Results with_given_rate(const Workshop& folder, const std::string& keys, const std::string& rate) {
  return folder.run_text(worn_bundle(folder, 1, keys + "states = [{ share = 1, work_rate = " + rate + " }]\n",
                                     "[transient]\nduration = 0.01\n"));
}

const nlohmann::json& support(const Results& run, std::size_t i) {
  return run.summary["wear"]["supports"].at(i);
}

double sum(const nlohmann::json& numbers) {
  double total = 0.0;
  for (const auto& number : numbers)
    total += number.get<double>();
  return total;
}

} // namespace fretwork::app::test::worn_tubes
