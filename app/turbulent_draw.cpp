// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/turbulent_loads.hpp"
#include "core/error.hpp"
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace fretwork::app {
namespace {

constexpr double most_bytes = 2147483648.0; ///< of one draw

/// Samples of a draw that is made when the first of them is read.
class DrawnForces final : public signals::ForceSamples {
public:
  explicit DrawnForces(flow::ForceDraw draw) : draw_(std::move(draw)) {}
  [[nodiscard]] Eigen::Index rows() const override { return draw_.modes(); }
  [[nodiscard]] double step() const override { return draw_.step(); }
  void fill(std::int64_t first, Eigen::Ref<Eigen::MatrixXd> forces) override { draw_.fill(first, forces); }

private:
  flow::ForceDraw draw_;
};

/// Holds the shapes at the patches; blocks only while a run reads them.
class DrawSource final : public signals::ForceSource {
public:
  using Zones = std::shared_ptr<const std::vector<flow::TurbulentZone>>;
  DrawSource(Zones zones, const flow::DrawOptions& options) : zones_(std::move(zones)), options_(options) {}
  [[nodiscard]] std::shared_ptr<const DrawSource> with_seed(std::uint32_t seed) const {
    flow::DrawOptions options = options_;
    options.seed = seed;
    return std::make_shared<DrawSource>(zones_, options);
  }
  [[nodiscard]] std::shared_ptr<signals::ForceSamples> open() const override {
    std::shared_ptr<signals::ForceSamples> samples = opened_.lock();
    if (!samples) {
      samples = std::make_shared<DrawnForces>(flow::ForceDraw(*zones_, {}, options_));
      opened_ = samples;
    }
    return samples;
  }

private:
  Zones zones_;
  flow::DrawOptions options_;
  mutable std::weak_ptr<signals::ForceSamples> opened_;
};

/// Modes above the band respond quasi-statically.
void note_modes_above(const TurbulentLoad& load, const std::vector<const modal::Basis*>& bases,
                      std::vector<std::string>& notes) {
  Eigen::Index above = 0, all = 0;
  for (const modal::Basis* basis : bases) {
    above += modes_above(load.band, *basis);
    all += basis->true_modes();
  }
  if (above > 0)
    notes.push_back(fmt::format("{}: {} of {} modes lie above its band, which ends at {:.4g} Hz, and respond "
                                "quasi-statically; a wider band excites them",
                                load.name, above, all, load.band.high));
}

} // namespace

std::optional<signals::SampledLoad> sampled_load(const TurbulentLoad& load,
                                                 const std::vector<const modal::Basis*>& bases,
                                                 std::vector<std::string>& notes) {
  std::vector<flow::TurbulentZone> zones = zones_on(load, bases);
  if (zones.empty())
    return std::nullopt;
  if (const double bytes = flow::draw_bytes(zones, load.band); bytes > most_bytes)
    throw core::Error(fmt::format("{}: a draw of {} modes on its patches would hold {:.3g} GB, at most "
                                  "{:.3g}; take a longer correlation "
                                  "length, fewer modes, or a lower end of band",
                                  load.name, zones.front().modes(), 1e-9 * bytes, 1e-9 * most_bytes));
  note_modes_above(load, bases, notes);
  signals::SampledLoad out;
  out.rms = flow::modal_mean_squares(zones, load.band).cwiseSqrt();
  const Eigen::Index modes = out.rms.size();
  for (Eigen::Index i = 0; i < modes; ++i)
    out.rows.push_back(i);
  out.scale = Eigen::VectorXd::Ones(modes);
  out.highest = load.band.high;
  out.ramp = load.ramp;
  out.source = std::make_shared<DrawSource>(
      std::make_shared<const std::vector<flow::TurbulentZone>>(std::move(zones)), load.draw);
  return out;
}

std::vector<signals::SampledLoad> sampled_loads(const std::vector<TurbulentLoad>& loads,
                                                const std::vector<modal::Basis>& all,
                                                const std::vector<std::size_t>& structures,
                                                std::vector<std::string>& notes) {
  std::vector<const modal::Basis*> bases;
  for (const std::size_t s : structures)
    bases.push_back(&all[s]);
  std::vector<signals::SampledLoad> out;
  for (const TurbulentLoad& load : loads)
    if (auto sampled = sampled_load(load, bases, notes))
      out.push_back(std::move(*sampled));
  return out;
}

signals::SampledLoad with_seed(signals::SampledLoad load, std::uint32_t seed) {
  load.source = std::static_pointer_cast<const DrawSource>(load.source)->with_seed(seed);
  return load;
}

} // namespace fretwork::app
