// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/case_row.hpp"
#include "core/error.hpp"
#include "results/force_results.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fretwork::app {
namespace {

constexpr std::array axes{"x", "y", "z"};

constexpr double no_number = results::no_value;

/// A figure of contacts.
struct Figure {
  const char *name, *unit;
  double post::ContactSummary::*value;
  double post::StandardErrors::*error; ///< nullptr: none
};
constexpr std::array figures{
    Figure{"work_rate", "W", &post::ContactSummary::work_rate, &post::StandardErrors::work_rate},
    Figure{"normal_rms", "N", &post::ContactSummary::normal_rms, &post::StandardErrors::normal_rms},
    Figure{"normal_max", "N", &post::ContactSummary::normal_max, &post::StandardErrors::normal_max},
    Figure{"tangential_max", "N", &post::ContactSummary::tangential_max, nullptr},
    Figure{"impact_rate", "1/s", &post::ContactSummary::impact_rate, &post::StandardErrors::impact_rate},
    Figure{"contact_time_ratio", "", &post::ContactSummary::contact_time_ratio,
           &post::StandardErrors::contact_time_ratio}};
constexpr std::size_t worst_figures = 3; ///< the first ones are given of the worst contact too

/// Outputs of the components of section forces, in the order of post::ForceSummary.
constexpr std::array<std::array<const char*, 2>, post::force_components> section_components{
    {{"axial_force", "N"},
     {"shear_y", "N"},
     {"shear_z", "N"},
     {"torsion", "N m"},
     {"moment_y", "N m"},
     {"moment_z", "N m"}}};

/// A row while it is filled.
class Filling {
public:
  explicit Filling(const std::vector<sweep::Column>& columns)
      : columns_(columns), values_(columns.size(), no_number) {}

