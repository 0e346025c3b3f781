// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The pair of Dormand and Prince (dormand_prince.hpp) on the plain rates of the motion (motion_rates.hpp): adaptive, explicit, with steps
/// that end where a contact closes, opens, starts to slide or sticks (contact_events.hpp). Order 5 between events. It is the oracle:
/// six evaluations of the contacts a step, all modes resolved. Steps also end at the points of tables, where loads bend and jump: no step
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
/// C_T = 0 and `reference` set the spring of a sliding contact once a step, which the error estimate does not see; `reference`, whose bounds
/// depend on that, slides and sticks by its law, unlocated.
#include "transient/contact_events.hpp"
#include "transient/end_record.hpp"
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

/// Where tables have points within the run, and the end of the run, s, increasing.
std::vector<double> stops_of(const Scene& scene) {
  std::vector<double> stops;
  const auto add = [&](const TimeFunction& function) {
    if (const auto* table = std::get_if<Table>(&function))
      std::copy_if(table->time.begin(), table->time.end(), std::back_inserter(stops),
                   [&](double t) { return t > 0.0 && t < scene.duration; });
  };
  for (const Load& load : scene.loads)
    if (!load.modal_force.isZero(0.0))
      add(load.function);
  for (const PrescribedMotion& motion : scene.motions)
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
        step_(rates_.size()), events_(rates_), most_events_(8 + 4 * rates_.contacts().count) {
    rates_.start(step_.start());
    rates_.locate_regimes(true);
    aim();
    evaluate_start();
    record_.prepare(rates_, step_.start(), 0.0);
    step_.extend(0.0);
    largest_ = rates_.moving_energy(step_.start());
  }

  const Record& advance() override {
    record_.publish();
    const double before = h_;
    h_ = 0.0;
    begin_ = time_;
    if (time_ < duration_)
      make_step();
    else
      step_.extend(0.0);
    record_.stand_for(0.5 * (before + h_));
    return record_.record();
  }

  [[nodiscard]] double next_time() const override { return failure_ == StepFailure::none ? time_ : infinite; }

  void state_at(double time, double* q, double* v) override {
    const auto factors = DormandPrince::factors(h_ > 0.0 ? (time - begin_) / h_ : 0.0);
    std::fill_n(q, n_, 0.0);
    std::fill_n(v, n_, 0.0);
    for (int j = 0; j < DormandPrince::terms; ++j)
      for (Eigen::Index i = 0; i < n_; ++i) {
        q[i] += factors[static_cast<std::size_t>(j)] * step_.term(j)[i];
        v[i] += factors[static_cast<std::size_t>(j)] * step_.term(j)[rates_.modes() + i];
      }
  }

  void load_at(double time, double* force) override { rates_.load_at(time, force); }
  [[nodiscard]] StepCounts counts() const override { return counts_; }
  [[nodiscard]] StepFailure failure() const override { return failure_; }

  void visit(core::StateArchive& state) override {
    state(time_, begin_, h_, next_h_, last_error_, largest_, rates_, record_, step_, crowded_, counts_,
          failure_);
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

  /// From time_ to the next record.
  void make_step() {
    bool located = crowded_ <= most_events_;
    if (!located)
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
      const auto event = located ? events_.first(step_, time_, h) : std::nullopt;
      if (event && event->share * h < finest * duration_) {
        evaluate_start();
        ContactEvents::apply(*event, rates_, step_.start());
        located = ++at_once <= most_events_;
        if (!located)
          use_laws(true);
        evaluate_start();
        continue;
      }
      control(h, err, rejected);
      const bool cut = event && event->share < 1.0;
      if (cut) {
        try_step(event->share * h);
        step_.extend(event->share * h);
      }
      crowded_ = event && located ? crowded_ + (event->share < crowding) : 0;
      return accept(cut ? event->share * h : h, event, located);
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

  void accept(double h, const std::optional<ContactEvent>& event, bool located) {
    h_ = h;
    const bool stops = h == stop_ - time_;
    time_ = stops ? stop_ : time_ + h;
    rates_.commit(step_.end());
    if (event)
      ContactEvents::apply(*event, rates_, step_.end());
    rates_.locate_regimes(true);
    record_.prepare(rates_, step_.end(), time_);
    largest_ = std::max(largest_, rates_.moving_energy(step_.end()));
    step_.advance();
    aim();
    if (stops || event || !located || rates_.sets_springs())
      evaluate_start();
    counts_.step_min = counts_.steps == 0 ? h : std::min(counts_.step_min, h);
    counts_.step_max = std::max(counts_.step_max, h);
    ++counts_.steps;
  }

  Eigen::Index n_;
  double duration_, tolerance_, longest_;
  std::vector<double> stops_;
  double stop_ = 0.0; ///< s: the first after time_
  double time_ = 0.0, begin_ = 0.0, h_ = 0.0,
         next_h_; ///< the step made last runs over h_ from begin_ to time_
  double last_error_ = least_memory, largest_ = 0.0;
  MotionRates rates_;
  EndRecord record_;
  DormandPrince step_;
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
