// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/largest_impact.hpp"
#include <algorithm>
#include <array>
#include <cmath>

namespace fretwork::post {
namespace {

/// Of a step: pieces of force with less between them are one contact.
constexpr double together = 1e-6;

/// Shares of a piece at which its history has points before the end, so that straight lines between them have its impulse; the nearest to the largest
/// force, if that is inside, is moved there.
std::array<double, 3> inner_points(const contact::ParabolicForce& force) {
  std::array<double, 3> out{0.25, 0.5, 0.75};
  const double slope = force.slope(), falls = 12.0 * force.bow();
  if (slope > 0.0 && slope < falls)
    *std::min_element(out.begin(), out.end(), [top = slope / falls](double a, double b) {
      return std::abs(a - top) < std::abs(b - top);
    }) = slope / falls;
  return out;
}

} // namespace

LargestImpact::LargestImpact(std::size_t contacts, double from) : from_(from), contacts_(contacts) {
  for (Contact& contact : contacts_) {
    contact.ring.resize(points);
    contact.kept.reserve(points);
  }
}

void LargestImpact::Contact::keep() {
  const std::size_t held = std::min<std::uint64_t>(count, points);
  kept.resize(held);
  for (std::size_t i = 0; i < held; ++i)
    kept[i] = ring[(count - held + i) % points];
}

void LargestImpact::Contact::add(const ForcePoint& point) {
  ring[count++ % points] = point;
  if (still > 0 && --still == 0)
    keep();
}

void LargestImpact::Contact::add(const transient::ForcePiece& piece, double start, double step,
                                 bool touched) {
  const contact::ParabolicForce &normal = piece.normal, &friction = piece.friction;
  const double from = std::max(ended, start + piece.from * step), to = start + piece.to * step;
  const bool goes_on = closed && from - ended < together * step;
  if (closed && !goes_on) // it has opened within the step
    add({ended, 0.0, 0.0});
  if (!goes_on) {
    if (touched)
      add({from, 0.0, 0.0});
    if (normal.first > 0.0) // of a damper, or in the first step of the window
      add({from, normal.first, friction.first});
  }
  if (goes_on && normal.first == normal.largest()) // it jumps up
    add({from, normal.first, friction.first});
  for (const double at : inner_points(normal))
    add({from + at * (to - from), normal.at(at), piece.friction_at(at)});
  look_at(normal.largest());
  add({to, normal.last, friction.last});
  closed = true;
  ended = to;
}

/// N: of the points added last.
void LargestImpact::Contact::look_at(double peak) {
  if (!(peak > largest))
    return;
  largest = peak;
  still = points / 2;
}

void LargestImpact::step(const transient::Record& record) {
  if (record.time < from_)
    return;
  const double start = record.time - 0.5 * record.step, end = record.time + 0.5 * record.step;
  for (const transient::ForcePiece& piece : record.pieces)
    contacts_[static_cast<std::size_t>(piece.contact)].add(
        piece, start, record.step, record.states[static_cast<std::size_t>(piece.contact)].touches > 0);
  for (const int c : record.active) {
    const transient::ContactState& state = record.states[static_cast<std::size_t>(c)];
    Contact& contact = contacts_[static_cast<std::size_t>(c)];
    if (record.pieces.empty()) {
      if (!contact.closed)
        contact.add({start, 0.0, 0.0});
      contact.closed = true;
      contact.add({record.time, state.normal_force, norm(state.friction)});
      contact.ended = end;
      contact.look_at(state.peak);
    }
  }
  for (const int c : record.opened) {
    const transient::ContactState& state = record.states[static_cast<std::size_t>(c)];
    Contact& contact = contacts_[static_cast<std::size_t>(c)];
    if (state.touches > 0 && state.opened_at < state.closed_at)
      continue; // it closed again
    if (contact.closed)
      contact.add({contact.ended, 0.0, 0.0});
    contact.closed = false;
  }
}

std::vector<std::vector<ForcePoint>> LargestImpact::histories() const {
  std::vector<std::vector<ForcePoint>> out;
  for (Contact contact : contacts_) {
    if (contact.still > 0)
      contact.keep();
    out.push_back(std::move(contact.kept));
  }
  return out;
}

} // namespace fretwork::post