  /// @throws core::Error for an output that the nominal case does not have
  void set(const std::string& name, double value) { values_[place(name)] = value; }
  /// Keeps the largest value, with its error.
  void set_largest(const std::string& name, double value, double error) {
    const std::size_t at = place(name);
    if (!std::isnan(value) && !(value <= values_[at]))
      set_with_error(at, value, error);
  }
  /// Keeps the smallest value, with its error.
  void set_smallest(const std::string& name, double value, double error) {
    const std::size_t at = place(name);
    if (!std::isnan(value) && !(value >= values_[at]))
      set_with_error(at, value, error);
  }
  [[nodiscard]] bool has(const std::string& name) const {
    return std::any_of(columns_.begin(), columns_.end(),
                       [&](const sweep::Column& column) { return column.name == name; });
  }
  [[nodiscard]] std::vector<double> values() && { return std::move(values_); }

private:
  void set_with_error(std::size_t at, double value, double error) {
    values_[at] = value;
    if (at + 1 < columns_.size() && columns_[at + 1].name == columns_[at].name + ".error")
      values_[at + 1] = error;
  }
  [[nodiscard]] std::size_t place(const std::string& name) {
    // rows are filled in the order of the columns
    for (std::size_t i = 0; i < columns_.size(); ++i, ++next_) {
      next_ = next_ < columns_.size() ? next_ : 0;
      if (columns_[next_].name == name)
        return next_;
    }
    throw core::Error(fmt::format("the case has an output \"{}\" that the study without its sweep has not; "
                                  "let the study have all contacts, and make some inactive in cases",
                                  name));
  }
  const std::vector<sweep::Column>& columns_;
  std::vector<double> values_;
  std::size_t next_ = 0;
};

/// Half of an interval of one standard error on both sides (CaseRunner::read_case); not a number of lives without end.
double half(const results::Bounds& bounds) {
  return std::isinf(bounds.low) ? std::numeric_limits<double>::quiet_NaN() : 0.5 * (bounds.high - bounds.low);
}

void fill_contacts(const std::vector<PlacedContact>& placed, const results::RunResults& run, Filling& row) {
  double work = 0.0, impacts = 0.0;
  for (std::size_t k = 0; k < placed.size(); ++k) {
    const post::ContactSummary& statistics = run.contact_summaries[k];
    for (std::size_t f = 0; f < figures.size(); ++f) {
      const double value = statistics.*figures[f].value,
                   error = figures[f].error ? statistics.error.*figures[f].error : no_number;
      const std::string name = fmt::format("{}.{}", placed[k].name, figures[f].name);
      row.set(name, value);
      if (figures[f].error)
        row.set(name + ".error", error);
      if (f < worst_figures)
        row.set_largest(fmt::format("worst.{}", figures[f].name), value, error);
    }
    work += statistics.work_rate;
    impacts += statistics.impact_rate;
  }
  if (!row.has("total.work_rate")) // of a study without contacts
    return;
  row.set("total.work_rate", work);
  row.set("total.work_rate.error", run.errors_of_sums.work_rate);
  row.set("total.impact_rate", impacts);
  row.set("total.impact_rate.error", run.errors_of_sums.impact_rate);
}

void fill_wear(const results::Wear& wear, Filling& row) {
  for (const results::WearOfSupport& support : wear.supports) {
    const results::Bounds years = support.life.years;
    results::Bounds depth = support.depth.last();
    if (support.outside.empty() && std::isnan(depth.value)) // beyond the geometry
      depth.value = std::numeric_limits<double>::infinity();
    row.set(support.name + ".wear_depth", depth.value);
    row.set(support.name + ".wear_depth.error", half(depth));
    row.set(support.name + ".years", years.value);
    row.set(support.name + ".years.error", half(years));
    if (const results::WearLife& own = support.support_life; !own.end.empty()) {
      row.set(support.name + ".support_years", own.years.value);
      row.set(support.name + ".support_years.error", half(own.years));
      row.set_smallest("worst.years", own.years.value, half(own.years));
    }
    row.set_largest("worst.wear_depth", depth.value, half(depth));
    row.set_smallest("worst.years", years.value, half(years));
  }
}

void fill_nodes(const results::RunResults& run, Filling& row) {
  for (std::size_t k = 0; k < run.node_names.size(); ++k)
    for (std::size_t d = 0; d < axes.size(); ++d) {
      const post::NodeSummary& node = run.node_summaries[k];
      const std::string std_name = fmt::format("{}.std_{}", run.node_names[k], axes[d]);
      row.set(std_name, node.displacement[d].std);
      row.set(std_name + ".error", node.std_error[d]);
      row.set(fmt::format("{}.largest_{}", run.node_names[k], axes[d]),
              std::max(std::abs(node.displacement[d].min), std::abs(node.displacement[d].max)));
    }
}

void fill_forces(const results::RunResults& run, Filling& row) {
  using post::ForceSummary;
  for (const results::SectionGroup& group : results::section_groups(run)) {
    const std::string& name = run.force_sites[group.first].name;
    const auto largest = [&](auto figure) { return results::largest_of(run, group, figure); };
    row.set(name + ".stress", largest([](const ForceSummary& force) { return force.stress; }).value);
    const auto scatter = largest([](const ForceSummary& force) { return force.stress_std; });
    row.set(name + ".stress_std", scatter.value);
    row.set(name + ".stress_std.error", run.force_summaries[scatter.site].stress_std_error);
    row.set(name + ".moment", largest([](const ForceSummary& force) { return force.moment; }).value);
    row.set(name + ".shear_force", largest([](const ForceSummary& force) { return force.force; }).value);
    for (std::size_t c = 0; c < section_components.size(); ++c)
      row.set(fmt::format("{}.{}", name, section_components[c][0]),
              largest([c](const ForceSummary& force) { return results::largest_component(force, c); }).value);
  }
  for (std::size_t k = 0; k < run.force_sites.size(); ++k)
    if (!run.force_sites[k].is_section()) {
      row.set(run.force_sites[k].name + ".force", run.force_summaries[k].force);
      row.set(run.force_sites[k].name + ".moment", run.force_summaries[k].moment);
    }
}

/// The name of the tube where there are several.
std::string velocity_ratio_of(const results::StabilityAssessment& assessment,
                              const std::vector<results::StabilityAssessment>& all) {
  const bool several = std::any_of(all.begin(), all.end(), [&](const results::StabilityAssessment& other) {
    return other.damping.tube != assessment.damping.tube;
  });
  return fmt::format("stability.{}{}.velocity_ratio", assessment.name,
                     several ? "." + assessment.damping.tube : std::string());
}

void fill_stability(const std::vector<results::StabilityAssessment>& all, Filling& row) {
  for (const results::StabilityAssessment& one : all) {
    double largest = no_number; // not assessed
    for (const flow::StabilityCase& of : one.stability.cases)
      if (of.margin())
        largest = std::fmax(largest, 1.0 - *of.margin());
    row.set(velocity_ratio_of(one, all), largest);
    row.set_largest("worst.velocity_ratio", largest, no_number);
  }
}

} // namespace

