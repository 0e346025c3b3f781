// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Collocation at the nodes 0, 1/2, 1 of a step (Lobatto): the modes move exactly under a force that is the quadratic through its
/// values at the nodes (polynomial_flow.hpp; coupled_flow.hpp where a damping matrix couples them), and the contact forces obey their laws at the nodes (nodal_solver.hpp, nodal_contact.hpp).
/// Loads are sampled at the nodes.
///
/// Order 4 in displacement, velocity and force, with damping and friction, on a path along which the laws are smooth: the end of a
/// step is Simpson's rule on the exact flow; where a contact closes, opens, sticks or slips inside a step its path there is
/// followed (inner_path.hpp) and the step is of order 2, with a small error (with a normal damper, whose force jumps at a touch, 1: of the
/// velocity after an impact with xi = 0.1, 1e-4 at w_c h = 0.3).
/// Friction with the memory `reference`: order 4 in stick and in slip, at a change between them order 1, as its force jumps with the
/// step. No limit by the modes' frequencies. Contacts: w_c h < 2; above 1 a run without losses gains energy (in 200 impacts 1 % at 0.5, 19 % at 1, 150 % at 1.5). Cost: the laws at two nodes for each sweep.
/// A step whose equations are not solved is made in two halves, these again if need be, down to h/1024 (tables made beforehand); what
/// fails then is StepFailure::contacts. Steps grow again on the grid of the halves.
///
/// Records stand at the nodes 0 and 1/2; they stand for Simpson's weights, h/6 on each side and 2 h/3.
/// Energy: modal energies and the works of loads and contacts on the modes are exact. The laws' losses, and what moving obstacles bring
/// (obstacle_motion.hpp), are Simpson's sums of powers (nodal_losses.hpp), of contacts with inner paths the sums along these. The residual is of
/// the scheme's order.
/// Source: Lobatto IIIA (Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.7) on the variation of constants.
#include "transient/collocation/collocation.hpp"
#include "transient/collocation/nodal_losses.hpp"
#include "transient/collocation/nodal_solver.hpp"
#include "transient/contacts/contact_trial.hpp"
#include "transient/contacts/obstacle_motion.hpp"
#include "vibration/load_sum.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fretwork::transient {
namespace {

constexpr int halvings = 10;
constexpr std::int64_t grid = std::int64_t{1} << halvings;

/// Integrals to the nodes 1/2 and 1 of the quadratic through values at the nodes.
constexpr double to_middle[3] = {5.0 / 24.0, 1.0 / 3.0, -1.0 / 24.0};
constexpr double to_end[3] = {1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0};
class Collocation final : public Scheme {
public:
  Collocation(const Scene& scene, double step)
      : system_(vibration::with_diagonal(scene.system)), h_(step), loads_(scene, step),
        contacts_(scene.contacts, scene.system.size()), motion_(contacts_),
        obstacles_(scene, contacts_), obstacle_at_{obstacles_.workspace(), obstacles_.workspace(),
                                                   obstacles_.workspace()},
        solver_(contacts_), trial_(contacts_.count), coupled_(system_, step, 2, halvings + 1),
        k_(kernels::padded_copy(system_.stiffness)), powers_(3 * static_cast<std::size_t>(contacts_.count)),
        carried_(static_cast<std::size_t>(contacts_.count)) {
    closed_.reserve(static_cast<std::size_t>(contacts_.count));
    const auto n = static_cast<std::size_t>(contacts_.padded_modes);
    for (vibration::Nodes* nodes : {&q_, &v_, &load_, &force_})
      for (kernels::Array& a : nodes->at)
        a.assign(n, 0.0);
    q_.at[0] = kernels::padded_copy(scene.q0);
    v_.at[0] = kernels::padded_copy(scene.v0);
    levels_.reserve(halvings + 1);
    for (int level = 0; level <= halvings; ++level) {
      spans_[static_cast<std::size_t>(level)] = std::ldexp(h_, -level);
      levels_.emplace_back(system_, contacts_, spans_[static_cast<std::size_t>(level)], coupled_, level);
    }
    for (kernels::Array& a : load_.at)
      loads_.at(0.0, a.data());
    kernels::gather_two(contacts_.gather, q_.at[0].data(), v_.at[0].data(), motion_.u(0), motion_.v(0));
    obstacles_.at(0.0, obstacle_at_[0]);
    obstacle_at_[0].add_to(motion_.u(0), motion_.v(0));
    solver_.start(motion_);
    solver_.add_forces(0, force_.at[0].data());
    energy_[0].start(modal_energy(0) + solver_.spring_energy(0));
    counts_.step_min = counts_.step_max = h_;
  }

