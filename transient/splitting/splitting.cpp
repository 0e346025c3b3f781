// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The splitting scheme: the exact motion of the modes over a step h, the motion of the contacts within it.
/// 1. The modes move under the loads and the contact forces held from the last step (modal_flow.hpp).
/// 2. Where no contact can be closed in the step that is their motion. Steps of several h are tried first: the contact-free macro-steps.
/// 3. Otherwise the contacts near their obstacles move in shorter intervals along that motion (coupled_contacts.hpp), and the modes move
///    once more, under the forces found (StepForce). Where these push an open contact into its obstacle, step 3 is made
///    again with it.
/// Order 2 in displacement, velocity and force, with dampers and friction, through impacts. Step 3 asks w_c dt to be resolved, dt the interval;
/// h w_max up to 2, in which the quartic that contacts follow between the ends of a step is the modes' motion to (w h)^5/14000: 0.23 %.
///
/// No contact is closed in a step of length L where its gaps at both ends exceed a third of its speeds there times L: its path is in the hull of u0,
/// u0 + w0 L/3, u1 - w1 L/3, u1, but for what it exceeds the cubic by (4 % of the amplitude of a mode of w h = 2), and gaps are concave functions
/// of it; of round bodies side by side, whose gap is convex, where they exceed the speeds times L. That is the path under the forces held: a contact that others push in and out again within a step is not seen.
///
/// Energy: works of loads and contact forces on the modes are those of the linear forces that stand for their bends (LinearFlow::add_bends), else exact; modal damping is what the flow does not keep of them. The residual of the
/// energy balance is what the contacts' laws, along their own path, made otherwise than the modes. Where forces of motion couple modes their energy, the
/// fluid's work (diagonal_flow.hpp) and with them modal damping are found for the records that are asked for them, exactly; the residual is right in all.
///
/// A record stands for a step and for the forces in it, its positions are those in the middle.
#include "transient/splitting/splitting.hpp"
#include "transient/contacts/obstacle_motion.hpp"
#include "transient/modes/linear_flow.hpp"
#include "transient/modes/mass_scaling.hpp"
#include "transient/splitting/replays.hpp"
#include "transient/splitting/step_forces.hpp"
#include "transient/splitting/step_response.hpp"
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

namespace fretwork::transient {
namespace {

using vibration::ModalFlow;
using vibration::ModalForce;

/// Steps of one h after a macro-step that would have met a contact.
constexpr int steps_after_meeting = 4;
/// Of a contact's clearance: what it moves in a macro-step at most, so that the middles of steps give deviations of displacements to 0.1 %.
constexpr double longest_macro_step = 1.0 / 8.0;

/// Of t^2 (1 - x)^2 (FreePath), its middle over its mean.
constexpr double middle_of_bow = 30.0 / 16.0;

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
  /// @param scene  in the coordinates p of mass_scaling.hpp   @param mode_scales  n, q = mode_scales p; empty: all 1
  Splitting(const Scene& scene, double step, const Eigen::VectorXd& mode_scales,
            const SplittingOptions& options)
      : h_(step), duration_(scene.duration), lengths_(lengths_up_to(options.longest)),
        modes_(scene, step, lengths_), mode_count_(static_cast<std::size_t>(scene.system.size())),
        contacts_(modes_.outputs(scene.contacts), modes_.coordinates(), modes_.has_blocks()),
        inputs_(inputs_of(scene)), start_(contacts_), end_(contacts_), predicted_(contacts_),
        obstacles_(scene, contacts_), imposed_{obstacles_.workspace(), obstacles_.workspace()},
        imposed_in_middle_(obstacles_.workspace()), forces_(inputs_ ? *inputs_ : contacts_, modes_.has_bow()),
        has_bow_(modes_.has_bow() || modes_.loads_bend() || !imposed_in_middle_.u.empty()),
        coupled_(make_coupled(scene, options)), steps_{Step(*this), Step(*this), Step(*this)} {
    const auto n = static_cast<std::size_t>(kernels::padded(static_cast<int>(scene.system.size())));
    if (mode_scales.size() > 0) {
      assert(!modes_.has_blocks()); // none is scaled under forces of motion
      mode_scales_.assign(n, 1.0);
      std::copy_n(mode_scales.data(), mode_scales.size(), mode_scales_.begin());
    }
    if (modes_.has_blocks())
      output_q_.assign(n, 0.0);
    const auto count = static_cast<std::size_t>(contacts_.count);
    const int most_pieces = std::max(most_at_corner, most_refined * options.parts); // of a contact in a step
    for (Step& s : steps_)
      s.trial.pieces.reserve(count * static_cast<std::size_t>(most_pieces));
    modal_bow_.assign(static_cast<std::size_t>(modes_.coordinates()), 0.0);
    load_bend_.assign(static_cast<std::size_t>(modes_.force_numbers()), 0.0);
    bow_.assign(static_cast<std::size_t>(contacts_.stride()), 0.0);
    none_.assign(static_cast<std::size_t>(modes_.force_numbers()), 0.0);
    was_near_.assign(count, 1); // nothing is known yet
    near_.reserve(count);
    pushed_in_.reserve(count);
    const bool convex =
        std::any_of(contacts_.supports.begin(), contacts_.supports.end(), [](const contact::Support& s) {
          return contact::properties_of(s.obstacle).gap_bound.radial < 0.0;
        });
    window_ = convex ? 1.0 : 1.0 / 3.0;

    Step& first = steps_[0];
    for (Step& s : steps_)
      s.from = modes_.start(scene.q0, scene.v0);
    obstacles_.place(0.0, first.from.q.data(), first.from.v.data(), imposed_[1], end_);
    moving_ = modes_.energy_at_start(first.from);
    energy_.start(moving_ + end_.spring_energy());
    preload();
    make();
  }

