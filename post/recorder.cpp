// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/recorder.hpp"
#include "contact/obstacle.hpp"
#include <algorithm>

namespace fretwork::post {

core::Vec3 ContactSeries::force(Eigen::Index index) const {
  const contact::ContactAxes axes{normal(index, 0), normal(index, 1)};
  const double n = normal_force(index), t = tangential_force(index, 1);
  return {tangential_force(index, 0), axes.y(n, t), axes.z(n, t)};
}

Recorder::Recorder(const transient::Scene& scene, std::vector<ObservedNode> nodes,
                   const transient::OutputGrid& grid, Eigen::VectorXd masses)
    : scene_(scene), nodes_(std::move(nodes)), masses_(std::move(masses)),
      acceleration_(scene.system.size()) {
  const Eigen::Index nt = grid.count;
  for (const auto& motion : scene.motions)
    motions_.emplace_back(motion, scene.duration);
  out_.time.setZero(nt);
  out_.modal_displacement.setZero(scene.system.size(), nt);
  out_.modal_velocity.setZero(scene.system.size(), nt);
  for (const auto& point : scene.contacts)
    out_.contacts.push_back({point.name,
                             {},
                             {},
                             Eigen::VectorXd::Zero(nt),
                             Eigen::VectorXd::Zero(nt),
                             Eigen::MatrixXd::Zero(nt, 2),
                             std::vector<std::uint8_t>(static_cast<std::size_t>(nt), open),
                             Eigen::MatrixXd::Zero(nt, 2)});
  for (const auto& node : nodes_)
    out_.nodes.push_back({node.name, {}, {}, Eigen::MatrixXd::Zero(nt, 3)});
}

void Recorder::add_reactions(const std::vector<FollowedForce>& forces) {
  for (const FollowedForce& force : forces)
    if (!force.section)
      reactions_.push_back(force);
}

void Recorder::state(std::int64_t index, double time, const double* q, const double* v) {
  out_.time(index) = time;
  std::copy_n(q, scene_.system.size(), out_.modal_displacement.col(index).data());
  std::copy_n(v, scene_.system.size(), out_.modal_velocity.col(index).data());
  for (std::size_t c = 0; c < scene_.contacts.size(); ++c)
    set_gap(c, index, place(c, index, time));
}

void Recorder::set_gap(std::size_t contact, std::int64_t index, const core::Vec3& place) {
  const auto here = contact::locate(scene_.contacts[contact].support.obstacle, place.y(), place.z());
  out_.contacts[contact].gap(index) = here.gap;
  out_.contacts[contact].normal.row(index) << here.ny, here.nz;
}

/// A contact's node from its obstacle's centre, where the modes and what carries it have taken it.
core::Vec3 Recorder::place(std::size_t contact, std::int64_t index, double time) const {
  const auto& point = scene_.contacts[contact];
  core::Vec3 x = point.rest;
  if (point.modes.empty())
    x.noalias() += point.b * out_.modal_displacement.col(index);
  else
    x += point.moved_by(out_.modal_displacement.col(index));
  for (Eigen::Index k = 0; k < point.imposed.cols(); ++k)
    x += motions_[static_cast<std::size_t>(k)](time).displacement * point.imposed.col(k);
  return x;
}

void Recorder::forces(std::int64_t index, double time, const double* load,
                      std::span<const transient::ContactForce> contacts) {
  const bool wanted = !nodes_.empty();
  if (wanted) {
    const auto& system = scene_.system;
    const auto q = out_.modal_displacement.col(index), v = out_.modal_velocity.col(index);
    acceleration_ = Eigen::Map<const Eigen::VectorXd>(load, system.size());
    acceleration_.array() -= system.stiffness.array() * q.array();
    if (system.damping_matrix.size() > 0)
      acceleration_.noalias() -= system.damping_matrix * v;
    else
      acceleration_.array() -= system.damping.array() * v.array();
  }
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    ContactSeries& series = out_.contacts[c];
    if (series.gap(index) > 0.0)
      continue; // open at this instant, whatever the steps around it
    const auto& f = contacts[c];
    series.normal_force(index) = f.normal;
    if (f.normal > 0.0 || f.friction.x != 0.0 || f.friction.t != 0.0)
      series.normal.row(index) << f.axes.ny, f.axes.nz;
    if (f.normal > 0.0)
      series.state[static_cast<std::size_t>(index)] =
          f.slides || !scene_.contacts[c].support.friction.active() ? slides : sticks;
    series.tangential_force(index, 0) = f.friction.x;
    series.tangential_force(index, 1) = f.friction.t;
    if (wanted) {
      scene_.contacts[c].for_ranges([&](Eigen::Index first, const auto& b) {
        acceleration_.segment(first, b.cols()) +=
            f.friction.x * b.row(0).transpose() + f.y() * b.row(1).transpose() + f.z() * b.row(2).transpose();
      });
    }
  }
  if (wanted && masses_.size() > 0)
    acceleration_.array() /= masses_.array();
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    auto row = out_.nodes[k].acceleration.row(index).transpose();
    row.noalias() = nodes_[k].rows * acceleration_;
    for (Eigen::Index m = 0; m < nodes_[k].imposed.cols(); ++m)
      row += motions_[static_cast<std::size_t>(m)].acceleration(time) * nodes_[k].imposed.col(m);
  }
  served_ = index + 1;
}

