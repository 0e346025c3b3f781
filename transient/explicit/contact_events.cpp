// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/explicit/contact_events.hpp"

namespace fretwork::transient {
namespace {

/// Shares of a step where margins are looked at, the first soon after an event at its start: what slides no more may slide again at once.
constexpr double looks[] = {0.0625, 0.25, 0.5, 0.75, 1.0};
constexpr double instant_round_off = 1e-15;
constexpr int most_iterations =
    120; ///< bisection alone ends after 50; two iterations of regula falsi to one of it

double of(const Margins& margins, bool friction) { return friction ? margins.friction : margins.normal; }

} // namespace

ContactEvents::ContactEvents(const MotionRates& rates)
    : rates_(rates), terms_(DormandPrince::terms, ContactMotion(rates.contacts())), probe_(rates.contacts()) {
}

std::optional<ContactEvent> ContactEvents::first(const DormandPrince& step, double time, double h) {
  start_ = time;
  h_ = h;
  std::optional<ContactEvent> best;
  for (int j = 0; j < DormandPrince::terms; ++j)
    terms_[static_cast<std::size_t>(j)].gather(step.term(j), step.term(j) + rates_.modes());
  for (int c = 0; c < rates_.contacts().count; ++c)
    follow(step, c, best);
  return best;
}

void ContactEvents::follow(const DormandPrince& step, int c, std::optional<ContactEvent>& best) {
  const Regime regime = rates_.regime(c);
  double from = 0.0;
  for (const double to : looks) {
    if (best && best->share <= from)
      return;
    const Margins now = margins(step, c, to);
    const bool normal = (now.normal > 0.0) != regime.closed;
    const bool friction = regime.closed && (now.friction > 0.0) != regime.slides;
    for (const bool kind : {false, true})
      if (kind ? friction : normal)
        if (const ContactEvent event = zero(step, c, kind, from, to); !best || event.share < best->share)
          best = event;
    if (normal || friction)
      return;
    from = to;
  }
}

Margins ContactEvents::margins(const DormandPrince& step, int c, double share) {
  const auto factors = DormandPrince::factors(share);
  const PackedContacts& contacts = rates_.contacts();
  for (int k = 0; k < contacts.components; ++k) {
    const int lane = k * contacts.width + c;
    probe_.u[lane] = probe_.w[lane] = 0.0;
    for (std::size_t j = 0; j < terms_.size(); ++j) {
      probe_.u[lane] += factors[j] * terms_[j].u[lane];
      probe_.w[lane] += factors[j] * terms_[j].w[lane];
    }
  }
  rates_.carry(start_ + share * h_, c, probe_);
  contact::Vec2 spring;
  for (int j = 0; j < DormandPrince::terms; ++j)
    spring = spring + factors[static_cast<std::size_t>(j)] * rates_.spring(step.term(j), c);
  return rates_.margin(c, probe_, spring);
}

/// The far end of the bracket of the zero, so that the regime behind it has begun; `from` where it has been passed already.
ContactEvent ContactEvents::zero(const DormandPrince& step, int c, bool friction, double from, double to) {
  double a = from, b = to;
  double fa = of(margins(step, c, a), friction), fb = of(margins(step, c, b), friction);
  contact::ContactAxes face = probe_.locate(c).axes(); // at b
  if ((fa > 0.0) == (fb > 0.0))
    return {from, c, friction, face};
  double weight_a = fa, weight_b = fb;
  for (int i = 0; i < most_iterations && b - a > instant_round_off; ++i) {
    double x = i % 3 == 2 ? 0.5 * (a + b) : b - weight_b * (b - a) / (weight_b - weight_a);
    if (!(x > a && x < b))
      x = 0.5 * (a + b);
    const double fx = of(margins(step, c, x), friction);
    if (fx == 0.0)
      return {x, c, friction, face};
    if ((fx > 0.0) == (fb > 0.0)) {
      b = x;
      face = probe_.locate(c).axes();
      weight_b = fx;
      weight_a *= 0.5;
    } else {
      a = x;
      weight_a = fx;
      weight_b *= 0.5;
    }
  }
  return {b, c, friction, face};
}

void ContactEvents::apply(const ContactEvent& event, MotionRates& rates, const double* y) {
  const int c = event.contact;
  const Regime regime = rates.regime(c);
  if (event.friction) {
    rates.set_regime(c, regime.closed, !regime.slides);
  } else if (regime.closed) {
    rates.set_regime(c, false, false);
  } else {
    rates.close(c, event.face);
    rates.set_regime(c, true, rates.margin(c, rates.motion(), rates.spring(y, c)).friction > 0.0);
  }
}

} // namespace fretwork::transient
