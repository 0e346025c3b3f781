// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/modes/linear_flow.hpp"
#include "transient/modes/moving_modes.hpp"
#include <algorithm>

namespace fretwork::transient {
namespace {

using Eigen::Index;

vibration::DiagonalFlow blocks_of(const Scene& scene, double step, const std::vector<int>& lengths) {
  if (scene.system.motion.empty())
    return {};
  const vibration::System system = vibration::with_diagonal(scene.system);
  std::vector<vibration::CoupledBlock> blocks = vibration::coupled_blocks(system);
  std::erase_if(blocks,
                [&](const vibration::CoupledBlock& block) { return vibration::acts_alone(system, block); });
  return {system, blocks, step, lengths};
}

std::vector<Index> other_modes(const vibration::DiagonalFlow& blocks, Index modes) {
  std::vector<char> taken(static_cast<std::size_t>(modes), 0);
  for (std::size_t b = 0; b < blocks.blocks(); ++b)
    for (const Index mode : blocks.modes(b))
      taken[static_cast<std::size_t>(mode)] = 1;
  std::vector<Index> out;
  for (Index mode = 0; mode < modes; ++mode)
    if (!taken[static_cast<std::size_t>(mode)])
      out.push_back(mode);
  return out;
}

/// The scene of the modes of no block.
Scene uncoupled_part(const Scene& scene, const vibration::DiagonalFlow& blocks,
                     const std::vector<Index>& modes) {
  if (blocks.empty())
    return scene;
  Scene out = with_modes(scene, modes);
  if (vibration::coupled_blocks(out.system).empty())
    out.system.motion = {};
  return out;
}

} // namespace

LinearFlow::LinearFlow(const Scene& scene, double step, const std::vector<int>& lengths)
    : blocks_(blocks_of(scene, step, lengths)), uncoupled_modes_(other_modes(blocks_, scene.system.size())),
      uncoupled_(uncoupled_part(scene, blocks_, uncoupled_modes_), step, lengths),
      modes_(scene.system.size()), lengths_(lengths), squares_(uncoupled_.squares_of_followed()) {
  none_.assign(static_cast<std::size_t>(force_numbers()), 0.0);
  for_bends_.fill({none_, none_});
  uncoupled_.linear_for_bends(for_bends_);
  if (blocks_.empty())
    return;
  blocks_.linear_for_bends(for_bends_, static_cast<std::size_t>(uncoupled_.padded()));
  loads_.emplace(scene, step);
  const auto numbers = static_cast<Index>(kernels::numbers_of_input * blocks_.size());
  driven_.emplace(loads_on_blocks(scene.loads), numbers, scene.duration, step,
                  std::vector<signals::SampledLoad>(), vibration::LoadSum::Records::by_polygon);
  random_.emplace(std::vector<vibration::Load>(), modes_, scene.duration, step, scene.sampled_loads);
  a_ = b_ = none_;
  y_.assign(blocks_.size(), 0.0);
  q_.assign(static_cast<std::size_t>(kernels::padded(static_cast<int>(modes_))), 0.0);
  v_ = q_;
}

std::vector<vibration::Load> LinearFlow::loads_on_blocks(const std::vector<vibration::Load>& loads) const {
  std::vector<vibration::Load> out = loads;
  for (vibration::Load& load : out) {
    const Eigen::VectorXd modal = load.modal_force;
    load.modal_force.resize(static_cast<Index>(kernels::numbers_of_input * blocks_.size()));
    for (std::size_t b = 0; b < blocks_.blocks(); ++b)
      load.modal_force.segment(kernels::numbers_of_input * blocks_.range(b).first,
                               kernels::numbers_of_input * blocks_.range(b).size) =
          blocks_.inputs(b) * modal(blocks_.modes(b));
  }
  return out;
}

/// @param numbers  of a block for each of its y   @param rows  rows(block, b): those of b over its modes as rows over its numbers
template <class Rows>
std::vector<ContactPoint> LinearFlow::over_coordinates(const std::vector<ContactPoint>& contacts, int numbers,
                                                       const Rows& rows) const {
  if (blocks_.empty())
    return contacts;
  std::vector<ContactPoint> out = with_modes(contacts, uncoupled_modes_);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    ContactPoint& to = out[c];
    const Eigen::MatrixXd all = contacts[c].over_all(modes_);
    if (to.modes.empty())
      to.modes = {{0, to.b.cols()}};
    for (std::size_t b = 0; b < blocks_.blocks(); ++b) {
      const Eigen::MatrixXd of_block = all(Eigen::all, blocks_.modes(b));
      if (of_block.isZero(0.0))
        continue;
      const auto [first, size] = blocks_.range(b);
      to.modes.push_back({uncoupled_.padded() + numbers * first, numbers * size});
      to.b.conservativeResize(Eigen::NoChange, to.b.cols() + numbers * size);
      to.b.rightCols(numbers * size) = rows(b, of_block);
    }
  }
  return out;
}

