// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contacts/contact_blocks.hpp"
#include <algorithm>

namespace fretwork::transient {
namespace {

/// Whether the damping matrix couples modes of different blocks.
bool couples_blocks(const vibration::System& system, const std::vector<int>& block_of_mode) {
  const Eigen::MatrixXd& c = system.damping_matrix;
  for (Eigen::Index j = 0; j < c.cols(); ++j)
    for (Eigen::Index i = 0; i < c.rows(); ++i)
      if (c(i, j) != 0.0 &&
          block_of_mode[static_cast<std::size_t>(i)] != block_of_mode[static_cast<std::size_t>(j)])
        return true;
  return false;
}

} // namespace

ContactBlocks::ContactBlocks(const Scene& scene)
    : places(scene.contacts.size()), block_of_mode(static_cast<std::size_t>(scene.system.size()), -1) {
  std::vector<vibration::ModeRange> ranges;
  for (const ContactPoint& point : scene.contacts)
    point.for_ranges([&](Eigen::Index first, const auto& part) { ranges.push_back({first, part.cols()}); });
  std::sort(ranges.begin(), ranges.end(),
            [](const vibration::ModeRange& a, const vibration::ModeRange& b) { return a.first < b.first; });
  int blocks = 0;
  Eigen::Index end = -1; // of the last block: ranges that overlap are one
  for (const vibration::ModeRange& range : ranges) {
    if (range.size == 0)
      continue;
    blocks += range.first >= end || blocks == 0;
    for (Eigen::Index i = std::max(range.first, end); i < range.first + range.size; ++i)
      block_of_mode[static_cast<std::size_t>(i)] = blocks - 1;
    end = std::max(end, range.first + range.size);
  }
  if (blocks > 1 && couples_blocks(scene.system, block_of_mode)) {
    std::fill(block_of_mode.begin(), block_of_mode.end(), 0);
    blocks = 1;
  }
  contacts.resize(static_cast<std::size_t>(blocks));
  for (std::size_t c = 0; c < scene.contacts.size(); ++c)
    scene.contacts[c].for_ranges([&](Eigen::Index first, const auto& part) {
      if (part.cols() == 0)
        return;
      const int block = block_of_mode[static_cast<std::size_t>(first)];
      std::vector<int>& of_block = contacts[static_cast<std::size_t>(block)];
      if (!of_block.empty() && of_block.back() == static_cast<int>(c))
        return; // both of its ranges are in one block
      places[c].push_back({block, static_cast<int>(of_block.size())});
      of_block.push_back(static_cast<int>(c));
    });
  for (std::size_t c = 0; c < places.size(); ++c)
    if (places[c].empty()) { // no mode moves it
      places[c].push_back({static_cast<int>(contacts.size()), 0});
      contacts.push_back({static_cast<int>(c)});
    }
}

} // namespace fretwork::transient
