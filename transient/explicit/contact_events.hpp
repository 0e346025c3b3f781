// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Where in a step a contact first leaves its regime: closes or opens, starts to slide or sticks. Each contact's margins
/// (MotionRates::margin) are followed along the step's continuous extension, and moving obstacles where they are, at its quarters; where one has the wrong sign, its zero is
/// bracketed and found by regula falsi (Illinois variant) with bisection as a safeguard, to the round-off of the share. An excursion that
/// begins and ends between two quarters goes unseen: it is shorter than h/4, and deeper than a (h/4)^2/8 only at accelerations above a.
#pragma once
#include "transient/explicit/dormand_prince.hpp"
#include "transient/explicit/motion_rates.hpp"
#include <optional>

namespace fretwork::transient {

struct ContactEvent {
  double share; ///< of the step, 0 to 1
  int contact;
  bool friction;               ///< sliding starts or ends; otherwise the contact closes or opens
  contact::ContactAxes face{}; ///< where it closes, just behind the event
};

class ContactEvents {
public:
  explicit ContactEvents(const MotionRates& rates);
  /// The first event of an extended step of length h that starts at `time`. No allocation.
  [[nodiscard]] std::optional<ContactEvent> first(const DormandPrince& step, double time, double h);
  /// Changes the regime of the event's contact, for the state that the rates were evaluated for last.
  static void apply(const ContactEvent& event, MotionRates& rates, const double* y);

private:
  [[nodiscard]] Margins margins(const DormandPrince& step, int c, double share);
  [[nodiscard]] ContactEvent zero(const DormandPrince& step, int c, bool friction, double from, double to);
  void follow(const DormandPrince& step, int c, std::optional<ContactEvent>& best);

  const MotionRates& rates_;
  std::vector<ContactMotion> terms_; ///< contacts' share in each term of the extension
  ContactMotion probe_;
  double start_ = 0.0, h_ = 0.0; ///< s, of the step
};

} // namespace fretwork::transient