  const Record& advance() override {
    if (at_start_) {
      at_start_ = false;
      show(1);
      return record_;
    }
    if (counts_.steps > 0)
      accept();
    make_step();
    at_start_ = true;
    show(0);
    return record_;
  }

  [[nodiscard]] double next_time() const override {
    if (failure_ != StepFailure::none)
      return std::numeric_limits<double>::infinity();
    if (at_start_)
      return time_at(place_) + 0.5 * span();
    return counts_.steps > 0 ? time_at(place_ + size()) : 0.0;
  }

  void state_at(double time, double* q, double* v) override {
    const double t = time - time_at(place_);
    for (Eigen::Index j = 0; j < system_.size(); ++j) {
      const auto i = static_cast<std::size_t>(j);
      if (t == 0.0 || counts_.steps == 0) {
        q[j] = q_.at[0][i];
        v[j] = v_.at[0][i];
        continue;
      }
      const auto state = vibration::state_under(system_.stiffness(j), system_.damping(j), span(), t,
                                                q_.at[0][i], v_.at[0][i], forces(i));
      q[j] = state.q;
      v[j] = state.v;
    }
    if (t == 0.0 || counts_.steps == 0)
      return;
    const auto force = [&](Eigen::Index mode, int k, double from, double length) {
      return vibration::part_of(forces(static_cast<std::size_t>(mode)), from / span(),
                                length / span())[static_cast<std::size_t>(k)];
    };
    coupled_.inside(t, q_.at[0].data(), v_.at[0].data(), force, q, v);
  }

  void load_at(double time, double* force) override { loads_.observe(time, force); }

  [[nodiscard]] StepCounts counts() const override {
    StepCounts out = counts_;
    out.evaluations = contacts_.count > 0 ? 2 * (counts_.steps + counts_.rejected) : 0;
    return out;
  }
  [[nodiscard]] StepFailure failure() const override { return failure_; }

  void visit(core::StateArchive& state) override {
    state(q_, v_, load_, force_, motion_, solver_, place_, level_, at_start_, failure_, counts_);
    state(energy_, powers_, closed_);
  }

private:
  struct Level {
    Level(const vibration::System& system, const PackedContacts& contacts, double h,
          vibration::CoupledFlow& coupled, int level)
        : flow(system, h, &coupled, level), tables(contacts, flow, h) {}
    vibration::PolynomialFlow flow;
    NodalTables tables;
  };

  /// Modal force at the nodes.
  [[nodiscard]] std::array<double, 3> forces(std::size_t mode) const {
    std::array<double, 3> f{};
    for (std::size_t node = 0; node < 3; ++node)
      f[node] = load_.at[node][mode] + force_.at[node][mode];
    return f;
  }
  [[nodiscard]] std::int64_t size() const { return grid >> level_; }
  [[nodiscard]] double span() const { return spans_[static_cast<std::size_t>(level_)]; }
  /// Time of a place on the grid of the smallest steps.
  [[nodiscard]] double time_at(std::int64_t place) const {
    return static_cast<double>(place / grid) * h_ +
           static_cast<double>(place % grid) / static_cast<double>(grid) * h_;
  }
  [[nodiscard]] double modal_energy(std::size_t node) const {
    return 0.5 *
           kernels::twice_energy(contacts_.padded_modes, k_.data(), q_.at[node].data(), v_.at[node].data());
  }