  const Record& advance() override {
    const Step& now = steps_[made_];
    published_ = made_;
    record_.time = now.start + 0.5 * now.length;
    record_.step = now.length;
    record_.energy = now.energy;
    show(record_, contacts_, modes_.has_blocks() ? nullptr : now.q.data(), now.u.data(), now.trial);
    counts_.steps += now.steps;
    made_ = next(made_);
    make();
    return record_;
  }

  void complete(const RecordParts& parts) override {
    if (!modes_.has_blocks())
      return;
    const Step& now = steps_[published_];
    if (parts.energies)
      record_.energy = now.blocks.whole(now.energy, modes_, steps_[made_].from);
    if (!parts.modes)
      return;
    modes_.modes_in_middle(now.steps, now.from, now.load, now.load_end, now.pushed ? &now.force : nullptr,
                           now.q, output_q_.data());
    record_.q = output_q_.data();
  }

  void state_at(double time, double* q, double* v) override {
    const Step& last = steps_[published_];
    const bool inside = counts_.steps > 0 && time <= last.start + last.length;
    const std::size_t of = inside ? published_ : made_;
    const Step& s = steps_[of];
    modes_.inside(time - s.start, s.length, s.from, s.load, s.load_end, s.pushed ? &s.force : nullptr, q, v);
    scale(q, 1);
    scale(v, 1);
  }

  void load_at(double time, double* force) override {
    modes_.load_at(time, force);
    modes_.add_motion_forces(force);
    scale(force, -1);
  }

  double continue_from(const Replayable& running) override {
    const auto& other = static_cast<const Splitting&>(running);
    const Step& from = other.steps_[next(other.made_)];
    Step& first = steps_[made_];
    first.start = from.start;
    first.from = from.from;
    if (mode_scales_ != other.mode_scales_) {
      for (kernels::Array* modal : {&first.from.q, &first.from.v}) {
        other.scale(modal->data(), 1);
        scale(modal->data(), -1);
      }
    }
    done_ = std::llround(from.start / h_);
    end_.u = other.end_.u;
    end_.w = other.end_.w;
    obstacles_.at(first.start, imposed_[1]);
    coupled_.continue_from(other.coupled_);
    was_near_ = other.was_near_;
    near_ = other.near_;
    moving_ = other.moving_;
    energy_ = other.energy_;
    blocks_ = other.blocks_;
    wait_ = other.wait_;
    forces_.assemble(coupled_, near_, nullptr);
    make();
    return first.start;
  }

  void divide(int contact, int parts) override { coupled_.divide(contact, parts); }

  [[nodiscard]] double next_time() const override { return steps_[made_].start + 0.5 * steps_[made_].length; }

  [[nodiscard]] StepCounts counts() const override {
    StepCounts counts = counts_;
    counts.step_min = counts.step_max = h_;
    return counts;
  }

