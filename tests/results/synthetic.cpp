// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthetic.hpp"
#include "fem/section.hpp"
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::results {
namespace {

using std::numbers::pi;

constexpr double length = 9.0;    // m
constexpr double duration = 2.0;  // s
constexpr double gap = 2e-4;      // m
constexpr double stiffness = 1e6; // N/m

modal::Basis tube_modes(const Made& made, int structure) {
  modal::Basis basis;
  const int nodes = made.elements + 1;
  for (int i = 0; i < nodes; ++i)
    basis.nodes.push_back(structure * nodes + i);
  basis.shapes.setZero(6 * nodes, made.modes);
  basis.omega.resize(made.modes);
  for (int k = 0; k < made.modes; ++k) {
    const int n = k / 2 + 1; // pairs: y, then z
    basis.omega(k) = 2.0 * pi * 0.5 * n * n * (1.0 + 0.01 * structure);
    for (int i = 0; i < nodes; ++i)
      basis.shapes(6 * i + 1 + k % 2, k) = 0.47 * std::sin(n * pi * i / made.elements);
  }
  basis.damping = Eigen::VectorXd::Constant(made.modes, 0.01);
  basis.residuals = Eigen::VectorXd::Constant(made.modes, 3e-11);
  basis.orthogonality = 2e-15;
  basis.error = 1e-6 * Eigen::ArrayXd::LinSpaced(made.modes, 1.0, made.modes);
  basis.participation = Eigen::MatrixXd::Zero(made.modes, 3);
  for (int k = 0; k < made.modes; k += 4) // shapes with a mean, in y and in z
    for (int plane = 0; plane < std::min(2, made.modes - k); ++plane)
      basis.participation(k + plane, 1 + plane) = 2.0 / (k / 2 + 1);
  basis.moving_mass = {5.0, 5.0, 5.0};
  return basis;
}

ContactFacts support(const Made& made, int c) {
  static const char* const obstacles[] = {"circle", "plane_y", "stop_z", "plane_z", "stop_y"};
  ContactFacts facts;
  facts.name = fmt::format("tsp{}", c + 1);
  facts.node = (c + 1) * made.elements / (made.contacts + 1);
  facts.axes = Eigen::Matrix3d::Identity();
  facts.obstacle = c % 4 == 0 || made.contacts > 5 ? "circle" : obstacles[c % 5];
  facts.gap = gap;
  facts.rest = {0.0, 2e-5 * (c % 3), 0.0};
  facts.normal_stiffness = facts.tangential_stiffness = stiffness;
  facts.normal_damping = facts.tangential_damping = 20.0;
  facts.friction_static = facts.friction_dynamic = 0.3;
  return facts;
}

post::ContactSeries orbit(const ContactFacts& facts, const Eigen::VectorXd& time, int c) {
  const Eigen::Index nt = time.size();
  post::ContactSeries s{facts.name,
                        Eigen::MatrixXd::Zero(nt, 3),
                        Eigen::MatrixXd::Zero(nt, 3),
                        Eigen::VectorXd::Zero(nt),
                        Eigen::VectorXd::Zero(nt),
                        Eigen::MatrixXd::Zero(nt, 2),
                        std::vector<std::uint8_t>(static_cast<std::size_t>(nt)),
                        Eigen::MatrixXd::Zero(nt, 2)};
  for (Eigen::Index i = 0; i < nt; ++i) {
    const double t = time(i), wave = 1.0 + 0.3 * std::sin(3.1 * t + c);
    const double y = 1.9e-4 * wave * std::cos(2.0 * pi * 31.0 * t + c) * std::cos(1.3 * t);
    const double z = 1.7e-4 * wave * std::sin(2.0 * pi * 31.7 * t + 0.4 * c);
    s.displacement.row(i) << 0.0, y, z;
    s.velocity.row(i) << 0.0, 0.03 * wave * std::sin(190.0 * t), 0.03 * wave * std::cos(190.0 * t);
    const double py = y + facts.rest.y(), pz = z + facts.rest.z();
    const std::string& kind = facts.obstacle;
    const double reach = kind == "circle"    ? std::hypot(py, pz)
                         : kind == "plane_y" ? std::abs(py)
                         : kind == "plane_z" ? std::abs(pz)
                         : kind == "stop_y"  ? py
                                             : pz;
    s.gap(i) = gap - reach;
    if (kind == "circle")
      s.normal.row(i) << -py / reach, -pz / reach;
    else
      s.normal(i, kind.ends_with("_y") ? 0 : 1) =
          kind.starts_with("stop") || (kind == "plane_y" ? py : pz) > 0.0 ? -1.0 : 1.0;
    s.normal_force(i) = std::max(0.0, -stiffness * s.gap(i));
    s.tangential_force.row(i) << 0.0, 0.3 * s.normal_force(i) * (std::sin(200.0 * t) > 0.0 ? 1.0 : -1.0);
    if (s.normal_force(i) > 0.0)
      s.state[static_cast<std::size_t>(i)] = i % 3 == 0 ? post::sticks : post::slides;
  }
  return s;
}

/// Of what the outputs show of the force.
post::ContactImpacts impacts_of(const post::ContactSeries& s, const Eigen::VectorXd& time, int c) {
  post::ContactImpacts impacts;
  impacts.left_out = c;
  const double every = time.size() > 1 ? time(1) - time(0) : duration;
  for (Eigen::Index i = 0; i < time.size(); ++i) {
    if (!(s.normal_force(i) > 0.0))
      continue;
    if (i == 0 || !(s.normal_force(i - 1) > 0.0)) {
      impacts.rows.emplace_back();
      impacts.rows.back().start = time(i);
      impacts.rows.back().velocity_before = 0.02 + 0.001 * static_cast<double>(i % 7);
    }
    post::Impact& row = impacts.rows.back();
    row.duration += every;
    row.peak = std::max(row.peak, s.normal_force(i));
    row.impulse += s.normal_force(i) * every;
    row.rebounds = i % 4;
    row.energy_lost = 1e-5 * static_cast<double>(i % 5);
    if (i + 1 < time.size())
      row.velocity_after = 0.8 * row.velocity_before; // the last one may still be closed: NaN
  }
  return impacts;
}

post::ContactSummary summary(int c) {
  post::ContactSummary s;
  s.impacts = 57 + 3 * c;
  s.contact_time_ratio = 0.081 + 0.01 * (c % 4);
  s.normal_mean = 2.5;
  s.normal_rms = 9.25 + c;
  s.normal_max = 71.5 + 2 * c;
  s.normal_in_contact_mean = 30.0;
  s.normal_in_contact_rms = 34.0;
  s.tangential_rms = 2.5;
  s.tangential_max = 21.0;
  s.y = {1e-6, 1.1e-4, -2.6e-4, 2.7e-4};
  s.z = {-2e-6, 1.2e-4, -2.4e-4, 2.5e-4};
  s.radial_rms = 1.6e-4;
  s.radial_max = 2.71e-4;
  s.work_rate = 0.0123 * (1.0 + std::sin(0.7 * c));
  s.friction_power = 0.29 * s.work_rate;
  s.impact_velocity_mean = 0.021;
  s.impact_velocity_rms = 0.027;
  s.impact_velocity_max = 0.055;
  s.contact_duration_mean = 1.4e-3;
  s.contact_duration_max = 3.3e-3;
  s.departure_velocity_mean = 0.017;
  s.departure_velocity_max = 0.044;
  s.impulse = 4.5;
  s.sliding_distance = 0.31;
  s.sticking_ratio = 0.27;
  s.damping_work = 0.0042;
  s.friction_work = 0.0064;
  s.impact_rate = 31.5 + c;
  s.error = {5e-4, 1.5e-4, 0.25, 1.5, 2e-6, 3e-6, 40.0, 42.0};
  return s;
}

TransientFacts facts_of_run() {
  TransientFacts facts;
  facts.choice.step = 2.5e-5;
  facts.choice.steps = 80000;
  facts.choice.contact_frequency = 2.0e4;
  facts.choice.highest_mode = 1256.0;
  facts.choice.reason = "0.5 / contact frequency (2e4 rad/s) for an accuracy of 0.01";
  facts.report.counts.steps = 80000;
  facts.report.counts.evaluations = 160000;
  facts.report.counts.step_min = facts.report.counts.step_max = 2.5e-5;
  facts.report.end_time = duration;
  facts.report.energy.initial = 0.125;
  facts.report.energy.load_work = 1.5;
  facts.report.energy.stored = 0.25;
  facts.report.energy.modal_damping = 1.0;
  facts.report.energy.contact_damping = 0.125;
  facts.report.energy.friction = 0.25;
  facts.report.residual_relative = 1.25e-6;
  return facts;
}

void add_transient(RunResults& r, const Made& made) {
  r.duration = duration;
  r.statistics_from = 0.2;
  r.rest_time = 1e-3;
  r.errors_of_sums = {1e-3, 3e-4, 0.0, 2.5, 0.0, 0.0, 40.0, 42.0};
  r.series.time = Eigen::VectorXd::LinSpaced(made.outputs, 0.0, duration);
  for (int s = 0; s < made.structures; ++s)
    r.transients.push_back(facts_of_run());
  for (int c = 0; c < made.contacts; ++c) {
    const auto at = static_cast<std::size_t>(c);
    r.contact_summaries.push_back(summary(c));
    r.series.contacts.push_back(orbit(r.contacts[at], r.series.time, c));
    r.impacts.push_back(impacts_of(r.series.contacts.back(), r.series.time, c));
  }
  const Eigen::Index n = made.modes * made.structures;
  r.series.modal_displacement.resize(n, made.outputs);
  for (Eigen::Index i = 0; i < made.outputs; ++i)
    for (Eigen::Index k = 0; k < n; ++k)
      r.series.modal_displacement(k, i) =
          1e-4 / static_cast<double>(k + 1) * std::sin(20.0 * r.series.time(i) + double(k));
  r.series.modal_velocity = 20.0 * r.series.modal_displacement;
  const Eigen::MatrixXd middle = Eigen::MatrixXd::Constant(made.outputs, 3, 1.0 / 3.0);
  r.node_names = {"apex"};
  r.series.nodes = {{"apex", 1e-4 * middle, 1e-2 * middle, middle}};
  r.node_summaries.resize(1);
  r.node_summaries[0].displacement[1] = {1e-6, 2e-4, -3e-4, 4e-4};
}

} // namespace

RunResults made_up(const Made& made) {
  RunResults r;
  r.record = {
      "0.1.0",
      "Straight tube on loose supports",
      "title = \"Straight tube on loose supports\"\n\n[mesh]\nfile = \"tube.msh\"\n# <made up>\n"
      "[[restraints]]\ngroup = \"feet\"\n[[loads]]\ngroup = \"tubes/1\"\ndirection = [0.0, 0.0, 1.0]\n",
      std::string(64, 'a'),
      {7, 18446744073709551615ull},
      {{"HDF5", "1.10.8"}, {"PETSc", "3.18.5"}, {"SLEPc", "3.18.2"}},
      "AVX2 (4 doubles)",
      1};
  r.model.mass_kg = 4.6;
  for (int s = 0; s < made.structures; ++s) {
    const auto first = static_cast<core::Index>(r.nodes.size());
    for (int i = 0; i <= made.elements; ++i)
      r.nodes.emplace_back(length * i / made.elements, 0.03 * s, 0.0);
    for (int i = 0; i < made.elements; ++i)
      r.lines.push_back({first + i, first + i + 1});
    for (int i = 0; i < made.elements; ++i)
      r.beams.push_back({first + i, first + i + 1, 0});
    r.bases.push_back(tube_modes(made, s));
  }
  r.groups = {{"feet", {0}}, {"tubes/1", {0, 1, 2}}};
  r.model.nodes = static_cast<std::int64_t>(r.nodes.size());
  r.model.elements = static_cast<std::int64_t>(r.lines.size());
  r.model.dofs = 6 * r.model.nodes - 12;
  r.properties = {{{2.0e11, 0.3, 8000.0}, fem::pipe_section(0.01905, 0.00109)}};
  for (int c = 0; c < made.contacts; ++c) {
    r.contacts.push_back(support(made, c));
    const core::Index node = r.contacts.back().node;
    r.contacts.back().point = {r.nodes[static_cast<std::size_t>(node)],
                               {{node, Eigen::Matrix<double, 3, 6>::Identity()}}};
  }
  if (made.outputs > 0)
    add_transient(r, made);
  r.timings = {0.001, 0.02, 0.003, 0.02, 0.001, 0.81, 0.12, 0.98};
  r.warnings = {"contact \"tsp2\": the node overlaps its obstacle at rest by 1e-05 m"};
  r.notes = {"made up for a test"};
  return r;
}

} // namespace fretwork::results