  /// The end of the step becomes the start of the next.
  void accept() {
    for (vibration::Nodes* nodes : {&q_, &v_, &load_, &force_})
      nodes->at[0].swap(nodes->at[2]);
    const std::size_t stride = motion_.stride;
    std::copy_n(motion_.u(2), stride, motion_.u(0));
    std::copy_n(motion_.v(2), stride, motion_.v(0));
    std::fill(carried_.begin(), carried_.end(), Power{});
    carried_time_ = span() / 6.0;
    for (const int c : solver_.alive()) {
      const Power& p = powers_[3 * static_cast<std::size_t>(c) + 2];
      carried_[static_cast<std::size_t>(c)] = {carried_time_ * p.slider, carried_time_ * p.damper};
    }
    solver_.accept();
    if (solver_.has_inner_paths()) { // their part of the quadratic ends with the step
      std::fill(force_.at[0].begin(), force_.at[0].end(), 0.0);
      solver_.add_law_forces(0, force_.at[0].data());
    }
    energy_[0] = energy_[2];
    place_ += size();
    if (level_ > 0 && place_ % (2 * size()) == 0)
      --level_;
  }

  void make_step() {
    while (!try_step())
      if (level_ == halvings) {
        failure_ = StepFailure::contacts;
        return;
      } else {
        ++counts_.rejected;
        ++level_;
      }
    ++counts_.steps;
    counts_.step_min = std::min(counts_.step_min, span());
  }

  /// The step from node 0, or false where the contacts were not solved.
  bool try_step() {
    const Level& now = levels_[static_cast<std::size_t>(level_)];
    if (!loads_.constant())
      for (int j = 1; j <= 2; ++j)
        loads_.at(time_at(place_) + 0.5 * j * span(), load_.at[j].data());
    std::fill(force_.at[1].begin(), force_.at[1].end(), 0.0);
    std::fill(force_.at[2].begin(), force_.at[2].end(), 0.0);
    if (contacts_.count > 0) {
      now.flow.predict(load_, force_, q_, v_);
      gather();
      if (!solver_.solve(now.tables, motion_))
        return false;
      solver_.add_forces(1, force_.at[1].data());
      solver_.add_forces(2, force_.at[2].data());
    }
    balance_energy(now.flow.move(load_, force_, q_, v_));
    return true;
  }

  /// Contacts at the nodes 1/2 and 1, where the modes have them; obstacles at all three.
  void gather() {
    for (int j = 0; j < 3; ++j) {
      const auto node = static_cast<std::size_t>(j);
      obstacles_.at(time_at(place_) + 0.5 * j * span(), obstacle_at_[node]);
      if (j == 0)
        continue;
      kernels::gather_two(contacts_.gather, q_.at[node].data(), v_.at[node].data(), motion_.u(j),
                          motion_.v(j));
      obstacle_at_[node].add_to(motion_.u(j), motion_.v(j));
    }
  }

  /// Energies at the nodes 1/2 and 1.
  void balance_energy(const vibration::PolynomialFlow::Works& work) {
    const double before = modal_energy(0), h = span();
    Power to[2];
    for (const int c : solver_.alive()) {
      const ContactNode* nodes = solver_.nodes(c);
      Power* p = &powers_[3 * static_cast<std::size_t>(c)];
      for (int j = 0; j < 3; ++j)
        p[j] = power_of(contacts_.supports[static_cast<std::size_t>(c)], nodes, j, h);
      if (const PathLoss* loss = solver_.inner_losses(c)) {
        spread(loss, nodes, h, p);
        for (int j = 0; j < 2; ++j) {
          to[j].slider += loss[j].slider;
          to[j].damper += loss[j].damper;
        }
        continue;
      }
      for (int j = 0; j < 3; ++j) {
        to[0].slider += h * to_middle[j] * p[j].slider;
        to[0].damper += h * to_middle[j] * p[j].damper;
        to[1].slider += h * to_end[j] * p[j].slider;
        to[1].damper += h * to_end[j] * p[j].damper;
      }
    }
    double input[2] = {work.load[0], work.load[1]};
    for (int j = 0; j < 3; ++j) {
      const double power = solver_.power(j, obstacle_at_[static_cast<std::size_t>(j)].w);
      input[0] -= h * to_middle[j] * power;
      input[1] -= h * to_end[j] * power;
    }
    const double through[2] = {std::abs(input[0]), std::abs(input[0]) + std::abs(input[1] - input[0])};
    for (std::size_t j = 0; j < 2; ++j) {
      Energy& e = energy_[j + 1] = energy_[0];
      const double moving = modal_energy(j + 1);
      e.load_work += input[j];
      e.scale += through[j];
      e.modal_damping += work.load[j] + work.contact[j] - (moving - before);
      e.contact_damping += to[j].damper;
      e.friction += to[j].slider;
      e.stored = moving + solver_.spring_energy(static_cast<int>(j) + 1);
    }
  }

