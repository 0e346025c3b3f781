// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/modes/moving_modes.hpp"
#include <algorithm>

namespace fretwork::transient {

std::vector<Eigen::Index> moving_modes(const Scene& scene) {
  using Flags = Eigen::Array<bool, Eigen::Dynamic, 1>;
  Flags moves = scene.q0.array() != 0.0 || scene.v0.array() != 0.0;
  for (const vibration::Load& load : scene.loads)
    moves = moves || load.modal_force.array() != 0.0;
  if (const core::MotionForces& f = scene.system.motion; !f.empty())
    moves = moves || (f.stiffness.array() != 0.0).colwise().any().transpose() ||
            (f.output.array() != 0.0).colwise().any().transpose();
  for (const signals::SampledLoad& load : scene.sampled_loads)
    moves = moves || load.scale.array() != 0.0;
  for (const ContactPoint& point : scene.contacts)
    point.for_ranges([&](Eigen::Index first, const auto& part) {
      auto here = moves.segment(first, part.cols());
      here = (here || (part.array() != 0.0).colwise().any().transpose()).eval();
    });
  std::vector<Eigen::Index> modes;
  for (Eigen::Index i = 0; i < moves.size(); ++i)
    if (moves(i))
      modes.push_back(i);
  if (const Eigen::MatrixXd& c = scene.system.damping_matrix; c.size() > 0) {
    for (std::size_t k = 0; k < modes.size(); ++k) // the list grows by those that its modes move
      for (Eigen::Index i = 0; i < moves.size(); ++i)
        if (!moves(i) && c(i, modes[k]) != 0.0) {
          moves(i) = true;
          modes.push_back(i);
        }
    std::sort(modes.begin(), modes.end());
  }
  return modes;
}

namespace {

/// The modes of a contact that are among some, by their numbers there.
void restrict_modes(const std::vector<Eigen::Index>& modes, ContactPoint& point) {
  if (point.modes.empty()) {
    point.b = point.b(Eigen::all, modes).eval();
    return;
  }
  std::vector<Eigen::Index> columns;
  Eigen::Index before = 0;
  for (vibration::ModeRange& range : point.modes) {
    const auto [first, size] = range;
    const auto begin = std::lower_bound(modes.begin(), modes.end(), first),
               end = std::lower_bound(begin, modes.end(), first + size);
    for (auto mode = begin; mode != end; ++mode)
      columns.push_back(before + *mode - first);
    range = {begin - modes.begin(), end - begin};
    before += size;
  }
  point.b = point.b(Eigen::all, columns).eval();
}

} // namespace

std::vector<ContactPoint> with_modes(std::vector<ContactPoint> contacts,
                                     const std::vector<Eigen::Index>& modes) {
  for (ContactPoint& point : contacts)
    restrict_modes(modes, point);
  return contacts;
}

Scene with_modes(const Scene& scene, const std::vector<Eigen::Index>& modes) {
  Scene out = scene;
  out.system.stiffness = scene.system.stiffness(modes);
  out.system.damping = scene.system.damping(modes);
  if (scene.system.damping_matrix.size() > 0)
    out.system.damping_matrix = scene.system.damping_matrix(modes, modes);
  if (const core::MotionForces& f = scene.system.motion; !f.empty())
    out.system.motion = {f.stiffness(modes, modes), f.damping(modes, modes), f.input(modes, Eigen::all),
                         f.rates, f.output(Eigen::all, modes)};
  for (std::size_t k = 0; k < out.loads.size(); ++k)
    out.loads[k].modal_force = scene.loads[k].modal_force(modes);
  for (signals::SampledLoad& load : out.sampled_loads)
    load = load.of_modes(modes);
  out.contacts = with_modes(std::move(out.contacts), modes);
  out.q0 = scene.q0(modes);
  out.v0 = scene.v0(modes);
  return out;
}

} // namespace fretwork::transient