std::vector<ContactPoint> LinearFlow::outputs(const std::vector<ContactPoint>& contacts) const {
  return over_coordinates(contacts, 1, [&](std::size_t block, const Eigen::MatrixXd& b) -> Eigen::MatrixXd {
    return b * blocks_.displacements(block);
  });
}

std::vector<ContactPoint> LinearFlow::inputs(const std::vector<ContactPoint>& contacts) const {
  return over_coordinates(contacts, kernels::numbers_of_input,
                          [&](std::size_t block, const Eigen::MatrixXd& b) -> Eigen::MatrixXd {
                            return b * blocks_.inputs(block).transpose();
                          });
}

std::size_t LinearFlow::place(int length) const {
  return static_cast<std::size_t>(std::find(lengths_.begin(), lengths_.end(), length) - lengths_.begin());
}

void LinearFlow::to_uncoupled(const double* modes, double* uncoupled) const {
  for (std::size_t i = 0; i < uncoupled_modes_.size(); ++i)
    uncoupled[i] = modes[uncoupled_modes_[i]];
}

void LinearFlow::to_modes(const double* uncoupled, double* modes) const {
  for (std::size_t i = 0; i < uncoupled_modes_.size(); ++i)
    modes[uncoupled_modes_[i]] = uncoupled[i];
}

LinearFlow::State LinearFlow::start(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  State out;
  out.q.assign(static_cast<std::size_t>(coordinates()), 0.0);
  out.v = out.q;
  uncoupled_.start(out);
  to_uncoupled(q.data(), out.q.data());
  to_uncoupled(v.data(), out.v.data());
  if (blocks_.empty())
    return out;
  blocks_.start(q.data(), v.data(), y_.data());
  start_ = {blocks_.energy(y_.data()), blocks_.fluid_form(y_.data())};
  blocks_.inside(0.0, y_.data(), inputs_of(none_, none_, none_, none_), part(out.q), part(out.v));
  return out;
}

void LinearFlow::load_in_step(double start, double end, bool one_step, kernels::Array& load0,
                              kernels::Array& load1, kernels::Array& bend) {
  const bool bends = one_step && loads_bend();
  uncoupled_.load_in_step(start, end, load0, load1, bends ? bend.data() : nullptr);
  if (has_blocks())
    load_blocks(start, end, load0, load1, bends ? &bend : nullptr);
  if (bends)
    for (std::size_t i = 0; i < bend.size(); ++i) {
      const double mean = for_bends_[0].mean[i] * bend[i], slope = for_bends_[0].slope[i] * bend[i];
      load0[i] += mean - slope;
      load1[i] += mean + slope;
    }
}

void LinearFlow::load_blocks(double start, double end, kernels::Array& load0, kernels::Array& load1,
                             kernels::Array* bend) {
  if (!driven_->empty())
    driven_->in_step(start, end, part(load0), part(load1), bend ? part(*bend) : nullptr);
  if (random_->empty())
    return;
  if (driven_->empty())
    for (kernels::Array* load : {&load0, &load1})
      std::fill(load->begin() + uncoupled_.padded(), load->end(), 0.0);
  random_->in_step(start, end, q_.data(), v_.data(), nullptr);
  blocks_.add_input(q_.data(), part(load0));
  blocks_.add_input(v_.data(), part(load1));
}

void LinearFlow::move_blocks(int length, const State& from, const kernels::Array& load0,
                             const kernels::Array& load1, const kernels::Array& mean,
                             const kernels::Array& slope, State& to) const {
  if (!blocks_.empty())
    blocks_.move(place(length), part(from.q), inputs_of(load0, load1, mean, slope), part(to.q), part(to.v));
}