  void visit(core::StateArchive& state) override {
    state(steps_, published_, made_, end_, was_near_, coupled_, forces_);
    state(imposed_[1].u, imposed_[1].w, done_, wait_, moving_, energy_, blocks_, counts_);
  }

private:
  /// A step: where it starts, what acts in it and what its record shows.
  struct Step {
    explicit Step(const Splitting& of) : trial(of.contacts_.count) {
      const auto n = static_cast<std::size_t>(of.modes_.force_numbers());
      for (kernels::Array* a : {&load, &load_end, &force.mean, &force.slope})
        a->assign(n, 0.0);
      q.assign(static_cast<std::size_t>(of.modes_.coordinates()), 0.0);
      u.assign(static_cast<std::size_t>(of.contacts_.stride()), 0.0);
    }
    double start = 0.0, length = 0.0; ///< s
    int steps = 0;                    ///< of h
    ModalFlow::State from;
    kernels::Array load,
        load_end; ///< at both ends: the straight line that stands for the loads (LinearFlow::load_in_step)
    bool pushed = false; ///< contacts act in it, with the force
    ModalForce force;
    kernels::Array q, u; ///< in its middle
    ContactTrial trial;
    Energy energy; ///< at its end; of modes in blocks without damping and fluid
    BlockBalance blocks;
    void visit(core::StateArchive& state) {
      state(start, length, steps, from, load, load_end, pushed, force, q, u, trial, energy, blocks);
    }
  };
  [[nodiscard]] static std::size_t next(std::size_t step) { return step == 2 ? 0 : step + 1; }

  CoupledContacts make_coupled(const Scene& scene, const SplittingOptions& options) {
    ContactBlocks blocks(scene);
    auto responses = step_response(scene, blocks, contacts_.components, modes_, h_);
    return {contacts_, std::move(blocks), std::move(responses), h_, options.parts};
  }

  [[nodiscard]] std::optional<PackedContacts> inputs_of(const Scene& scene) const {
    if (!modes_.has_blocks())
      return std::nullopt;
    return std::optional<PackedContacts>(std::in_place, modes_.inputs(scene.contacts),
                                         modes_.force_numbers());
  }

  void scale(double* modal, int power) const {
    for (std::size_t j = 0; j < std::min(mode_scales_.size(), mode_count_); ++j)
      modal[j] *= power > 0 ? mode_scales_[j] : 1.0 / mode_scales_[j];
  }

  /// Contacts that are pressed at the start have been so.
  void preload() {
    near_.clear();
    for (int c = 0; c < contacts_.count; ++c) {
      const contact::Location at = end_.locate(c);
      const double force =
          contact::normal_force(contacts_.supports[c].normal, -at.gap, end_.penetration_rate(c, at.axes()));
      if (at.gap < 0.0 && force > 0.0) {
        coupled_.preload(c, at, force);
        near_.push_back(c);
      }
    }
    forces_.assemble(coupled_, near_, nullptr);
  }

  /// Contacts that may be closed in a step of so many h whose end is `end_`.
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
    modes_.load_in_step(s.start, to.start, length == 1, s.load, s.load_end, load_bend_);
    const ModalFlow::Sums sums = forces_.any_held()
                                     ? modes_.push(s.from, s.load, s.load_end, forces_.held(), to.from)
                                     : modes_.move(length, s.from, s.load, s.load_end, to.from);
    obstacles_.place(to.start, to.from.q.data(), to.from.v.data(), imposed_[1], end_);
    return sums;
  }

  /// Makes the step that `made_` starts.
  void make() {
    Step &s = steps_[made_], &to = steps_[next(made_)];
    start_.u.swap(end_.u); // normals and marks stay with `end_`
    start_.w.swap(end_.w);
    std::swap(imposed_[0], imposed_[1]);
    ModalFlow::Sums sums;
    const bool far = std::none_of(was_near_.begin(), was_near_.end(), [](char near) { return near != 0; });
    std::size_t length = lengths_.size() - 1;
    if (far && wait_ == 0)
      length = 0;
    while (length + 1 < lengths_.size() && (s.start + lengths_[length] * h_ > duration_ ||
                                            !start_.moves_less(lengths_[length] * h_, longest_macro_step) ||
                                            start_.find_near(window_ * lengths_[length] * h_)))
      ++length;
    wait_ = std::max(0, wait_ - 1);
    for (;; length = lengths_.size() - 1, wait_ = steps_after_meeting) {
      sums = predict(s, lengths_[length], to);
      find_near(lengths_[length]);
      if (near_.empty() || length + 1 == lengths_.size())
        break;
    }
    ContactLosses losses;
    double brought = 0.0;
    s.pushed = !near_.empty();
    if (s.pushed) {
      ++counts_.evaluations;
      find_bow(s);
      coupled_.make({start_, end_, bow_}, near_, s.trial, losses);
      s.pushed = forces_.any_held() || !s.trial.active.empty();
      if (s.pushed)
        sums = push(s, to, losses);
      counts_.unconverged += coupled_.converged() ? 0 : 1;
      coupled_.finish_step(end_, losses);
      brought = work_of_obstacles(s);
    } else {
      coupled_.pass(s.steps, s.trial, losses);
    }
    for (int c = 0; c < contacts_.count; ++c)
      was_near_[c] = end_.near(c);
    for (const int c : near_)
      was_near_[c] = was_near_[c] || sum_of_sizes(coupled_.force(c).held) > 0.0;
    prepare_output(s);
    modes_.add_works(s.steps, s.from, s.load, s.load_end, s.pushed ? &s.force : nullptr, sums, blocks_.works);
    balance_energy(s, to.from, sums, losses, brought);
    done_ += s.steps;
  }

