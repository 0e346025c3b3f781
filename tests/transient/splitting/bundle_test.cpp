// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts that name the modes of their structures: the same motion as over all modes, and structures that do not touch move as if alone.
#include "bench/bundle_scene.hpp"
#include "transient/run.hpp"
#include "transient/splitting/splitting.hpp"
#include <gtest/gtest.h>

namespace bundle_test {

using namespace fretwork;
using namespace fretwork::transient;

namespace {

constexpr double step = 5e-5; // s
/// Of displacements, after some hundred steps with impacts: sums of modes are taken in another order.
constexpr double round_off = 1e-9;

bench::BundleScene four_tubes() {
  bench::BundleScene bundle;
  bundle.tubes = 4;
  bundle.modes = 18; // no whole packs of modes
  bundle.supports = 3;
  bundle.duration = 0.1;
  return bundle;
}

Eigen::VectorXd displacement(const Scene& scene, double time, double* closed = nullptr) {
  const auto scheme = make_splitting(scene, step);
  double touched = 0.0;
  const int last = static_cast<int>(scene.contacts.size()) - 1;
  while (scheme->next_time() < time)
    for (const int c : scheme->advance().active)
      touched += c == last ? 1.0 : 0.0;
  if (closed)
    *closed = touched;
  Eigen::VectorXd q(scene.system.size()), v(q.size());
  scheme->state_at(time - 0.5 * step, q.data(), v.data());
  return q;
}

TEST(Bundle, MovesAsOverAllModes) {
  bench::BundleScene bundle = four_tubes();
  bundle.gap = 2e-5; // they touch at once
  const Scene scene = bench::bundle_scene(bundle);
  double touched = 0.0;
  const Eigen::VectorXd q = displacement(scene, 0.02, &touched),
                        over_all = displacement(over_all_modes(scene), 0.02);
  EXPECT_GT(touched, 0.0) << "tubes touch";
  EXPECT_GT(q.norm(), 0.0);
  EXPECT_LT((q - over_all).norm(), round_off * q.norm());
}

TEST(Bundle, TubesThatDoNotTouchMoveAsIfAlone) {
  bench::BundleScene bundle = four_tubes();
  bundle.gap = 0.1; // never closed
  const Scene joined = bench::bundle_scene(bundle);
  bundle.joined = false;
  const Scene apart = bench::bundle_scene(bundle);
  ASSERT_GT(joined.contacts.size(), apart.contacts.size());
  const Eigen::VectorXd q = displacement(joined, 0.08), alone = displacement(apart, 0.08);
  EXPECT_LT((q - alone).norm(), round_off * q.norm());
}

TEST(Bundle, HasTheRatesOfTheSameContactsOverAllModes) {
  const Scene scene = bench::bundle_scene(four_tubes());
  const StepOptions options;
  const StepChoice by_tube = choose_step(scene, options),
                   together = choose_step(over_all_modes(scene), options);
  EXPECT_NEAR(by_tube.contact_frequency, together.contact_frequency, round_off * together.contact_frequency);
  EXPECT_NEAR(by_tube.stick_frequency, together.stick_frequency, round_off * together.stick_frequency);
  EXPECT_NEAR(by_tube.damper_rate, together.damper_rate, round_off * together.damper_rate);
}

} // namespace

} // namespace bundle_test
