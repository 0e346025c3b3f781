// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The splitting scheme: the exact motion of the modes over a step h, the motion of the contacts within it.
/// 1. The modes move under the loads and the contact forces held from the last step (modal_flow.hpp).
/// 2. Where no contact can be closed in the step that is their motion. Steps of several h are tried first: the contact-free macro-steps.
/// 3. Otherwise the contacts near their obstacles move in shorter intervals along that motion (contact_sweeps.hpp), and the modes move
///    once more, under the mean and the first moment of the forces found.
/// Order 2 in displacement, velocity and force, with dampers and friction, through impacts. Step 3 asks w_c dt to be resolved, dt the interval;
/// h w_max below 2.5, in which the cubic that contacts follow between the ends of a step is the modes' motion to (w h)^4/384.
///
/// No contact is closed in a step of length L where its gaps at both ends exceed a third of its speeds there times L: its path is in the hull of u0,
/// u0 + w0 L/3, u1 - w1 L/3, u1, and gaps are concave functions of it; of round bodies side by side, whose gap is convex, where they exceed the
/// speeds times L.
///
/// Energy: works of loads and contact forces on the modes are exact, modal damping is what the flow does not keep of them. The residual of the
/// energy balance is what the contacts' laws, along their own path, made otherwise than the modes.
///
/// A record stands for a step and for the forces in it, its positions are those in the middle.
#include "transient/splitting/splitting.hpp"
#include "transient/contacts/obstacle_motion.hpp"
#include "transient/contacts/row_scatter.hpp"
#include "transient/modes/mass_scaling.hpp"
#include "transient/modes/modal_flow.hpp"
#include "transient/splitting/contact_sweeps.hpp"
#include "transient/splitting/flights.hpp"
#include "transient/splitting/replays.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace fretwork::transient {
namespace {

/// Steps of one h after a macro-step that would have met a contact.
constexpr int steps_after_meeting = 4;
/// Of a contact's clearance: what it moves in a macro-step at most, so that the middles of steps give deviations of displacements to 0.1 %.
constexpr double longest_macro_step = 1.0 / 16.0;

/// Numbers of steps that are made at once, the longest first.
std::vector<int> lengths_up_to(int longest) {
  std::vector<int> lengths;
  for (int length = longest; length > 1 && lengths.size() < 3; length /= 2)
    lengths.push_back(length);
  lengths.push_back(1);
  return lengths;
}

class Splitting final : public Replayable {
public:
  /// @param scene  in the coordinates p of mass_scaling.hpp   @param shown  n, q = shown p; empty: all 1
  Splitting(const Scene& scene, double step, const Eigen::VectorXd& shown, int longest, int parts)
      : h_(step), duration_(scene.duration), lengths_(lengths_up_to(longest)), modes_(scene, step, lengths_),
        contacts_(scene.contacts, scene.system.size()), start_(contacts_), end_(contacts_),
        obstacles_(scene, contacts_, step), carried_{obstacles_.room(), obstacles_.room()}, rows_(contacts_),
        sweeps_(make_sweeps(scene, parts)), steps_{Step(contacts_), Step(contacts_), Step(contacts_)} {
    const auto n = static_cast<std::size_t>(contacts_.padded_modes);
    held_.assign(n, 0.0);
    if (shown.size() > 0) {
      shown_.assign(n, 1.0);
      std::copy_n(shown.data(), shown.size(), shown_.begin());
    }
    const auto count = static_cast<std::size_t>(contacts_.count);
    was_near_.assign(count, 1); // nothing is known yet
    near_.reserve(count);
    for (auto& f : factors_)
      f.resize(3 * count);
    row_numbers_.resize(3 * count);
    const bool convex =
        std::any_of(contacts_.supports.begin(), contacts_.supports.end(), [](const contact::Support& s) {
          return contact::properties_of(s.obstacle).gap_bound.radial < 0.0;
        });
    window_ = convex ? 1.0 : 1.0 / 3.0;

    Step& first = steps_[0];
    std::copy_n(scene.q0.data(), scene.q0.size(), first.from.q.begin());
    std::copy_n(scene.v0.data(), scene.v0.size(), first.from.v.begin());
    for (Step& s : steps_)
      modes_.start(s.from);
    modes_.load_about(0.0, first.load);
    end_.gather(first.from.q.data(), first.from.v.data());
    obstacles_.at(0.0, carried_[1]);
    carried_[1].add_to(end_);
    moving_ = modes_.energy(first.from);
    booked_.initial = booked_.throughput = booked_.stored = moving_ + end_.spring_energy();
    hold_at_start();
    make();
  }