void Recorder::visit(core::StateArchive& state) {
  state(served_);
  if (served_ < 0 || served_ > out_.time.size())
    throw core::StateMismatch();
  // by columns, one output a row (but of the modes: one a column)
  const auto first_rows = [&](auto& columns) {
    for (Eigen::Index column = 0; column < columns.cols(); ++column)
      state.block(columns.col(column).data(), static_cast<std::size_t>(served_));
  };
  const auto values = static_cast<std::size_t>(served_ * scene_.system.size());
  state.block(out_.time.data(), static_cast<std::size_t>(served_));
  state.block(out_.modal_displacement.data(), values);
  state.block(out_.modal_velocity.data(), values);
  for (ContactSeries& c : out_.contacts) {
    first_rows(c.gap);
    first_rows(c.normal_force);
    first_rows(c.tangential_force);
    first_rows(c.normal);
    state.block(c.state.data(), static_cast<std::size_t>(served_));
  }
  for (NodeSeries& n : out_.nodes)
    first_rows(n.acceleration);
}

TimeSeries Recorder::series() && {
  if (served_ < out_.time.size()) { // a run that was cut short
    out_.time.conservativeResize(served_);
    out_.modal_displacement.conservativeResize(Eigen::NoChange, served_);
    out_.modal_velocity.conservativeResize(Eigen::NoChange, served_);
    for (auto& c : out_.contacts) {
      c.gap.conservativeResize(served_);
      c.normal_force.conservativeResize(served_);
      c.tangential_force.conservativeResize(served_, Eigen::NoChange);
      c.normal.conservativeResize(served_, Eigen::NoChange);
      c.state.resize(static_cast<std::size_t>(served_));
    }
    for (auto& n : out_.nodes)
      n.acceleration.conservativeResize(served_, Eigen::NoChange);
  }
  // one product for all contacts and nodes: many rows at once use the processor's cache; contacts of single structures take theirs alone
  const auto contacts = static_cast<Eigen::Index>(scene_.contacts.size()),
             nodes = static_cast<Eigen::Index>(nodes_.size());
  const bool by_structure =
      std::all_of(scene_.contacts.begin(), scene_.contacts.end(),
                  [](const transient::ContactPoint& point) { return !point.modes.empty(); });
  const Eigen::Index together = by_structure ? 0 : contacts;
  Eigen::MatrixXd rows(3 * (together + nodes), scene_.system.size());
  for (Eigen::Index c = 0; c < together; ++c)
    rows.middleRows<3>(3 * c) = scene_.contacts[static_cast<std::size_t>(c)].over_all(scene_.system.size());
  for (Eigen::Index k = 0; k < nodes; ++k)
    rows.middleRows<3>(3 * (together + k)) = nodes_[static_cast<std::size_t>(k)].rows;
  const auto distribute = [&](const Eigen::MatrixXd& modal, Eigen::MatrixXd ContactSeries::*of_contact,
                              Eigen::MatrixXd NodeSeries::*of_node) {
    const Eigen::MatrixXd all = rows * modal;
    for (Eigen::Index c = 0; c < together; ++c)
      out_.contacts[static_cast<std::size_t>(c)].*of_contact = all.middleRows<3>(3 * c).transpose();
    for (Eigen::Index c = together; c < contacts; ++c) {
      Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(3, modal.cols());
      scene_.contacts[static_cast<std::size_t>(c)].for_ranges(
          [&](Eigen::Index first, const auto& b) { moved += b * modal.middleRows(first, b.cols()); });
      out_.contacts[static_cast<std::size_t>(c)].*of_contact = moved.transpose();
    }
    for (Eigen::Index k = 0; k < nodes; ++k)
      out_.nodes[static_cast<std::size_t>(k)].*of_node = all.middleRows<3>(3 * (together + k)).transpose();
  };
  distribute(out_.modal_displacement, &ContactSeries::displacement, &NodeSeries::displacement);
  distribute(out_.modal_velocity, &ContactSeries::velocity, &NodeSeries::velocity);
  add_motions();
  set_reactions();
  return std::move(out_);
}

