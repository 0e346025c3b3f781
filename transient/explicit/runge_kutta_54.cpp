// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The pair of Dormand and Prince (dormand_prince.hpp) on the plain rates of the motion (motion_rates.hpp): adaptive, explicit, with steps
/// that end where a contact closes, opens, starts to slide or sticks (contact_events.hpp). Order 5 between events. It is the oracle:
/// six evaluations of the contacts a step and six for its records, all modes resolved. Steps also end at the points of tables, where loads bend and jump: no step
/// passes over a pulse, and between points the tolerance is met as that of a smooth load, from rest too.
///
/// Error of a step, e the estimate: ||e|| <= tolerance sqrt(2 E), with the energy of the error in modes, springs of friction and springs of
/// closed contacts,  ||e||^2 = sum (e_v^2 + k e_q^2) + sum |e_T|^2/K_T + sum K_N |e_u|^2,  and E the largest of kinetic, strain and friction
/// spring energy so far: a floor that all modes share, so that one that does not move never drives the step.
/// Next step: PI controller h <- h min(10, max(1/5, 0.9 err^-0.17 last^0.04)) (K. Gustafsson, ACM TOMS 17 (1991) 533; exponents of E. Hairer's
/// dopri5), never longer than `longest`. A step that cannot meet the tolerance even where time + h comes near to the round-off of time is a
/// failure, and the last record the end.
///
/// At an event the step is made again up to it, the regime changes, and integration starts afresh. Events at one instant are applied one by
/// one. Where they come more often than each contact can need (a contact that chatters between two branches), one step is made with
/// the laws themselves instead of their branches, under the same error control.
/// Records. The forces between the ends of a step are those of the laws on the step's branches, at the states of the continuous extension.
/// Five records of a step stand for parts of it, at the nodes s with the weights b of an integral over s = 0 .. 1:
///     s = 1/20, 0.1832, 1/2, 0.8168, 19/20     b = 1/10, 0.2134, 0.3732, 0.2134, 1/10
/// exact for polynomials of degree 5, so that means over time are of the order of the scheme. The first and the last part lie about their
/// nodes: what is seen of closed contacts begins and ends with the steps. A sixth record at the end of the step stands for no time; there
/// contacts close and open.
/// C_T = 0 and `reference` set the spring of a sliding contact once a step, which the error estimate does not see; `reference`, whose bounds
/// depend on that, slides and sticks by its law, unlocated.
#include "transient/explicit/contact_events.hpp"
#include "transient/explicit/end_record.hpp"
#include "transient/explicit/explicit_schemes.hpp"
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace fretwork::transient {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double first_share = 1e-3; ///< of the longest step: the controller finds the step from there
constexpr double safety = 0.9, most_growth = 10.0, most_shrinking = 0.2;
constexpr double proportional = 0.17, integral = 0.04;
constexpr double least_memory = 1e-4; ///< of the error before: keeps the controller calm after a lucky step
constexpr double finest =
    16.0 * std::numeric_limits<double>::epsilon(); ///< step over duration: below it time + h is round-off
constexpr double crowding = 1e-3;                  ///< an event within this share of the step crowds

/// A record inside a step, in shares of it.
struct Part {
  double node, weight, end;
};
constexpr int parts = 5;
constexpr double edge = 0.05, second = 0.18320365819822299, second_weight = 0.21339859778359342;
constexpr Part part[parts] = {{edge, 2.0 * edge, 2.0 * edge},
                              {second, second_weight, 2.0 * edge + second_weight},
                              {0.5, 1.0 - 4.0 * edge - 2.0 * second_weight, 1.0 - 2.0 * edge - second_weight},
                              {1.0 - second, second_weight, 1.0 - 2.0 * edge},
                              {1.0 - edge, 2.0 * edge, 1.0}};

/// Where tables have points within the run, and the end of the run, s, increasing.
std::vector<double> stops_of(const Scene& scene) {
  std::vector<double> stops;
  const auto add = [&](const signals::TimeFunction& function) {
    if (const auto* table = std::get_if<signals::Table>(&function))
      std::copy_if(table->time.begin(), table->time.end(), std::back_inserter(stops),
                   [&](double t) { return t > 0.0 && t < scene.duration; });
  };
  for (const vibration::Load& load : scene.loads)
    if (!load.modal_force.isZero(0.0))
      add(load.function);
  for (const signals::PrescribedMotion& motion : scene.motions)
    add(motion.acceleration);
  stops.push_back(scene.duration);
  std::sort(stops.begin(), stops.end());
  stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
  return stops;
}

class RungeKutta54 final : public Scheme {
public:
  RungeKutta54(const Scene& scene, double tolerance, double longest)
      : n_(scene.system.size()), duration_(scene.duration), tolerance_(tolerance), longest_(longest),
        stops_(stops_of(scene)), next_h_(first_share * longest), rates_(scene, 0.0), record_(rates_),
        step_(rates_.size()), inside_(static_cast<std::size_t>(rates_.size()), 0.0), until_(inside_),
        unused_(inside_), events_(rates_), most_events_(8 + 4 * rates_.contacts().count) {
    rates_.start(step_.start());
    rates_.locate_regimes(true);
    aim();
    evaluate_start();
    record_.prepare(rates_, step_.start(), 0.0);
    step_.extend(0.0);
    largest_ = rates_.moving_energy(step_.start());
  }

  const Record& advance() override {
    if (at_ < parts)
      show_part(part[at_++]);
    else
      pass_end();
    return record_.record();
  }

  [[nodiscard]] double next_time() const override {
    if (failure_ != StepFailure::none)
      return infinite;
    return at_ < parts ? time_ + part[at_].node * h_ : end_time();
  }

  void state_at(double time, double* q, double* v) override {
    step_.inside(share_at(time), inside_);
    std::copy_n(inside_.data(), n_, q);
    std::copy_n(inside_.data() + rates_.modes(), n_, v);
  }

  bool forces_at(double time, std::span<ContactForce> forces) override {
    step_.inside(share_at(time), inside_);
    rates_.rate(time, inside_.data(), unused_.data());
    std::ranges::fill(forces, ContactForce{});
    for (const int c : rates_.trial().active) {
      const auto i = static_cast<std::size_t>(c);
      const ContactState& s = rates_.trial().states[i];
      if (s.normal_force > 0.0)
        forces[i] = {s.normal_force, s.friction, s.axes, s.slides};
    }
    return true;
  }

  void load_at(double time, double* force) override {
    rates_.load_at(time, force);
    rates_.add_motion_forces(inside_.data(), force);
  }
  [[nodiscard]] StepCounts counts() const override { return counts_; }
  [[nodiscard]] StepFailure failure() const override { return failure_; }

  void visit(core::StateArchive& state) override {
    state(time_, h_, next_h_, last_error_, largest_, rates_, record_, step_, crowded_, counts_, failure_);
    state(at_, located_, event_);
    aim();
  }

private:
  /// At the next stop, up to which loads are smooth.
  void aim() {
    stop_ = *std::upper_bound(stops_.begin(), stops_.end() - 1, time_);
    rates_.take_loads_before(stop_);
  }
  void evaluate_start() {
    rates_.rate(time_, step_.start(), step_.start_rate());
    count_evaluations(1);
  }
  void count_evaluations(int n) { counts_.evaluations += rates_.contacts().count > 0 ? n : 0; }

  /// Error over what the tolerance allows.
  double error(double h) {
    const double scale = std::max(largest_, rates_.moving_energy(step_.end()));
    const double size = rates_.norm2(step_.error(h));
    return size == 0.0 ? 0.0 : std::sqrt(size / (2.0 * scale)) / tolerance_;
  }

  [[nodiscard]] double share_at(double time) const { return h_ > 0.0 ? (time - time_) / h_ : 0.0; }
  [[nodiscard]] double end_time() const { return h_ == stop_ - time_ ? stop_ : time_ + h_; }

  void show_part(const Part& p) {
    const double time = time_ + p.node * h_;
    step_.inside(p.node, inside_);
    step_.inside(p.end, until_);
    rates_.rate(time, inside_.data(), unused_.data());
    count_evaluations(1);
    record_.prepare_part(rates_, inside_.data(), time, p.weight * h_, until_.data());
    record_.publish();
    record_.stand_for(p.weight * h_);
  }

  /// The record at the end of the step, and the step that follows.
  void pass_end() {
    if (h_ > 0.0)
      accept();
    record_.publish();
    record_.stand_for(0.0);
    h_ = 0.0;
    if (time_ < duration_)
      make_step();
    else
      step_.extend(0.0);
    at_ = h_ > 0.0 ? 0 : parts;
  }

  /// From time_ on.
  void make_step() {
    located_ = crowded_ <= most_events_;
    if (!located_)
      use_laws(true);
    bool rejected = false;
    for (int at_once = 0;;) {
      const double h = limited(next_h_);
      if (!(next_h_ >= finest * duration_)) {
        failure_ = StepFailure::tolerance;
        step_.extend(0.0);
        return;
      }
      try_step(h);
      const double err = error(h);
      if (!(err <= 1.0)) {
        ++counts_.rejected;
        rejected = true;
        next_h_ =
            h * (err < infinite ? std::max(most_shrinking, safety * std::pow(err, -0.2)) : most_shrinking);
        continue;
      }
      step_.extend(h);
      event_ = located_ ? events_.first(step_, time_, h) : std::nullopt;
      if (event_ && event_->share * h < finest * duration_) {
        evaluate_start();
        ContactEvents::apply(*event_, rates_, step_.start());
        located_ = ++at_once <= most_events_;
        if (!located_)
          use_laws(true);
        evaluate_start();
        continue;
      }
      control(h, err, rejected);
      const bool cut = event_ && event_->share < 1.0;
      h_ = cut ? event_->share * h : h;
      if (cut) {
        try_step(h_);
        step_.extend(h_);
      }
      crowded_ = event_ && located_ ? crowded_ + (event_->share < crowding) : 0;
      counts_.add(h_);
      return;
    }
  }

  void try_step(double h) {
    step_.make(rates_, time_, h);
    count_evaluations(DormandPrince::evaluations);
  }

  void use_laws(bool laws) {
    rates_.locate_regimes(!laws);
    evaluate_start();
  }

  /// Steps end at stops: one that would leave a crumb takes it along, or shares it.
  [[nodiscard]] double limited(double h) const {
    const double rest = stop_ - time_;
    h = std::min(h, longest_);
    return h >= rest ? rest : 2.0 * h > rest ? 0.5 * rest : h;
  }

  void control(double h, double err, bool rejected) {
    const double factor =
        safety * std::pow(std::max(err, 1e-12), -proportional) * std::pow(last_error_, integral);
    const double found = h * std::clamp(factor, most_shrinking, rejected ? 1.0 : most_growth),
                 wish = std::min(next_h_, longest_);
    next_h_ = h < wish ? std::max(found, wish) : found; // a stop tells nothing about the steps after it
    last_error_ = std::max(err, least_memory);
  }

  /// Ends the step that has been made.
  void accept() {
    const bool stops = end_time() == stop_;
    rates_.rate(time_ + h_, step_.end(), unused_.data()); // after the parts
    count_evaluations(1);
    time_ = end_time();
    rates_.commit(step_.end());
    if (event_)
      ContactEvents::apply(*event_, rates_, step_.end());
    rates_.locate_regimes(true);
    record_.prepare_part(rates_, step_.end(), time_, 0.0, step_.end());
    largest_ = std::max(largest_, rates_.moving_energy(step_.end()));
    step_.advance();
    aim();
    if (stops || event_ || !located_ || rates_.sets_springs())
      evaluate_start();
  }

  Eigen::Index n_;
  double duration_, tolerance_, longest_;
  std::vector<double> stops_;
  double stop_ = 0.0;                    ///< s: the first after time_
  double time_ = 0.0, h_ = 0.0, next_h_; ///< the step made last runs over h_ from time_ on
  double last_error_ = least_memory, largest_ = 0.0;
  MotionRates rates_;
  EndRecord record_;
  DormandPrince step_;
  kernels::Array inside_, until_, unused_; ///< states inside the step, rates that nobody asks for
  int at_ = parts;                         ///< of the next record: a part, or the end of the step
  bool located_ = true;                    ///< the step keeps the branches of its contacts
  std::optional<ContactEvent> event_;      ///< at the end of the step
  ContactEvents events_;
  int most_events_, crowded_ = 0;
  StepCounts counts_;
  StepFailure failure_ = StepFailure::none;
};

} // namespace

std::unique_ptr<Scheme> make_runge_kutta_54(const Scene& scene, double tolerance, double longest) {
  return std::make_unique<RungeKutta54>(scene, tolerance, longest);
}

} // namespace fretwork::transient