  /// Of contacts over the step predicted, one of h (StepMotion).
  void find_bow(const Step& s) {
    assert(s.steps == 1);
    if (!has_bow_)
      return;
    if (modes_.has_bow())
      modes_.bow(s.from, s.load, s.load_end, forces_.any_held() ? forces_.held() : none_, modal_bow_);
    else
      std::fill(modal_bow_.begin(), modal_bow_.end(), 0.0);
    if (modes_.loads_bend())
      modes_.add_bow_of_bend(load_bend_, modal_bow_);
    kernels::gather(contacts_.gather, modal_bow_.data(), bow_.data());
    if (!imposed_[1].u.empty())
      add_bow_of_obstacles(s);
  }

  /// As if they moved by quartics: loads that stand for the motion of a base move the modes as it moves the obstacles.
  void add_bow_of_obstacles(const Step& s) {
    constexpr double mean_by_middle = 8.0 / 15.0; // of t^2 (h - t)^2
    obstacles_.at(s.start + 0.5 * h_, imposed_in_middle_);
    for (std::size_t lane = 0; lane < bow_.size(); ++lane) {
      const double cubic = 0.5 * (imposed_[0].u[lane] + imposed_[1].u[lane]) +
                           0.125 * h_ * (imposed_[0].w[lane] - imposed_[1].w[lane]);
      bow_[lane] += mean_by_middle * (imposed_in_middle_.u[lane] - cubic);
    }
  }

  /// The modes take the forces of the contacts, found again with those that these push into their obstacles.
  ModalFlow::Sums push(Step& s, Step& to, ContactLosses& losses) {
    std::copy(end_.u.begin(), end_.u.end(), predicted_.u.begin());
    std::copy(end_.w.begin(), end_.w.end(), predicted_.w.begin());
    for (;;) {
      forces_.assemble(coupled_, near_, &s.force);
      if (forces_.any_bend())
        modes_.add_bends(forces_.bends(), s.force);
      const ModalFlow::Sums sums =
          modes_.push(s.from, s.load, s.load_end, s.force.mean, s.force.slope, to.from);
      end_.gather(to.from.q.data(), to.from.v.data());
      imposed_[1].add_to(end_);
      if (!find_pushed_in())
        return sums;
      ++counts_.evaluations;
      coupled_.make_again({start_, predicted_, bow_}, near_, pushed_in_, s.trial, losses);
    }
  }

  /// Contacts that stayed open under the forces held, and are in their obstacles under those found. Marks those near the end of the step.
  bool find_pushed_in() {
    pushed_in_.clear();
    if (!end_.find_near(window_ * h_))
      return false;
    for (int c = 0; c < contacts_.count; ++c)
      if (end_.near(c) && end_.gaps[c] < 0.0 && !coupled_.moved(c)) {
        pushed_in_.push_back(c);
        if (const auto at = std::lower_bound(near_.begin(), near_.end(), c); at == near_.end() || *at != c)
          near_.insert(at, c);
      }
    return !pushed_in_.empty();
  }

  /// By obstacles that move, on the structure, J.
  [[nodiscard]] double work_of_obstacles(const Step& s) const {
    double work = 0.0;
    if (imposed_[0].u.empty() || !s.pushed)
      return work;
    const auto moved = [&](int lane) { return imposed_[1].u[lane] - imposed_[0].u[lane]; };
    for (const int c : near_) {
      const Components& mean = coupled_.force(c).mean;
      work -= mean.y() * moved(c) + mean.z() * moved(contacts_.width + c);
      if (contacts_.components == 3)
        work -= mean.x * moved(2 * contacts_.width + c);
    }
    return work;
  }

