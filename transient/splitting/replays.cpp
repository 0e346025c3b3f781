// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/replays.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {
namespace {

using Figures = StepError::Figures;

/// Of an error, in what half the interval takes away of it: order 1.
constexpr double whole_error = 2.0;
/// Times between replays over their length: the first, by how much it grows from one to the next, and the last.
constexpr double first_pause = 6.0, growth = 1.1, longest_pause = 40.0;
/// Varies the pauses, so that no period of the loads is met again and again at one phase.
constexpr double golden = 0.6180339887498949;
/// Of the accuracy: an error that takes finer intervals (of order 2 it is half of the accuracy), by how many standard errors it is to exceed that, and by how many to stand out.
/// Six figures of each contact are looked at after each replay, and one contact divides the step of all that it moves: where only the error itself has to be above
/// the share, chance refines ten contacts of half of the accuracy in most runs. Three standard errors take 10 replays at least.
constexpr double tolerated = 0.75, exceeds_by = 2.0, significance = 3.0;

/// Sums over replays, each with its weight.
struct Evidence {
  Figures sums{}, differences{}, squares{};
  double weights = 0.0, count = 0.0; ///< squares of the weights; replays
  void add(const Figures& run, const Figures& replay, double weight) {
    weights += weight * weight;
    count += 1.0;
    for (std::size_t k = 0; k < replayed_figures; ++k) {
      const double d = weight * (run[k] - replay[k]);
      sums[k] += weight * run[k];
      differences[k] += d;
      squares[k] += d * d;
    }
  }
  [[nodiscard]] double error(std::size_t k) const { return whole_error * differences[k]; }
  /// Impacts are counted: that no replay differs by one does not say that the next would not.
  [[nodiscard]] double spread(std::size_t k) const {
    const double one_more = k == replayed_impacts && count > 0.0 ? weights / count : 0.0;
    return whole_error * std::sqrt(squares[k] + one_more);
  }
};

/// Adds what the contacts do in a record.
void add(std::vector<Figures>& sums, const Record& record) {
  for (const int c : record.active) {
    const ContactState& s = record.states[static_cast<std::size_t>(c)];
    Figures one;
    one[replayed_work] = s.wear_work;
    one[replayed_friction] = s.friction_work;
    one[replayed_square] = record.step * s.normal_square;
    one[replayed_impulse] = record.step * s.normal_force;
    one[replayed_closed_time] = record.step * s.closed;
    one[replayed_impacts] = s.touches;
    for (std::size_t k = 0; k < replayed_figures; ++k)
      sums[static_cast<std::size_t>(c)][k] += one[k];
  }
}

class Replays final : public Scheme {
public:
  Replays(std::unique_ptr<Replayable> running, std::unique_ptr<Replayable> finer,
          const ReplayOptions& options)
      : running_(std::move(running)), finer_(std::move(finer)), options_(options),
        next_(first_pause * options.length), pause_(first_pause) {
    const auto count = static_cast<std::size_t>(options.contacts);
    of_run_.resize(count);
    of_replay_.resize(count);
    whole_.resize(count);
    recent_.resize(count);
    parts_.assign(count, options.parts);
  }

  const Record& advance() override {
    const Record& record = running_->advance();
    const double half = 0.5 * record.step, tolerance = 1e-6 * options_.length;
    if (replaying_ && record.time - half > from_ - tolerance) {
      add(of_run_, record);
      if (const double end = record.time + half; end > from_ + options_.length - tolerance)
        replay(end - tolerance);
    } else if (!replaying_ && record.time > next_) {
      std::fill(of_run_.begin(), of_run_.end(), Figures{});
      from_ = finer_->continue_from(*running_);
      replaying_ = true;
    }
    return record;
  }