vibration::ModalFlow::Sums LinearFlow::move(int length, const State& from, const kernels::Array& load0,
                                            const kernels::Array& load1, State& to) {
  const vibration::ModalFlow::Sums sums = uncoupled_.move(length, from, load0, load1, to);
  move_blocks(length, from, load0, load1, none_, none_, to);
  return sums;
}

vibration::ModalFlow::Sums LinearFlow::push(const State& from, const kernels::Array& load0,
                                            const kernels::Array& load1, const kernels::Array& mean,
                                            const kernels::Array& slope, State& to) {
  const vibration::ModalFlow::Sums sums = uncoupled_.push(from, load0, load1, mean, slope, to);
  move_blocks(1, from, load0, load1, mean, slope, to);
  return sums;
}

void LinearFlow::bow(const State& from, const kernels::Array& load0, const kernels::Array& load1,
                     const kernels::Array& force, kernels::Array& bow) {
  uncoupled_.bow(from, load0, load1, force, bow);
  if (has_blocks())
    blocks_.bow(part(from.q), inputs_of(load0, load1, force, none_), part(bow));
}

void LinearFlow::add_works(int length, const State& from, const kernels::Array& load0,
                           const kernels::Array& load1, const vibration::ModalForce* force,
                           vibration::ModalFlow::Sums& sums, BlockWorks& works) {
  if (blocks_.empty())
    return;
  const kernels::StateWorks of =
      blocks_.works(place(length), part(from.q),
                    inputs_of(load0, load1, force ? force->mean : none_, force ? force->slope : none_));
  sums.load_work += of.load;
  sums.contact_work += of.contact;
  works.forces += of.load + of.contact;
  works.fluid += of.fluid;
  sums.energy += undamped_energy(works);
}

LinearFlow::BlockEnergies LinearFlow::energies(const State& state, const BlockWorks& works) {
  return {blocks_.energy(part(state.q)), works.fluid + start_.fluid_work - blocks_.fluid_form(part(state.q))};
}

void LinearFlow::modes_in_middle(int length, const State& from, const kernels::Array& load0,
                                 const kernels::Array& load1, const vibration::ModalForce* force,
                                 const kernels::Array& middle, double* q) {
  blocks_.middle(place(length), part(from.q),
                 inputs_of(load0, load1, force ? force->mean : none_, force ? force->slope : none_),
                 y_.data());
  blocks_.modes_of(y_.data(), q, v_.data());
  to_modes(middle.data(), q);
}

void LinearFlow::inside(double time, double duration, const State& from, const kernels::Array& load0,
                        const kernels::Array& load1, const vibration::ModalForce* force, double* q,
                        double* v) {
  if (blocks_.empty())
    return uncoupled_.inside(time, duration, from, load0, load1, force, q, v);
  uncoupled_.inside(time, duration, from, load0, load1, force, q_.data(), v_.data());
  to_modes(q_.data(), q);
  to_modes(v_.data(), v);
  const double share = time / duration;
  for (std::size_t i = 0; i < a_.size(); ++i) {
    const double mean = force ? force->mean[i] : 0.0, slope = force ? force->slope[i] : 0.0;
    a_[i] = load0[i] + mean - slope;
    b_[i] = a_[i] + share * (load1[i] - load0[i] + 2.0 * slope);
  }
  blocks_.inside(time, part(from.q), inputs_of(a_, b_, none_, none_), y_.data(), nullptr);
  blocks_.modes_of(y_.data(), q, v);
}

void LinearFlow::add_motion_forces(double* force) {
  if (blocks_.empty())
    return uncoupled_.add_motion_forces(force);
  std::fill(q_.begin(), q_.end(), 0.0);
  uncoupled_.add_motion_forces(q_.data());
  for (std::size_t i = 0; i < uncoupled_modes_.size(); ++i)
    force[uncoupled_modes_[i]] += q_[i];
  blocks_.add_forces(y_.data(), force);
}

void LinearFlow::response(const double* force, double* moved, double* velocity) {
  if (blocks_.empty())
    return uncoupled_.response(force, moved, velocity);
  std::fill(q_.begin(), q_.end(), 0.0);
  to_uncoupled(force, q_.data());
  kernels::Array rate(v_);
  uncoupled_.response(q_.data(), v_.data(), rate.data());
  to_modes(v_.data(), moved);
  to_modes(rate.data(), velocity);
  blocks_.response(force, moved, velocity);
}

} // namespace fretwork::transient