  const Record& advance() override {
    const Step& now = steps_[made_];
    published_ = made_;
    record_.time = now.start + 0.5 * now.length;
    record_.step = now.length;
    record_.energy = now.energy;
    show(record_, contacts_, now.q.data(), now.u.data(), now.trial);
    counts_.steps += now.steps;
    made_ = next(made_);
    make();
    return record_;
  }

  void state_at(double time, double* q, double* v) override {
    const Step& last = steps_[published_];
    const bool inside = counts_.steps > 0 && time <= last.start + last.length;
    const std::size_t of = inside ? published_ : made_;
    const Step& s = steps_[of];
    modes_.inside(time - s.start, s.length, s.from, s.load, steps_[next(of)].load,
                  s.pushed ? &s.force : nullptr, q, v);
    scale(q, 1.0);
    scale(v, 1.0);
  }

  void load_at(double time, double* force) override {
    modes_.load_at(time, force);
    modes_.add_motion_forces(force);
    scale(force, -1.0);
  }

  double follow(const Replayable& running) override {
    const auto& other = static_cast<const Splitting&>(running);
    const Step& from = other.steps_[next(other.made_)];
    Step& first = steps_[made_];
    first.start = from.start;
    first.from = from.from;
    done_ = std::llround(from.start / h_);
    modes_.load_about(first.start, first.load);
    end_.u = other.end_.u;
    end_.w = other.end_.w;
    obstacles_.at(first.start, carried_[1]);
    sweeps_.follow(other.sweeps_);
    was_near_ = other.was_near_;
    near_ = other.near_;
    moving_ = other.moving_;
    booked_ = other.booked_;
    wait_ = other.wait_;
    scatter(nullptr);
    make();
    return first.start;
  }

  void divide(int contact, int parts) override { sweeps_.divide(contact, parts); }

  [[nodiscard]] double next_time() const override { return steps_[made_].start + 0.5 * steps_[made_].length; }

  [[nodiscard]] StepCounts counts() const override {
    StepCounts counts = counts_;
    counts.step_min = counts.step_max = h_;
    return counts;
  }

  void visit(core::StateArchive& state) override {
    state(steps_, published_, made_, end_, held_, holds_, was_near_, sweeps_);
    state(carried_[1].u, carried_[1].w, done_, wait_, moving_, booked_, counts_);
    state(row_count_, row_numbers_, factors_[0]);
  }

private:
  /// A step: where it starts, what acts in it and what its record shows.
  struct Step {
    explicit Step(const PackedContacts& contacts) : trial(contacts.count) {
      const auto n = static_cast<std::size_t>(contacts.padded_modes);
      for (kernels::Array* a : {&from.q, &from.v, &load, &force.mean, &force.slope, &q})
        a->assign(n, 0.0);
      u.assign(static_cast<std::size_t>(contacts.stride()), 0.0);
    }
    double start = 0.0, length = 0.0; ///< s
    int steps = 0;                    ///< of h
    ModalFlow::State from;
    kernels::Array load; ///< at its start; that at its end is the next step's
    bool pushed = false; ///< contacts act in it, with the force
    ModalForce force;
    kernels::Array q, u; ///< in its middle
    ContactTrial trial;
    Energy energy; ///< at its end
    void visit(core::StateArchive& state) {
      state(start, length, steps, from, load, pushed, force, q, u, trial, energy);
    }
  };
  [[nodiscard]] static std::size_t next(std::size_t step) { return step == 2 ? 0 : step + 1; }

  ContactSweeps make_sweeps(const Scene& scene, int parts) {
    ContactBlocks blocks(scene);
    std::vector<std::vector<Mobility>> mobility = step_mobility(scene, blocks);
    return {contacts_, std::move(blocks), std::move(mobility), h_, parts};
  }

