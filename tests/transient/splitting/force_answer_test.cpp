// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/splitting/contact_step.hpp"
#include "transient/splitting/force_answer.hpp"
#include <gtest/gtest.h>
#include <tuple>

namespace force_answer_test {

using namespace fretwork;
using namespace fretwork::transient;

/// Mean and slope of the force of an element over a step by the midpoint rule in many parts, moved by what `change` adds.
LinearInTime by_parts(const Element& element, double step, double from, double to,
                      const LinearInTime& change) {
  constexpr int parts = 20000;
  const double dt = step / parts;
  double u = 0.0, v = 0.0;
  LinearInTime out;
  for (int i = 0; i < parts; ++i) {
    const double s = (i + 0.5) / parts, a = change.mean + change.slope * (2.0 * s - 1.0);
    const bool closed = s > from && s < to;
    double force = 0.0;
    if (closed) // v1 = v + dt (a + W f), f = -K (u + dt/2 vm) - C vm, vm the mean of both speeds
      force =
          -(element.stiffness * u + (0.5 * dt * element.stiffness + element.damping) * (v + 0.5 * dt * a)) /
          (1.0 + element.mobility * 0.5 * dt * (0.5 * dt * element.stiffness + element.damping));
    const double v1 = v + dt * (a + element.mobility * force);
    u += 0.5 * dt * (v + v1);
    v = v1;
    if (closed && s - 1.0 / parts < from &&
        from > 0.0) // the damper's force begins earlier by what the contact has moved
      force -= element.damping * u / dt;
    out.mean += force / parts;
    out.slope += 3.0 * (2.0 * s - 1.0) * force / parts;
  }
  return out;
}

// Springs and dampers as stiff as in steps of w_c h = 1, closed throughout, from a touch on, until they open.
TEST(ForceAnswer, IsThatOfTheMotionInSmallParts) {
  constexpr double step = 5e-4, mobility = 4.0;
  const double stiffness = 1.0 / (mobility * step * step), damping = 1.0 / (mobility * step);
  for (const auto& [k, c] :
       {std::pair{stiffness, 0.0}, {stiffness, 0.3 * damping}, {0.3 * stiffness, damping}})
    for (const auto& [from, to] : {std::pair{0.0, 1.0}, {0.4, 1.0}, {0.0, 0.6}, {0.3, 0.8}})
      for (const LinearInTime change : {LinearInTime{1.0, 0.0}, {0.0, 1.0}, {0.6, -0.8}}) {
        const LinearInTime exact = by_parts({k, c, 0.0}, step, from, to, change),
                           free = answer_of({k, c, 0.0}, step, from, to, change);
        const double size = std::abs(exact.mean) + std::abs(exact.slope);
        EXPECT_NEAR(free.mean, exact.mean, 1e-3 * size) << k << ' ' << c << ' ' << from << ' ' << to;
        EXPECT_NEAR(free.slope, exact.slope, 1e-3 * size) << k << ' ' << c << ' ' << from << ' ' << to;
      }
  // the force that the answer itself brings forth is not linear in time, that of a damper the least
  for (const auto& [k, c, tolerance] :
       {std::tuple{stiffness, 0.0, 0.03}, {stiffness, 0.3 * damping, 0.03}, {0.3 * stiffness, damping, 0.1}})
    for (const LinearInTime change : {LinearInTime{1.0, 0.0}, {0.0, 1.0}, {0.6, -0.8}}) {
      const LinearInTime exact = by_parts({k, c, mobility}, step, 0.0, 1.0, change),
                         ours = answer_of({k, c, mobility}, step, 0.0, 1.0, change);
      const double size = std::abs(exact.mean) + std::abs(exact.slope);
      EXPECT_NEAR(ours.mean, exact.mean, tolerance * size) << k << ' ' << c;
      EXPECT_NEAR(ours.slope, exact.slope, tolerance * size) << k << ' ' << c;
    }
}

struct Case {
  const char* name;
  double gap, across; ///< m at the start; m/s along t
  bool slides, one_state = true;
};

class ContactAnswer : public testing::TestWithParam<Case> {};

// A tube in a hole, found again under accelerations that differ by little: what it adds to its force is its answer.
TEST_P(ContactAnswer, IsWhatFindingItAgainAdds) {
  const Case& of = GetParam();
  constexpr double step = 5e-4, radius = 2e-4, penetration = 3e-5, pressing = 20.0;
  Mobility mobility;
  for (int i = 0; i < 3; ++i)
    mobility.add(i, i, 3.0);
  const contact::Support support{contact::Circle{radius}, {1e6, 20.0}, {1e6, 100.0, 0.3, 0.3}};
  const ContactStep contact(support, {}, mobility, false, step, 4, radius, 1e-2);
  ContactPast past;
  past.axes = {-1.0, 0.0};
  past.closed = of.gap < 0.0;
  if (of.slides)
    past.friction = {{0.0, -0.3 * 1e6 * penetration}, true};
  const FreePath path{
      {radius - of.gap, 0.0, 0.0}, {of.gap > 0.0 ? 0.1 : -0.02, of.across, 0.0}, {pressing, 0.0, 0.0}, {}};
  const auto found = [&](const Components& mean, const Components& slope) {
    FreePath changed = path;
    changed.a = changed.a + (mean - slope);
    changed.j = changed.j + (2.0 / step) * slope;
    ContactAct act;
    contact.make(past, changed, {-1e6 * penetration, 0.0, 0.0}, act);
    return act;
  };
  const ContactAct act = found({}, {});
  ASSERT_GT(act.state.normal_force, 0.0);
  EXPECT_EQ(contact.in_one_state(act), of.one_state);
  if (!of.one_state)
    return;
  for (const auto& [mean, slope] : {std::pair{Components{1.0, 0.0, 0.0}, Components{}},
                                    {Components{}, Components{0.7, 0.0, 0.0}},
                                    {Components{0.3, 0.5, 0.0}, Components{0.0, -0.4, 0.0}}}) {
    const ContactAct again = found(mean, slope);
    ContactAct answered = act;
    ASSERT_TRUE(contact.answer(mean, slope, answered));
    const Components by_mean = again.mean - act.mean, by_slope = again.slope - act.slope;
    const double size = sum_of_sizes(by_mean) + sum_of_sizes(by_slope);
    ASSERT_GT(size, 1e-4);
    EXPECT_LT(sum_of_sizes(answered.mean - again.mean), 0.05 * size);
    EXPECT_LT(sum_of_sizes(answered.slope - again.slope), 0.1 * size);
    EXPECT_NEAR(answered.state.normal_force, again.state.normal_force, 0.03 * size);
    EXPECT_NEAR(answered.state.friction_work, again.state.friction_work,
                0.1 * std::abs(again.state.friction_work - act.state.friction_work) +
                    0.02 * act.state.friction_work);
  }
  ContactAct unchanged = act;
  EXPECT_FALSE(contact.answer({-1e4, 0.0, 0.0}, {}, unchanged)); // it would open
  EXPECT_EQ(unchanged.mean.y(), act.mean.y());
}

INSTANTIATE_TEST_SUITE_P(Contacts, ContactAnswer,
                         testing::Values(Case{"sticks", -3e-5, 0.0, false}, Case{"slides", -3e-5, 0.08, true},
                                         Case{"touches", 2e-5, 0.08, false},
                                         Case{"breaks_loose", -3e-5, 0.01, false, false}),
                         [](const auto& of) { return of.param.name; });

} // namespace force_answer_test
