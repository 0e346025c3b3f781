// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/flow_laws.hpp"
#include "core/error.hpp"
#include <algorithm>

namespace fretwork::study {
namespace {

enum class Kind { rational, quasi_steady, quasi_unsteady, table, connors };
const Choices<Kind> kinds{{{"rational", Kind::rational},
                           {"quasi_steady", Kind::quasi_steady},
                           {"quasi_unsteady", Kind::quasi_unsteady},
                           {"table", Kind::table},
                           {"connors", Kind::connors}}};
const std::string expected_matrix =
    "a number (lift alone) or [[a, b], [c, d]], rows and columns drag, lift; 2N x 2N of N tubes";

/// 2N x 2N; a number is that of lift alone.
Eigen::MatrixXd to_matrix(const Value& value, const std::string& path) {
  if (!value.array())
    return Eigen::Vector2d(0.0, to_number(value, path, {})).asDiagonal();
  const Array& rows = to_array(value, path, expected_matrix);
  const auto size = static_cast<Eigen::Index>(rows.size());
  if (size == 0 || size % 2 != 0)
    throw core::Error(path + ": " + std::to_string(size) + " rows; give " + expected_matrix);
  Eigen::MatrixXd out(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const std::vector<double> row = to_numbers(rows[static_cast<std::size_t>(i)], path, rows.size(), {});
    out.row(i) = Eigen::VectorXd::Map(row.data(), size);
  }
  return out;
}

Eigen::MatrixXd read_matrix(const TableReader& table, const std::string& key) {
  return to_matrix(table.required(key, expected_matrix), table.path(key));
}

/// Of several tubes; a matrix of one is that of each by itself.
Eigen::MatrixXd of_tubes(const Eigen::MatrixXd& matrix, Eigen::Index tubes, const std::string& path) {
  if (matrix.rows() != 2 && matrix.rows() != 2 * tubes)
    throw core::Error(path + ": " + std::to_string(matrix.rows()) + " rows, another matrix of the law has " +
                      std::to_string(2 * tubes) + "; give as many, or two for each tube by itself");
  return matrix.rows() == 2 ? flow::for_each_tube(matrix, tubes) : matrix;
}

flow::FluidelasticLaw read_rational(const TableReader& table) {
  flow::FluidelasticLaw law;
  law.stiffness = read_matrix(table, "stiffness");
  law.damping = read_matrix(table, "damping");
  if (table.has("lags") != table.has("lag_forces"))
    table.fail_table("lags and lag_forces belong together; give both, or neither");
  std::vector<double> rates;
  std::vector<Eigen::MatrixXd> lag_forces;
  if (table.has("lags")) {
    rates = to_numbers(*table.find("lags"), table.path("lags"), 0, {Range::above_zero});
    for (const Value& force : to_array(*table.find("lag_forces"), table.path("lag_forces"),
                                       "an array with " + expected_matrix + " for each lag"))
      lag_forces.push_back(to_matrix(force, table.path("lag_forces")));
    if (lag_forces.size() != rates.size())
      table.fail_at("lag_forces",
                    "one for each of the " + std::to_string(rates.size()) + " lags is expected");
  }
  Eigen::Index tubes = std::max(law.stiffness.rows(), law.damping.rows()) / 2;
  for (const Eigen::MatrixXd& force : lag_forces)
    tubes = std::max(tubes, force.rows() / 2);
  law.stiffness = of_tubes(law.stiffness, tubes, table.path("stiffness"));
  law.damping = of_tubes(law.damping, tubes, table.path("damping"));
  for (std::size_t i = 0; i < rates.size(); ++i)
    law.lags.push_back(
        {rates[i], of_tubes(lag_forces[i], tubes, table.path("lag_forces")).cast<std::complex<double>>()});
  return law;
}

flow::FluidelasticLaw read_quasi(const TableReader& table, Kind kind) {
  const double drag = table.number("drag", {Range::at_least_zero}), lift = table.number_or("lift", 0.0, {});
  const Eigen::MatrixXd gradients = read_matrix(table, "gradients");
  const auto with_steady = [&](flow::FluidelasticLaw law) {
    if (table.optional_flag("steady").value_or(false))
      law.steady = {drag, lift};
    return law;
  };
  if (kind == Kind::quasi_steady)
    return with_steady(
        flow::quasi_steady_law(drag, lift, gradients, table.number_or("delay", 1.0, {Range::at_least_zero})));
  std::vector<flow::Memory> memory;
  const std::string expected = "rows [alpha, d] of the memory 1 - sum alpha exp(-d tau)";
  for (const Value& row : to_array(table.required("memory", expected), table.path("memory"), expected)) {
    const std::vector<double> pair = to_numbers(row, table.path("memory"), 2, {});
    if (pair[1] <= 0.0)
      table.fail_at("memory", "d = " + std::to_string(pair[1]) + " does not decay; give rates above 0");
    memory.push_back({pair[0], pair[1]});
  }
  return with_steady(flow::quasi_unsteady_law(drag, lift, gradients, memory));
}

flow::FluidelasticLaw read_table(const TableReader& table) {
  const std::string expected = "rows [Vr, c_k, c_d] of measured coefficients";
  std::vector<flow::MeasuredForce> rows;
  for (const Value& row : to_array(table.required("table", expected), table.path("table"), expected)) {
    const std::vector<double> values = to_numbers(row, table.path("table"), 3, {});
    if (values[0] <= 0.0)
      table.fail_at("table", "Vr = " + std::to_string(values[0]) + "; give reduced velocities above 0");
    for (const flow::MeasuredForce& other : rows)
      if (other.reduced_velocity == values[0])
        table.fail_at("table", "Vr = " + std::to_string(values[0]) + " has two rows; give one");
    rows.push_back({values[0], values[1], values[2]});
  }
  const auto lags = static_cast<int>(table.optional_integer("fit", 0).value_or(2));
  if (lags > 3)
    table.fail_at("fit", "at most 3 lags are fitted");
  if (static_cast<int>(rows.size()) <= lags)
    table.fail_at("table", std::to_string(rows.size()) + " rows do not determine " + std::to_string(lags) +
                               " lags; give more rows, or a smaller fit");
  return lags == 0 ? flow::frozen_law(rows) : flow::fitted_law(rows, lags).law;
}

flow::FluidelasticLaw read_connors_law(const TableReader& table) {
  const double constant = table.number("constant", {Range::above_zero});
  const bool as_damping = table.choice("form", false, Choices<bool>{{{"coupled", false}, {"damping", true}}});
  return as_damping ? flow::connors_damping_law(constant) : flow::connors_law(constant);
}

flow::FluidelasticLaw read_law(const TableReader& table, Kind kind) {
  switch (kind) {
  case Kind::rational:
    return read_rational(table);
  case Kind::quasi_steady:
  case Kind::quasi_unsteady:
    return read_quasi(table, kind);
  case Kind::table:
    return read_table(table);
  case Kind::connors:
    return read_connors_law(table);
  }
  return {};
}

std::vector<std::string> keys_of(Kind kind) {
  switch (kind) {
  case Kind::rational:
    return {"law", "range", "stiffness", "damping", "lags", "lag_forces"};
  case Kind::quasi_steady:
    return {"law", "range", "drag", "lift", "gradients", "delay", "steady"};
  case Kind::quasi_unsteady:
    return {"law", "range", "drag", "lift", "gradients", "memory", "steady"};
  case Kind::table:
    return {"law", "range", "table", "fit"};
  case Kind::connors:
    return {"law", "range", "constant", "form"};
  }
  return {};
}

} // namespace

std::vector<NamedLaw> read_flow_laws(const TableReader& root) {
  std::vector<NamedLaw> out;
  for (const Entry& entry : table_entries(root, "flow_laws")) {
    const TableReader any(*entry.value, entry.path,
                          {{"law", "range", "stiffness", "damping", "lags", "lag_forces", "drag", "lift",
                            "gradients", "delay", "memory", "steady", "table", "fit", "constant", "form"}});
    (void)any.required("law", "\"rational\", \"quasi_steady\", \"quasi_unsteady\", \"table\" or \"connors\"");
    const Kind kind = any.choice("law", Kind::rational, kinds);
    const TableReader table(*entry.value, entry.path, {keys_of(kind)});
    flow::FluidelasticLaw law = read_law(table, kind);
    if (table.has("range")) {
      const std::vector<double> range =
          to_numbers(*table.find("range"), table.path("range"), 2, {Range::at_least_zero});
      if (range[1] <= range[0])
        table.fail_at("range", "[least, largest] reduced velocity is expected, in this order");
      law.range = {range[0], range[1]};
    }
    out.push_back({entry.name, std::move(law)});
  }
  return out;
}

} // namespace fretwork::study
