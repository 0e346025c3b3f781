// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/draws.hpp"
#include "core/error.hpp"
#include "flow/block_synthesis.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::flow {

/// Two blocks, cross-faded.
class ForceDraw::Synthesis {
public:
  Synthesis(const std::vector<TurbulentZone>& zones, const std::vector<MatrixLoad>& matrices,
            const DrawOptions& options)
      : blocks(zones, matrices, options) {
    const std::int64_t n = blocks.samples();
    fade = n / fades_per_block;
    hop = n - fade;
    rise.resize(fade);
    fall.resize(fade);
    for (std::int64_t j = 0; j < fade; ++j) {
      const double angle = 0.5 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(fade);
      rise[j] = std::sin(angle);
      fall[j] = std::cos(angle);
    }
    for (Held& h : held)
      h.samples.resize(blocks.rows(), n);
  }

  const Eigen::MatrixXd& block(std::int64_t number) {
    Held& h = held[number % 2];
    if (h.number != number) {
      blocks.compute(static_cast<std::uint32_t>(number), h.samples);
      h.number = number;
    }
    return h.samples;
  }

  void fill(std::int64_t first, Eigen::Ref<Eigen::MatrixXd> forces) {
    const Eigen::Index modes = blocks.modes();
    for (Eigen::Index column = 0; column < forces.cols();) {
      const std::int64_t number = (first + column) / hop, place = (first + column) % hop;
      const bool fades = place >= hop - fade;
      const Eigen::Index count =
          std::min<Eigen::Index>(forces.cols() - column, (fades ? hop : hop - fade) - place);
      const Eigen::MatrixXd& now = block(number);
      auto out = forces.middleCols(column, count);
      out = now.block(0, fade + place, modes, count);
      if (fades) {
        const std::int64_t into = place - (hop - fade);
        const Eigen::MatrixXd& next = block(number + 1);
        for (Eigen::Index j = 0; j < count; ++j)
          out.col(j) = fall[into + j] * out.col(j) + rise[into + j] * next.col(into + j).head(modes);
      }
      column += count;
    }
  }

  BlockSynthesis blocks;
  std::int64_t fade, hop; ///< C and H in samples
  Eigen::VectorXd rise, fall;
  struct Held {
    std::int64_t number = -1;
    Eigen::MatrixXd samples;
  } held[2];
};

ForceDraw::ForceDraw(const std::vector<TurbulentZone>& zones, const std::vector<MatrixLoad>& matrices,
                     const DrawOptions& options)
    : synthesis_(std::make_unique<Synthesis>(zones, matrices, options)) {}
ForceDraw::ForceDraw(ForceDraw&&) noexcept = default;
ForceDraw& ForceDraw::operator=(ForceDraw&&) noexcept = default;
ForceDraw::~ForceDraw() = default;

Eigen::Index ForceDraw::modes() const { return synthesis_->blocks.modes(); }
double ForceDraw::step() const { return synthesis_->blocks.step(); }
std::int64_t ForceDraw::hop() const { return synthesis_->hop; }

void ForceDraw::fill(std::int64_t first, Eigen::Ref<Eigen::MatrixXd> forces) {
  assert(first >= 0 && forces.rows() == modes());
  synthesis_->fill(first, forces);
}

Eigen::MatrixXd draw_forces(ForceDraw& draw, double duration) {
  if (!(duration >= 0.0) || !std::isfinite(duration))
    throw core::Error(fmt::format("a draw of {:g} s makes no sense; give a duration >= 0", duration));
  Eigen::MatrixXd forces(draw.modes(), static_cast<Eigen::Index>(std::ceil(duration / draw.step())) + 1);
  draw.fill(0, forces);
  return forces;
}

} // namespace fretwork::flow