  /// W of contact_sweeps.hpp. Blocks share no mode: one motion of all modes answers a force in each of them.
  std::vector<std::vector<Mobility>> step_mobility(const Scene& scene, const ContactBlocks& blocks) {
    std::vector<std::vector<Mobility>> out;
    std::size_t most = 0;
    for (const auto& contacts : blocks.contacts) {
      out.emplace_back(contacts.size() * contacts.size());
      most = std::max(most, contacts.size());
    }
    kernels::Array force(static_cast<std::size_t>(contacts_.padded_modes)), moved(force);
    for (std::size_t from = 0; from < most; ++from)
      for (int component = 0; component < contacts_.components; ++component) {
        std::fill(force.begin(), force.end(), 0.0);
        for (std::size_t b = 0; b < blocks.size(); ++b)
          if (from < blocks.contacts[b].size())
            for_modes(scene, blocks, b, blocks.contacts[b][from],
                      [&](std::size_t mode, const auto& moves) { force[mode] = moves(local_of(component)); });
        modes_.answer(force.data(), moved.data());
        for (std::size_t b = 0; b < blocks.size(); ++b) {
          const auto& contacts = blocks.contacts[b];
          for (std::size_t other = 0; from < contacts.size() && other < contacts.size(); ++other)
            for (int to = 0; to < contacts_.components; ++to) {
              double sum = 0.0;
              for_modes(scene, blocks, b, contacts[other], [&](std::size_t mode, const auto& moves) {
                sum += moved[mode] * moves(local_of(to));
              });
              out[b][from * contacts.size() + other].w[to][component] = 2.0 / (h_ * h_) * sum;
            }
        }
      }
    return out;
  }
  /// Component x_loc y_loc z_loc of y z x.
  [[nodiscard]] static Eigen::Index local_of(int component) { return (component + 1) % 3; }
  /// visit(mode, column of b) for the modes of a contact in a block.
  template <class Visit>
  static void for_modes(const Scene& scene, const ContactBlocks& blocks, std::size_t block, int contact,
                        const Visit& visit) {
    scene.contacts[static_cast<std::size_t>(contact)].for_ranges([&](Eigen::Index first, const auto& part) {
      if (part.cols() == 0 ||
          blocks.block_of_mode[static_cast<std::size_t>(first)] != static_cast<int>(block))
        return;
      for (Eigen::Index i = 0; i < part.cols(); ++i)
        visit(static_cast<std::size_t>(first + i), part.col(i));
    });
  }

  void scale(double* modal, int power) const {
    for (std::size_t j = 0; j < std::min(shown_.size(), static_cast<std::size_t>(contacts_.modes)); ++j)
      modal[j] *= power > 0 ? shown_[j] : 1.0 / shown_[j];
  }

  /// Contacts that are pressed at the start have been so.
  void hold_at_start() {
    near_.clear();
    for (int c = 0; c < contacts_.count; ++c) {
      const contact::Location at = end_.locate(c);
      const double force =
          contact::normal_force(contacts_.supports[c].normal, -at.gap, end_.sinking(c, at.axes()));
      if (at.gap < 0.0 && force > 0.0) {
        sweeps_.hold(c, at, force);
        near_.push_back(c);
      }
    }
    scatter(nullptr);
  }

  /// The held forces of the near contacts, and those of the step, as forces on the modes.
  void scatter(ModalForce* force) {
    bool slopes = false;
    holds_ = false;
    rows_.clear();
    const auto add = [&](int c, int component, double held, double mean, double slope) {
      if (mean == 0.0 && held == 0.0)
        return;
      factors_[0][rows_.size()] = held;
      factors_[1][rows_.size()] = mean;
      factors_[2][rows_.size()] = slope;
      row_numbers_[rows_.size()] = 3 * c + component;
      rows_.add(c, component);
      holds_ = holds_ || held != 0.0;
      slopes = slopes || slope != 0.0;
    };
    for (const int c : near_) {
      const ContactSweeps::Force& f = sweeps_.force(c);
      add(c, 0, f.held.y, f.mean.y, f.slope.y);
      add(c, 1, f.held.z, f.mean.z, f.slope.z);
      if (contacts_.components == 3)
        add(c, 2, f.held.x, f.mean.x, f.slope.x);
    }
    row_count_ = rows_.size();
    const auto sum = [&](std::size_t which, kernels::Array& to) {
      std::fill(to.begin(), to.end(), 0.0);
      rows_.add_to(factors_[which].data(), to.data());
    };
    if (holds_)
      sum(0, held_);
    if (!force)
      return;
    sum(1, force->mean);
    if (slopes)
      sum(2, force->slope);
    else
      std::fill(force->slope.begin(), force->slope.end(), 0.0);
  }