std::vector<sweep::Column> case_columns(const std::vector<PlacedContact>& contacts,
                                        const std::vector<WornPlace>& worn,
                                        const results::RunResults& facts) {
  std::vector<sweep::Column> columns;
  const auto add = [&](const std::string& name, const char* unit, bool has_error) {
    columns.push_back({name, unit});
    if (has_error)
      columns.push_back({name + ".error", unit});
  };
  for (const PlacedContact& contact : contacts)
    for (const Figure& figure : figures)
      add(fmt::format("{}.{}", contact.name, figure.name), figure.unit, figure.error != nullptr);
  const auto add_life = [&](const WornPlace& place, const char* which) {
    columns.push_back({place.name + which, "a", {}});
    for (const std::size_t c : place.contacts)
      columns.back().contacts.push_back(contacts[c].name);
    columns.push_back({place.name + which + ".error", "a"});
  };
  for (const WornPlace& place : worn) {
    add(place.name + ".wear_depth", "m", true);
    add_life(place, ".years");
    if (place.worn.support_limit)
      add_life(place, ".support_years");
  }
  for (const std::string& node : facts.node_names)
    for (const char* axis : axes) {
      add(fmt::format("{}.std_{}", node, axis), "m", true);
      add(fmt::format("{}.largest_{}", node, axis), "m", false);
    }
  for (const results::SectionGroup& group : results::section_groups(facts)) {
    const std::string& name = facts.force_sites[group.first].name;
    add(name + ".stress", "Pa", false);
    add(name + ".stress_std", "Pa", true);
    add(name + ".moment", "N m", false);
    add(name + ".shear_force", "N", false);
    for (const auto& [component, unit] : section_components)
      add(fmt::format("{}.{}", name, component), unit, false);
  }
  for (const results::ForceSite& site : facts.force_sites)
    if (!site.is_section()) {
      add(site.name + ".force", "N", false);
      add(site.name + ".moment", "N m", false);
    }
  for (const results::StabilityAssessment& one : facts.stability)
    add(velocity_ratio_of(one, facts.stability), "", false);
  if (columns.empty())
    throw core::Error("the study has nothing that a sweep gives statistics of: no [[contacts]], no "
                      "[[stability]], and no nodes, section_forces or reactions in [output]");
  if (!contacts.empty()) {
    add("total.work_rate", "W", true);
    add("total.impact_rate", "1/s", true);
  }
  add("total.energy_residual", "", false);
  if (!contacts.empty())
    for (std::size_t f = 0; f < worst_figures; ++f)
      add(fmt::format("worst.{}", figures[f].name), figures[f].unit, figures[f].error != nullptr);
  if (!worn.empty()) {
    add("worst.wear_depth", "m", true);
    add("worst.years", "a", true);
  }
  if (!facts.stability.empty())
    add("worst.velocity_ratio", "", false);
  for (auto column = columns.begin(); column != columns.end(); ++column)
    if (std::any_of(columns.begin(), column, [&](const auto& other) { return other.name == column->name; }))
      throw core::Error(
          fmt::format("two outputs of the sweep are called \"{}\"; rename the contact or group (\"total\" "
                      "and \"worst\" are all contacts together, and the worst)",
                      column->name));
  return columns;
}

std::vector<double> case_row(const std::vector<sweep::Column>& columns,
                             const std::vector<PlacedContact>& placed, const results::RunResults& run) {
  Filling row(columns);
  fill_contacts(placed, run, row);
  if (run.wear)
    fill_wear(*run.wear, row);
  fill_nodes(run, row);
  fill_forces(run, row);
  fill_stability(run.stability, row);
  double residual = 0.0;
  for (const results::TransientFacts& transient : run.transients)
    residual = std::max(residual, transient.report.residual_relative);
  row.set("total.energy_residual", residual);
  return std::move(row).values();
}

} // namespace fretwork::app