void Recorder::set_reactions() {
  if (reactions_.empty())
    return;
  for (const FollowedForce& reaction : reactions_) {
    out_.reactions.push_back({reaction.name, (reaction.rows * out_.modal_displacement).transpose()});
    Eigen::MatrixXd& force = out_.reactions.back().force;
    for (Eigen::Index c = 0; 3 * c < reaction.by_contacts.cols(); ++c) {
      const ContactSeries& contact = out_.contacts[static_cast<std::size_t>(c)];
      for (Eigen::Index i = 0; i < out_.time.size(); ++i)
        force.row(i) += contact.force(i).transpose() * reaction.by_contacts.middleCols<3>(3 * c).transpose();
    }
    const bool damped = reaction.by_velocity.size() > 0;
    if (damped)
      force += (reaction.by_velocity * out_.modal_velocity).transpose();
    for (Eigen::Index k = 0; k < reaction.imposed.cols(); ++k)
      for (Eigen::Index i = 0; i < out_.time.size(); ++i) {
        const signals::MotionState state = motions_[static_cast<std::size_t>(k)](out_.time(i));
        force.row(i) += state.displacement * reaction.imposed.col(k).transpose();
        if (damped)
          force.row(i) += state.velocity * reaction.imposed_velocity.col(k).transpose();
      }
  }
  add_loads_to_reactions();
}

/// Each function of time is evaluated once an output, for all loads and reactions.
void Recorder::add_loads_to_reactions() {
  const std::vector<std::size_t> first = vibration::first_with_function(scene_.loads);
  for (std::size_t l = 0; l < first.size(); ++l) {
    if (first[l] != l)
      continue;
    Eigen::MatrixXd together =
        Eigen::MatrixXd::Zero(force_components, static_cast<Eigen::Index>(reactions_.size()));
    for (std::size_t same = l; same < first.size(); ++same)
      for (std::size_t k = 0; k < reactions_.size() && first[same] == l; ++k)
        if (reactions_[k].by_loads.size() > 0)
          together.col(static_cast<Eigen::Index>(k)) +=
              reactions_[k].by_loads.col(static_cast<Eigen::Index>(same));
    if (together.isZero(0.0))
      continue;
    const signals::Signal load(scene_.loads[l].function, scene_.duration);
    for (Eigen::Index i = 0; i < out_.time.size(); ++i) {
      const double value = load(out_.time(i));
      for (std::size_t k = 0; k < reactions_.size(); ++k)
        out_.reactions[k].force.row(i) += value * together.col(static_cast<Eigen::Index>(k)).transpose();
    }
  }
}

/// What carries contacts and nodes joins their displacements and velocities.
void Recorder::add_motions() {
  const auto add = [](auto& series, Eigen::Index i, const signals::MotionState& s, const auto& along) {
    series.displacement.row(i) += s.displacement * along;
    series.velocity.row(i) += s.velocity * along;
  };
  for (std::size_t k = 0; k < motions_.size(); ++k)
    for (Eigen::Index i = 0; i < out_.time.size(); ++i) {
      const signals::MotionState s = motions_[k](out_.time(i));
      for (std::size_t c = 0; c < scene_.contacts.size(); ++c)
        if (const Eigen::MatrixXd& imposed = scene_.contacts[c].imposed; imposed.size() > 0)
          add(out_.contacts[c], i, s, imposed.col(static_cast<Eigen::Index>(k)).transpose());
      for (std::size_t n = 0; n < nodes_.size(); ++n)
        if (const Eigen::MatrixXd& imposed = nodes_[n].imposed; imposed.size() > 0)
          add(out_.nodes[n], i, s, imposed.col(static_cast<Eigen::Index>(k)).transpose());
    }
}

} // namespace fretwork::post
