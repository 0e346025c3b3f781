// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Friction over a step in each of its forms, and random input for them.
#pragma once
#include "contact/friction_law.hpp"
#include "uniform.hpp"
#include <vector>

namespace fretwork::tests {

using contact::Friction;
using contact::FrictionLaw;
using contact::FrictionMemory;
using contact::FrictionMemoryKind;
using contact::FrictionStep;
using contact::FrictionTable;
using contact::Vec2;

/// What a step is given; forms on a line take the components along t.
struct StepInput {
  double normal;
  Vec2 velocity; ///< of an explicit form; free of an implicit one
  contact::Mobility mobility;
};

/// Any direction, free or hardly free to move, mobilities as unlike as 1 and `least`.
inline StepInput draw_step(Uniform& uniform, double normal, double least) {
  const double angle = uniform(0.0, std::numbers::pi), c = std::cos(angle), s = std::sin(angle);
  const double big = uniform.scale(1e-8, 1e2), small = big * uniform.scale(least, 1.0);
  return {normal,
          uniform.vector(uniform.scale(1e-4, 1.0)),
          {big * c * c + small * s * s, (big - small) * c * s, big * s * s + small * c * c}};
}

enum class Form { evaluate, evaluate_line, plane, line };
inline constexpr Form forms[] = {Form::evaluate, Form::evaluate_line, Form::plane, Form::line};
[[nodiscard]] inline bool on_a_line(Form form) { return form == Form::evaluate_line || form == Form::line; }

/// Force of a step and the displacement that goes with it, m.
struct Moved {
  Friction friction;
  Vec2 dx;
};
[[nodiscard]] inline Moved move(Form form, const FrictionLaw& law, double h, const FrictionMemory& memory,
                                const StepInput& in) {
  const FrictionTable table = friction_table(law, h);
  const Vec2 v = in.velocity;
  const contact::Mobility& a = in.mobility;
  switch (form) {
  case Form::evaluate:
    return {evaluate(law, memory, in.normal, h * v, v), h * v};
  case Form::evaluate_line:
    return {evaluate_line(law, memory, in.normal, h * v.t, v.t), {0.0, h * v.t}};
  case Form::plane: {
    const Friction f = step_friction_plane(law, table, memory, in.normal, v, a);
    const Vec2 answer{a.xx * f.force.x + a.xt * f.force.t, a.xt * f.force.x + a.tt * f.force.t};
    return {f, h * (v + answer)};
  }
  case Form::line: {
    const Friction f = step_friction_line(law, table, memory, in.normal, v.t, a.tt);
    return {f, {0.0, h * (v.t + a.tt * f.force.t)}};
  }
  }
  return {};
}

/// Every law of one memory: one and two coefficients, without damper, with a strong one, along one direction,
/// free once it slides.
inline std::vector<FrictionLaw> laws(FrictionMemoryKind kind) {
  return {{1e6, 50.0, 0.3, 0.3, kind, {1.0, 1.0}}, {1e6, 50.0, 0.5, 0.3, kind, {1.0, 1.0}},
          {1e6, 0.0, 0.3, 0.3, kind, {1.0, 1.0}},  {1e6, 5e4, 0.4, 0.1, kind, {1.0, 1.0}},
          {1e6, 50.0, 0.5, 0.3, kind, {1.0, 0.0}}, {1e6, 50.0, 0.5, 0.3, kind, {0.0, 1.0}},
          {1e6, 50.0, 0.3, 0.0, kind, {1.0, 1.0}}, {1e6, 0.0, 0.3, 0.0, kind, {1.0, 1.0}}};
}
inline constexpr FrictionMemoryKind kinds[] = {FrictionMemoryKind::return_map, FrictionMemoryKind::reference};

} // namespace fretwork::tests
