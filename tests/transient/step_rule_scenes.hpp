// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Scenes of one mass whose step is known, and what is expected of the choice.
#pragma once
#include "scenes.hpp"
#include "transient/scene/scheme_limits.hpp"
#include <gtest/gtest.h>
#include <string>

namespace fretwork::tests::step_rule {

using namespace fretwork::transient;

constexpr double round_off = 1e-12;
constexpr double eps = 0.5;                                                        // at an accuracy of 1 %
constexpr double share = limits_of(SchemeKind::splitting).contact.share;           // w_c h and w_t h at 1 %
constexpr double mode_share = limits_of(SchemeKind::splitting).highest_mode.share; // w_max h, likewise
constexpr double beside_scaled = mode_share / scaled_above;                        // w_c h, likewise
constexpr double mass = 2.0;

inline Scene scene_with(const contact::Support& support, double duration = 1000.0,
                        const Vec3& stiffness = Vec3::Zero()) {
  Scene scene = mass_point(mass, stiffness, duration);
  scene.contacts = {contact_of(mass, support)};
  return scene;
}

/// Its stiff direction y vibrates by itself, so that no heavier mode may stand for it.
inline Scene vibrating(Scene scene) {
  scene.v0(1) = 1.0;
  return scene;
}

inline bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The step is the limit, rounded down so that whole steps cover the duration.
inline void expect_governed(const Scene& scene, const StepOptions& options, double limit,
                            const std::string& reason) {
  const StepChoice choice = choose_step(scene, options);
  EXPECT_LE(choice.step, limit * (1.0 + round_off));
  EXPECT_GT(choice.step, limit * (1.0 - 2.0 * limit / scene.duration));
  EXPECT_NEAR(choice.step * static_cast<double>(choice.steps), scene.duration, round_off * scene.duration);
  EXPECT_TRUE(mentions(choice.reason, reason)) << choice.reason;
  EXPECT_TRUE(choice.warnings.empty());
}

} // namespace fretwork::tests::step_rule
