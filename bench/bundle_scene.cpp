// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/bundle_scene.hpp"
#include "bench/tube_scene.hpp"
#include <array>
#include <cmath>
#include <numbers>

namespace fretwork::bench {
namespace {

constexpr double tube_radius = 0.01905 / 2.0;

/// Of the nominal forces, a number of its own for each tube and plane.
double force_share(int number) {
  double digit = 0.5, radical_inverse = 0.0;
  for (unsigned n = static_cast<unsigned>(number) + 1; n > 0; n /= 2, digit *= 0.5)
    radical_inverse += (n % 2) * digit;
  return 0.6 + 0.8 * radical_inverse;
}

/// A contact's rows over the modes of some tubes, or of all.
void place_on(transient::ContactPoint& point, const BundleScene& bundle, const std::vector<int>& tubes,
              const std::vector<Eigen::MatrixXd>& rows) {
  const Eigen::Index n = bundle.modes;
  if (bundle.by_tube) {
    point.b.resize(3, n * static_cast<Eigen::Index>(tubes.size()));
    for (std::size_t k = 0; k < tubes.size(); ++k) {
      point.b.middleCols(static_cast<Eigen::Index>(k) * n, n) = rows[k];
      point.modes.push_back({tubes[k] * n, n});
    }
    return;
  }
  point.b = Eigen::MatrixXd::Zero(3, n * bundle.tubes);
  for (std::size_t k = 0; k < tubes.size(); ++k)
    point.b.middleCols(tubes[k] * n, n) = rows[k];
}

/// Between neighbours, along y or z, at the mid-spans next to the third points.
void join(const BundleScene& bundle, int first, int second, bool along_y, const TubeScene& tube,
          const transient::Scene& single, transient::Scene& scene) {
  for (const int span : {bundle.supports / 3, 2 * bundle.supports / 3}) {
    transient::ContactPoint point;
    point.name = "tubes";
    point.support = single.contacts.front().support;
    point.support.obstacle = contact::RoundPair{2.0 * tube_radius};
    const double apart = 2.0 * tube_radius + bundle.gap;
    point.rest = along_y ? core::Vec3(0.0, -apart, 0.0) : core::Vec3(0.0, 0.0, -apart);
    // shapes are sines that the support rows have at other places: scale those of the support's mode by mode
    const double x = tube.length * (span + 0.5) / (tube.supports + 1), at = tube.length / (tube.supports + 1);
    Eigen::MatrixXd b = single.contacts.front().b;
    for (Eigen::Index i = 0; i < b.cols(); ++i) {
      const double k = (static_cast<double>(i / 2) + 1.0) * std::numbers::pi / tube.length;
      const double amplitude = single.contacts.front().b.col(i).sum() / std::sin(k * at);
      b.col(i).setZero();
      b(1 + i % 2, i) = amplitude * std::sin(k * x);
    }
    place_on(point, bundle, {first, second}, {b, -b});
    scene.contacts.push_back(std::move(point));
  }
}

} // namespace

transient::Scene bundle_scene(const BundleScene& bundle) {
  TubeScene tube;
  tube.modes = bundle.modes;
  tube.supports = bundle.supports;
  tube.length = bundle.supports + 1.0;
  tube.duration = bundle.duration;
  const transient::Scene single = tube_scene(tube);
  const Eigen::Index n = bundle.modes, all = n * bundle.tubes;
  transient::Scene scene;
  scene.duration = bundle.duration;
  scene.system.stiffness = single.system.stiffness.replicate(bundle.tubes, 1);
  scene.system.damping = single.system.damping.replicate(bundle.tubes, 1);
  scene.q0 = scene.v0 = Eigen::VectorXd::Zero(all);
  for (const vibration::Load& load : single.loads)
    scene.loads.push_back({load.function, Eigen::VectorXd::Zero(all)});
  const int side = static_cast<int>(std::ceil(std::sqrt(bundle.tubes)));
  for (int t = 0; t < bundle.tubes; ++t) {
    for (std::size_t l = 0; l < scene.loads.size(); ++l)
      scene.loads[l].modal_force.segment(t * n, n) =
          force_share(2 * t + static_cast<int>(l)) * single.loads[l].modal_force;
    for (transient::ContactPoint point : single.contacts) {
      const Eigen::MatrixXd b = point.b;
      place_on(point, bundle, {t}, {b});
      scene.contacts.push_back(std::move(point));
    }
  }
  for (int t = 0; bundle.joined && t < bundle.tubes; ++t) {
    if (t % side + 1 < side && t + 1 < bundle.tubes)
      join(bundle, t, t + 1, true, tube, single, scene);
    if (t + side < bundle.tubes)
      join(bundle, t, t + side, false, tube, single, scene);
  }
  return scene;
}

} // namespace fretwork::bench