  /// The record of a node of the step.
  void show(int node) {
    const double h = failure_ == StepFailure::none ? span() : 0.0;
    const double own = h * to_end[node];
    record_.time = time_at(place_) + 0.5 * node * h;
    record_.step = own + (node == 0 ? carried_time_ : 0.0);
    record_.energy = energy_[node];
    trial_.clear();
    for (const int c : closed_) // also of contacts that nothing holds alive any more
      if (const ContactNode& n = solver_.nodes(c)[node]; !(n.normal > 0.0)) {
        trial_.states[static_cast<std::size_t>(c)].departure = -n.rate;
        trial_.opened.push_back(c);
      }
    for (const int c : solver_.alive()) {
      const auto i = static_cast<std::size_t>(c);
      const ContactNode& n = solver_.nodes(c)[node];
      ContactState& state = trial_.states[i];
      if (n.normal > 0.0) {
        const Power& p = powers_[3 * i + static_cast<std::size_t>(node)];
        const Power carried = node == 0 ? carried_[i] : Power{};
        state = {n.normal,
                 n.axes,
                 n.friction,
                 record_.step * n.slip,
                 n.slides ? record_.step * norm(n.slip) : 0.0,
                 own * p.slider + carried.slider,
                 own * p.damper + carried.damper,
                 n.approach,
                 n.slides};
        state.act_throughout(!std::binary_search(closed_.begin(), closed_.end(), c));
        trial_.active.push_back(c);
      }
    }
    closed_ = trial_.active;
    transient::show(record_, contacts_, q_.at[node].data(), motion_.u(node), trial_);
  }

  vibration::System system_;
  double h_;
  vibration::LoadSum loads_;
  PackedContacts contacts_;
  NodalMotion motion_;
  ObstacleMotion obstacles_;
  std::array<ImposedMotion, 3> obstacle_at_; ///< what carries the contacts at the nodes
  NodalSolver solver_;
  ContactTrial trial_;
  vibration::CoupledFlow coupled_; ///< of modes that a damping matrix couples, over h
  std::vector<Level> levels_;
  std::array<double, halvings + 1> spans_; ///< s, of their steps
  vibration::Nodes q_, v_, load_,
      force_; ///< modes, their velocities, modal forces of loads and contacts at the nodes
  kernels::Array k_;

  std::int64_t place_ = 0; ///< of node 0, in steps of h/1024
  int level_ = 0;          ///< the step is h/2^level
  bool at_start_ = false;  ///< the record of node 0 has been given, that of node 1/2 not yet
  StepFailure failure_ = StepFailure::none;
  StepCounts counts_;
  Energy energy_[3];           ///< at the nodes
  std::vector<Power> powers_;  ///< 3 nodes of each contact
  std::vector<Power> carried_; ///< J: of the step before, for the record at its end
  std::vector<int> closed_;    ///< contacts with a force at the last record
  double carried_time_ = 0.0;
  Record record_;
};

} // namespace

std::unique_ptr<Scheme> make_collocation(const Scene& scene, double step) {
  return std::make_unique<Collocation>(scene, step);
}

} // namespace fretwork::transient
