// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/step_response.hpp"
#include <algorithm>
#include <cmath>

namespace fretwork::transient {
namespace {

/// w h of modes that hold back a part of a force within the step. Slower ones hold back less than 0.1 % of it; faster ones are followed by no step, and from pi on
/// would turn the velocity that it gives.
constexpr double least_held_back = 0.1, most_held_back = 3.0;

/// Component x_loc y_loc z_loc of y z x.
Eigen::Index local_of(int component) { return (component + 1) % 3; }

/// visit(mode, column of b) for the modes of a contact in a block.
template <class Visit>
void for_modes(const Scene& scene, const ContactBlocks& blocks, std::size_t block, int contact,
               const Visit& visit) {
  scene.contacts[static_cast<std::size_t>(contact)].for_ranges([&](Eigen::Index first, const auto& part) {
    if (part.cols() == 0 || blocks.block_of_mode[static_cast<std::size_t>(first)] != static_cast<int>(block))
      return;
    for (Eigen::Index i = 0; i < part.cols(); ++i)
      visit(static_cast<std::size_t>(first + i), part.col(i));
  });
}

} // namespace

// Blocks share no mode: one motion of all modes is the response to a force in each of them.
std::vector<std::vector<ImpulseResponse>> step_response(const Scene& scene, const ContactBlocks& blocks,
                                                        int components, LinearFlow& modes, double step) {
  std::vector<std::vector<ImpulseResponse>> out;
  std::size_t most = 0;
  for (const auto& contacts : blocks.contacts) {
    out.emplace_back(contacts.size() * contacts.size());
    most = std::max(most, contacts.size());
  }
  kernels::Array force(static_cast<std::size_t>(kernels::padded(static_cast<int>(scene.system.size())))),
      moved(force), velocity(force);
  for (std::size_t from = 0; from < most; ++from)
    for (int component = 0; component < components; ++component) {
      std::fill(force.begin(), force.end(), 0.0);
      for (std::size_t b = 0; b < blocks.size(); ++b)
        if (from < blocks.contacts[b].size())
          for_modes(scene, blocks, b, blocks.contacts[b][from],
                    [&](std::size_t mode, const auto& column) { force[mode] = column(local_of(component)); });
      modes.response(force.data(), moved.data(), velocity.data());
      for (Eigen::Index i = 0; i < scene.system.size(); ++i) { // what they hold back, m
        const auto mode = static_cast<std::size_t>(i);
        const double wh = std::sqrt(scene.system.stiffness(i)) * step;
        velocity[mode] =
            wh > least_held_back && wh < most_held_back ? moved[mode] - 0.5 * step * velocity[mode] : 0.0;
      }
      for (std::size_t b = 0; b < blocks.size(); ++b) {
        const auto& contacts = blocks.contacts[b];
        for (std::size_t other = 0; from < contacts.size() && other < contacts.size(); ++other)
          for (int to = 0; to < components; ++to) {
            double sum = 0.0, held_back = 0.0;
            for_modes(scene, blocks, b, contacts[other], [&](std::size_t mode, const auto& column) {
              sum += moved[mode] * column(local_of(to));
              held_back += velocity[mode] * column(local_of(to));
            });
            const double per = 2.0 / (step * step);
            ImpulseResponse& g = out[b][from * contacts.size() + other];
            g.w.add(to, component, per * (sum + held_back));
            g.v.add(to, component, 12.0 / (step * step) * per * held_back);
          }
      }
    }
  return out;
}

} // namespace fretwork::transient