  /// Of the contacts scattered last: 0: held; 1: over the step.
  [[nodiscard]] RowForces row_forces(std::size_t which) const {
    return {row_count_, row_numbers_.data(), factors_[which].data(),
            which == 0 ? nullptr : factors_[2].data()};
  }

  /// Contacts that may be closed in a step of so many h that ends as `end_` tells.
  void find_near(int length) {
    near_.clear();
    const bool any = end_.find_near(window_ * length * h_);
    for (int c = 0; c < contacts_.count; ++c)
      if (was_near_[c] || (any && end_.near(c)))
        near_.push_back(c);
  }

  /// The modes to the end of a step of so many h, under the forces held.
  ModalFlow::Sums predict(Step& s, int length, Step& to) {
    s.steps = length;
    s.length = length * h_;
    to.start = static_cast<double>(done_ + length) * h_;
    modes_.load_about(to.start, to.load);
    const ModalFlow::Sums sums = holds_ ? modes_.move(s.from, s.load, to.load, held_, row_forces(0), to.from)
                                        : modes_.move(length, s.from, s.load, to.load, to.from);
    end_.gather(to.from.q.data(), to.from.v.data());
    if (!carried_[1].u.empty()) {
      obstacles_.at(to.start, carried_[1]);
      carried_[1].add_to(end_);
    }
    return sums;
  }

  /// Makes the step that `made_` starts.
  void make() {
    Step &s = steps_[made_], &to = steps_[next(made_)];
    start_.u.swap(end_.u); // normals and marks stay with `end_`
    start_.w.swap(end_.w);
    std::swap(carried_[0], carried_[1]);
    ModalFlow::Sums sums;
    const bool far = std::none_of(was_near_.begin(), was_near_.end(), [](char near) { return near != 0; });
    std::size_t length = lengths_.size() - 1;
    if (far && wait_ == 0)
      length = 0;
    while (length + 1 < lengths_.size() && (s.start + lengths_[length] * h_ > duration_ ||
                                            !start_.moves_less(lengths_[length] * h_, longest_macro_step)))
      ++length;
    wait_ = std::max(0, wait_ - 1);
    for (;; length = lengths_.size() - 1, wait_ = steps_after_meeting) {
      sums = predict(s, lengths_[length], to);
      find_near(lengths_[length]);
      if (near_.empty() || length + 1 == lengths_.size())
        break;
    }
    StepLosses losses;
    double brought = 0.0;
    s.pushed = !near_.empty();
    if (s.pushed) {
      ++counts_.evaluations;
      counts_.unconverged += !sweeps_.make(start_, end_, near_, s.trial, losses);
      s.pushed = holds_ || !s.trial.active.empty();
      if (s.pushed)
        sums = push(s, to);
      sweeps_.settle(end_);
      brought = work_of_obstacles(s);
    } else {
      sweeps_.pass(s.steps, s.trial, losses);
    }
    std::fill(was_near_.begin(), was_near_.end(), 0);
    for (const int c : near_)
      was_near_[c] = end_.near(c) || sum_of_sizes(sweeps_.force(c).held) > 0.0;
    show_middle(s, to);
    book(s, sums, losses, brought);
    done_ += s.steps;
  }

  /// The modes take the forces of the contacts.
  ModalFlow::Sums push(Step& s, Step& to) {
    scatter(&s.force);
    const ModalFlow::Sums sums = modes_.push(s.from, s.load, to.load, s.force, row_forces(1), to.from);
    end_.gather(to.from.q.data(), to.from.v.data());
    carried_[1].add_to(end_);
    return sums;
  }