  void complete(const RecordParts& parts) override { running_->complete(parts); }
  [[nodiscard]] double next_time() const override { return running_->next_time(); }
  void state_at(double time, double* q, double* v) override { running_->state_at(time, q, v); }
  bool forces_at(double time, std::span<ContactForce> forces) override {
    return running_->forces_at(time, forces);
  }
  void load_at(double time, double* force) override { running_->load_at(time, force); }
  [[nodiscard]] StepCounts counts() const override { return running_->counts(); }
  [[nodiscard]] StepFailure failure() const override { return running_->failure(); }
  [[nodiscard]] std::vector<StepError> step_errors() const override {
    std::vector<StepError> out(whole_.size());
    for (std::size_t c = 0; c < out.size(); ++c) {
      const Evidence& e = whole_[c];
      out[c].sums = e.sums;
      out[c].parts = parts_[c];
      for (std::size_t k = 0; k < replayed_figures; ++k) {
        out[c].errors[k] = e.error(k);
        out[c].spreads[k] = e.spread(k);
      }
    }
    return out;
  }
  void visit(core::StateArchive& state) override {
    state(*running_, *finer_, of_run_, whole_, recent_, recent_sum_, parts_, replaying_, from_, last_, next_,
          pause_, count_);
  }

private:
  /// The replay of what has run since `from_`, up to `end`.
  void replay(double end) {
    std::fill(of_replay_.begin(), of_replay_.end(), Figures{});
    for (double now = from_; now < end;) {
      const Record& record = finer_->advance();
      add(of_replay_, record);
      now = record.time + 0.5 * record.step;
    }
    const double weight = (end - last_) / options_.length; // it stands for the time since the last one
    Figures run{}, replayed{};
    bool refined = false;
    for (std::size_t c = 0; c < whole_.size(); ++c)
      if (of_run_[c][replayed_impulse] > 0.0 || of_replay_[c][replayed_impulse] > 0.0) {
        whole_[c].add(of_run_[c], of_replay_[c], weight);
        recent_[c].add(of_run_[c], of_replay_[c], 1.0);
        for (std::size_t k = 0; k < replayed_figures; ++k) {
          run[k] += of_run_[c][k];
          replayed[k] += of_replay_[c][k];
        }
        refined = (is_coarse(recent_[c]) && refine(c)) || refined;
      }
    recent_sum_.add(run, replayed, 1.0);
    if (!refined && is_coarse(recent_sum_))
      refined = refine_all();
    if (refined)
      recent_sum_ = {};
    last_ = end;
    ++count_;
    const double place = golden * static_cast<double>(count_);
    next_ = end + (0.5 + place - std::floor(place)) * pause_ * options_.length;
    pause_ = std::min(growth * pause_, longest_pause);
    replaying_ = false;
  }

  [[nodiscard]] bool is_coarse(const Evidence& e) const {
    for (std::size_t k = 0; k < replayed_figures; ++k)
      if (const double error = std::abs(e.error(k)); statistic_share(k) * (error - exceeds_by * e.spread(k)) >
                                                         tolerated * options_.accuracy * e.sums[k] &&
                                                     error > significance * e.spread(k))
        return true;
    return false;
  }

  /// All contacts. Returns whether any had finer intervals.
  bool refine_all() {
    bool refined = false;
    for (std::size_t c = 0; c < whole_.size(); ++c)
      refined = refine(c) || refined;
    return refined;
  }

  /// Returns whether there were finer intervals.
  bool refine(std::size_t c) {
    if (parts_[c] >= options_.most_parts)
      return false;
    parts_[c] = std::min(2 * parts_[c], options_.most_parts);
    running_->divide(static_cast<int>(c), parts_[c]);
    finer_->divide(static_cast<int>(c), parts_[c]);
    recent_[c] = {};
    return true;
  }

  std::unique_ptr<Replayable> running_, finer_;
  ReplayOptions options_;
  std::vector<Figures> of_run_, of_replay_; ///< by contact, of the replay that goes on
  std::vector<Evidence> whole_, recent_;    ///< of the run; since the contact was refined
  Evidence recent_sum_;                     ///< of the sums over contacts, since any was refined
  std::vector<int> parts_;
  bool replaying_ = false;
  double from_ = 0.0, last_ = 0.0,
         next_;  ///< s: start of the replay that goes on, end of the last, start of the next
  double pause_; ///< over their length
  std::int64_t count_ = 0;
};

} // namespace

std::unique_ptr<Scheme> make_replayed(std::unique_ptr<Replayable> running, std::unique_ptr<Replayable> finer,
                                      const ReplayOptions& options) {
  return std::make_unique<Replays>(std::move(running), std::move(finer), options);
}

} // namespace fretwork::transient
