// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/stability_file.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fretwork::results {
namespace {

void write_diagram(const h5::Group& group, const StabilityAssessment& assessment) {
  const LawStability& law = *assessment.law;
  const flow::StabilityDiagram& diagram = law.diagram;
  group.set("assessment", assessment.name);
  group.set("tubes", fmt::format("{}", fmt::join(law.tubes, ", ")));
  group.set("velocity", law.velocity);
  group.set("diameter", law.diameter);
  std::vector<std::int64_t> tube, mode;
  for (const LawStability::Mode& one : law.modes) {
    tube.push_back(std::find(law.tubes.begin(), law.tubes.end(), one.tube) - law.tubes.begin());
    mode.push_back(one.number);
  }
  std::vector<double> frequency, damping, growth;
  for (Eigen::Index i = 0; i < diagram.roots.rows(); ++i)
    for (const std::complex<double>& root : diagram.roots.row(i)) {
      frequency.push_back(flow::frequency_of(root));
      damping.push_back(flow::damping_of(root));
      growth.push_back(root.real());
    }
  const h5::Shape modes{law.modes.size()}, all{diagram.factors.size(), law.modes.size()};
  group.write<double>("factor", diagram.factors, {diagram.factors.size()}, "1");
  group.write<std::int64_t>("tube", tube, modes, "");
  group.write<std::int64_t>("mode", mode, modes, "");
  group.write<double>("frequency", frequency, all, "Hz");
  group.write<double>("damping", damping, all, "1");
  group.write<double>("growth", growth, all, "1/s");
}

} // namespace

void write_stability(const h5::Group& root, const std::vector<StabilityAssessment>& assessments) {
  std::optional<h5::Group> all;
  int number = 0;
  for (const StabilityAssessment& assessment : assessments) {
    if (!assessment.law)
      continue;
    if (!all)
      all.emplace(root.create("stability"));
    write_diagram(all->create(fmt::format("{}", number++)), assessment);
  }
}

} // namespace fretwork::results