  /// By obstacles that move, on the structure, J.
  [[nodiscard]] double work_of_obstacles(const Step& s) const {
    double work = 0.0;
    if (carried_[0].u.empty() || !s.pushed)
      return work;
    const auto moved = [&](int lane) { return carried_[1].u[lane] - carried_[0].u[lane]; };
    for (const int c : near_) {
      const Components& mean = sweeps_.force(c).mean;
      work -= mean.y * moved(c) + mean.z * moved(contacts_.width + c);
      if (contacts_.components == 3)
        work -= mean.x * moved(2 * contacts_.width + c);
    }
    return work;
  }

  void show_middle(Step& s, const Step& to) {
    modes_.middle(s.steps, s.from, s.load, to.load, s.pushed ? &s.force : nullptr, s.q);
    const double eighth = 0.125 * s.length; // of contacts: by the cubic through both ends
    for (std::size_t lane = 0; lane < s.u.size(); ++lane)
      s.u[lane] = 0.5 * (start_.u[lane] + end_.u[lane]) + eighth * (start_.w[lane] - end_.w[lane]);
    for (std::size_t i = 0; i < shown_.size(); ++i)
      s.q[i] *= shown_[i];
  }

  void book(Step& s, const ModalFlow::Sums& sums, const StepLosses& losses, double brought) {
    booked_.load_work += sums.load_work + brought;
    booked_.throughput += std::abs(sums.load_work) + std::abs(brought);
    booked_.fluid_work += sums.fluid_work;
    booked_.throughput += std::abs(sums.fluid_work);
    booked_.modal_damping += sums.load_work + sums.contact_work + sums.fluid_work - (sums.energy - moving_);
    booked_.contact_damping += losses.damping;
    booked_.friction += losses.friction;
    moving_ = sums.energy;
    booked_.stored = moving_ + sweeps_.spring_energy();
    s.energy = booked_;
  }

  double h_, duration_;
  std::vector<int> lengths_;
  ModalFlow modes_;
  PackedContacts contacts_;
  ContactMotion start_, end_; ///< of the step that is made
  ObstacleMotion obstacles_;
  std::array<Carried, 2> carried_; ///< likewise
  RowScatter rows_;
  ContactSweeps sweeps_;
  std::array<Step, 3> steps_; ///< the one published, the one made, and where that ends
  std::size_t published_ = 0, made_ = 0;

  kernels::Array held_; ///< modal force of the contacts held
  bool holds_ = false;
  std::vector<char> was_near_; ///< at the end of the last step
  std::vector<int> near_;
  double window_;
  std::array<std::vector<double>, 3> factors_; ///< held, mean, slope
  std::vector<int> row_numbers_;               ///< of these: 3 times the contact plus the component
  std::size_t row_count_ = 0;
  kernels::Array shown_; ///< with scaled masses

  std::int64_t done_ = 0; ///< steps of h up to the one that is made
  int wait_ = 0;          ///< steps until macro-steps are tried again
  double moving_ = 0.0;   ///< J, of the modes at the end of the last step
  Energy booked_;
  Record record_;
  StepCounts counts_;
};

} // namespace

std::unique_ptr<Replayable> make_replayable_splitting(const Scene& scene, double step, double fastest,
                                                      int longest, int parts) {
  const Eigen::VectorXd masses = scaled_masses(scene, fastest);
  if ((masses.array() == 1.0).all())
    return std::make_unique<Splitting>(scene, step, Eigen::VectorXd(), longest, parts);
  return std::make_unique<Splitting>(with_masses(scene, masses), step, masses.cwiseSqrt().cwiseInverse(),
                                     longest, parts);
}

std::unique_ptr<Scheme> make_splitting(const Scene& scene, double step, double fastest, int longest,
                                       int parts) {
  if (scene.residual.size() > 0)
    return make_flexible_splitting(scene, step, fastest);
  return make_replayable_splitting(scene, step, fastest, longest, parts);
}

} // namespace fretwork::transient