  void prepare_output(Step& s) {
    modes_.middle(s.steps, s.from, s.load, s.load_end, s.pushed ? &s.force : nullptr, s.q);
    // contacts: by the cubic through both ends, by the quartic where some are near, and by their own path where they may be closed
    const double eighth = 0.125 * s.length;
    for (std::size_t lane = 0; lane < s.u.size(); ++lane)
      s.u[lane] = 0.5 * (start_.u[lane] + end_.u[lane]) + eighth * (start_.w[lane] - end_.w[lane]);
    if (!near_.empty() && has_bow_)
      for (std::size_t lane = 0; lane < s.u.size(); ++lane)
        s.u[lane] += middle_of_bow * bow_[lane];
    coupled_.place_in_middle(s.u.data());
    if (s.pushed && forces_.any_bend())
      modes_.add_bend_in_middle(forces_.bends()[0], s.q);
    if (s.steps == 1 && modes_.loads_bend())
      modes_.add_bend_in_middle(load_bend_, s.q);
    for (std::size_t i = 0; i < mode_scales_.size(); ++i)
      s.q[i] *= mode_scales_[i];
  }

  void balance_energy(Step& s, const ModalFlow::State& end, const ModalFlow::Sums& sums,
                      const ContactLosses& losses, double brought) {
    energy_.load_work += sums.load_work + brought;
    energy_.scale += std::abs(sums.load_work) + std::abs(brought);
    energy_.fluid_work += sums.fluid_work;
    energy_.scale += std::abs(sums.fluid_work);
    energy_.modal_damping += sums.load_work + sums.contact_work + sums.fluid_work - (sums.energy - moving_);
    energy_.contact_damping += losses.damping;
    energy_.friction += losses.friction;
    moving_ = sums.energy;
    energy_.stored = moving_ + coupled_.spring_energy();
    if (modes_.has_blocks()) {
      energy_.scale += blocks_.add_to_scale(modes_, end);
      s.blocks = blocks_;
    }
    s.energy = energy_;
  }

  double h_, duration_;
  std::vector<int> lengths_;
  LinearFlow modes_;
  std::size_t mode_count_;
  PackedContacts contacts_;              ///< rows over coordinates
  std::optional<PackedContacts> inputs_; ///< over the numbers of a force, where these are others
  ContactMotion start_, end_;            ///< of the step that is made
  ContactMotion predicted_;              ///< its end under the forces held
  ObstacleMotion obstacles_;
  std::array<ImposedMotion, 2> imposed_; ///< likewise
  ImposedMotion imposed_in_middle_;
  StepForces forces_;
  bool has_bow_; ///< whether modes or obstacles move otherwise than by cubics in time
  CoupledContacts coupled_;
  std::array<Step, 3> steps_; ///< the one published, the one made, and where that ends
  std::size_t published_ = 0, made_ = 0;

  std::vector<char> was_near_; ///< at the end of the last step
  std::vector<int> near_;
  std::vector<int> pushed_in_; ///< open contacts that the forces of others take into their obstacles
  double window_;
  kernels::Array mode_scales_;            ///< with scaled masses
  kernels::Array output_q_;               ///< modes of the record, with blocks
  kernels::Array modal_bow_, bow_, none_; ///< over coordinates; lanes; a force of 0
  kernels::Array
      load_bend_; ///< N, of the loads in the step that is made, where it is one of h (LinearFlow::load_in_step)

  std::int64_t done_ = 0; ///< steps of h up to the one that is made
  int wait_ = 0;          ///< steps until macro-steps are tried again
  double moving_ = 0.0;   ///< J, of the modes at the end of the last step
  Energy energy_;
  BlockBalance blocks_;
  Record record_;
  StepCounts counts_;
};

} // namespace

std::unique_ptr<Replayable> make_replayable_splitting(const Scene& scene, double step,
                                                      const SplittingOptions& options) {
  const Eigen::VectorXd masses = scaled_masses(scene, options.fastest);
  if ((masses.array() == 1.0).all())
    return std::make_unique<Splitting>(scene, step, Eigen::VectorXd(), options);
  return std::make_unique<Splitting>(with_masses(scene, masses), step, masses.cwiseSqrt().cwiseInverse(),
                                     options);
}

std::unique_ptr<Scheme> make_splitting(const Scene& scene, double step, const SplittingOptions& options) {
  return make_replayable_splitting(scene, step, options);
}

} // namespace fretwork::transient
