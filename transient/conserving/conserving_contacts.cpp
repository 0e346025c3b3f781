// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/conserving/conserving_contacts.hpp"
#include "transient/conserving/conserving_normal.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace fretwork::transient {
namespace {

/// Of |force| + stiffness |position|: a residual below it is rounding.
constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
/// Where nothing improves any more, this many times the rounding passes.
constexpr double stalled = 64.0;
/// Newton's method takes 3 to 5; more only where contacts with friction catch each other at huge steps.
constexpr int most_iterations = 40;
/// After so many a mean normal that may jump from iteration to iteration is held.
constexpr int hold_after = 12;
constexpr int most_cuts = 10;
/// Share of the predicted fall of the residual that a shortened iteration must reach (Armijo's usual value).
constexpr double least_fall = 1e-4;

/// Gauss elimination with partial pivoting: a x = b, row by row, x in b. False where a is singular.
bool eliminate(std::size_t n, double* a, double* b) {
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(a[i * n + k]) > std::abs(a[pivot * n + k]))
        pivot = i;
    if (!(std::abs(a[pivot * n + k]) > 0.0))
      return false;
    if (pivot != k) {
      std::swap_ranges(a + k * n + k, a + k * n + n, a + pivot * n + k);
      std::swap(b[k], b[pivot]);
    }
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[i * n + k] / a[k * n + k];
      if (factor == 0.0)
        continue;
      for (std::size_t j = k + 1; j < n; ++j)
        a[i * n + j] -= factor * a[k * n + j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j)
      b[k] -= a[k * n + j] * b[j];
    b[k] /= a[k * n + k];
  }
  return true;
}

} // namespace

ConservingContacts::ConservingContacts(const PackedContacts& contacts)
    : contacts_(contacts), size_(static_cast<std::size_t>(contacts.components)), answer_(contacts) {
  const auto count = static_cast<std::size_t>(contacts.count);
  active_.reserve(count);
  parts_.reserve(count);
  response_.resize(count);
  for (std::vector<double>* x : {&force_, &residual_, &step_, &base_})
    x->assign(3 * count, 0.0);
  matrix_.resize(9 * count * count);
}

bool ConservingContacts::solve(double step, const Mobilities& mobilities, const FrictionMemories& memory,
                               ContactMotion& start, ContactMotion& free, ContactTrial& trial) {
  const Setting s{step, mobilities, memory};
  trial.clear();
  active_.clear();
  parts_.clear();
  const bool at_start = start.find_near(0.0), at_end = free.find_near(0.0); // both marks are needed
  if (!at_start && !at_end)
    return true;
  for (int c = 0; c < contacts_.count; ++c)
    if ((start.near(c) && start.locate(c).gap < 0.0) || (free.near(c) && free.locate(c).gap < 0.0))
      activate(c, s, start, free);
  // each pass but the last takes one more contact or breaks one loose
  for (bool again = !active_.empty(); again;) {
    if (!iterate(s))
      return false;
    const bool broken = break_loose(), more = extend_active_set(s, start, free);
    again = broken || more;
  }
  close(start, trial);
  return true;
}

void ConservingContacts::activate(int c, const Setting& s, const ContactMotion& start,
                                  const ContactMotion& free) {
  const contact::Support& support = contacts_.supports[c];
  const int width = contacts_.width;
  const bool in_plane = contacts_.in_plane[c] != 0;
  const std::size_t i = active_.size();
  ActiveContact& active = active_.emplace_back();
  active = {};
  active.contact = c;
  active.in_plane = in_plane;
  active.x0 = {start.u[c] + contacts_.rest_y(c), start.u[width + c] + contacts_.rest_z(c)};
  active.from = start.locate(c);
  active.free[0] = free.u[c] + contacts_.rest_y(c);
  active.free[1] = free.u[width + c] + contacts_.rest_z(c);
  active.free[2] = in_plane ? free.u[2 * width + c] - start.u[2 * width + c] : 0.0;
  const double trace =
      mobility(s, i, 0, i, 0) + mobility(s, i, 1, i, 1) + (in_plane ? mobility(s, i, 2, i, 2) : 0.0);
  const contact::Location face = active.from.gap < 0.0 ? active.from : free.locate(c);
  active.axes = face.axes();
  active.free_rate = free.penetration_rate(c, face.axes());
  active.end_share = 0.0;
  if (support.normal.damping > 0.0)
    active.end_share = end_rate_share(
        support.normal.damping, active.axes.normal(rate_mobility(s, i, i, 0), rate_mobility(s, i, i, 1)));
  active.rho = support.friction.active() && trace > 0.0 ? 1.0 / trace : 0.0;
  active.stiffness = support.normal.stiffness + support.friction.stiffness + active.rho +
                     (support.normal.damping + support.friction.damping) / s.h;
  if (const contact::FrictionLaw& law = support.friction;
      law.active() && law.kind == contact::FrictionMemoryKind::return_map)
    active.slides_at_touch =
        law.slides_at_touch(support.normal.damping * std::max(0.0, start.penetration_rate(c, active.axes)),
                            norm(law.trial(s.memory.at(c, active.axes).spring, start.slip(c, active.axes))));
  for (std::size_t k = 0; k < size_; ++k)
    force_[size_ * i + k] = 0.0;
}

bool ConservingContacts::is_active(int c) const {
  return std::any_of(active_.begin(), active_.end(), [c](const ActiveContact& s) { return s.contact == c; });
}

/// Takes the contacts that the forces found have closed. Returns whether there are any.
bool ConservingContacts::extend_active_set(const Setting& s, const ContactMotion& start,
                                           const ContactMotion& free) {
  if (active_.size() == static_cast<std::size_t>(contacts_.count))
    return false;
  const std::size_t before = active_.size(), stride = answer_.u.size();
  answer_.u = free.u;
  for (std::size_t i = 0; i < before; ++i)
    for (std::size_t b = 0; b < size_; ++b) {
      const double f = force_[size_ * i + b];
      const double* column =
          &s.mobilities.place[(static_cast<std::size_t>(active_[i].contact) * 3 + b) * stride];
      for (std::size_t lane = 0; lane < stride; ++lane)
        answer_.u[lane] += f * column[lane];
    }
  if (!answer_.find_near(0.0))
    return false;
  for (int c = 0; c < contacts_.count; ++c)
    if (answer_.near(c) && !is_active(c) && answer_.locate(c).gap < 0.0)
      activate(c, s, start, free);
  return active_.size() > before;
}

bool ConservingContacts::break_loose() {
  bool any = false;
  for (std::size_t i = 0; i < active_.size(); ++i)
    if (response_[i].breaks)
      any = active_[i].broken = true;
  return any;
}

std::size_t ConservingContacts::place_of(std::size_t i, std::size_t a, std::size_t j, std::size_t b) const {
  const auto stride = static_cast<std::size_t>(contacts_.stride()),
             width = static_cast<std::size_t>(contacts_.width);
  const auto to = static_cast<std::size_t>(active_[i].contact),
             from = static_cast<std::size_t>(active_[j].contact);
  return (from * 3 + b) * stride + a * width + to;
}

double ConservingContacts::mobility(const Setting& s, std::size_t i, std::size_t a, std::size_t j,
                                    std::size_t b) const {
  return s.mobilities.place[place_of(i, a, j, b)];
}

double ConservingContacts::rate_mobility(const Setting& s, std::size_t i, std::size_t j,
                                         std::size_t b) const {
  const auto [y, z] = active_[i].axes;
  return y * s.mobilities.rate[place_of(i, 0, j, b)] + z * s.mobilities.rate[place_of(i, 1, j, b)];
}

/// Newton's method from the forces there are. Returns whether it converged.
bool ConservingContacts::iterate(const Setting& s) {
  double merit = respond(s);
  const std::size_t n = size_ * active_.size();
  for (int k = 0; k < most_iterations; ++k) {
    if (converged(1.0))
      return true;
    if (!direction(s))
      return false;
    std::copy_n(force_.begin(), n, base_.begin());
    double share = 1.0, reached = 0.0;
    for (int cut = 0; cut < most_cuts; ++cut, share *= 0.5) {
      for (std::size_t r = 0; r < n; ++r)
        force_[r] = base_[r] + share * step_[r];
      reached = respond(s);
      if (reached < (1.0 - least_fall * share) * merit)
        break;
    }
    if (!(reached < merit)) {
      std::copy_n(base_.begin(), n, force_.begin());
      (void)respond(s);
      return converged(stalled);
    }
    merit = reached;
    if (k == hold_after)
      for (std::size_t i = 0; i < active_.size(); ++i) {
        ActiveContact& active = active_[i];
        active.is_held = true;
        const Response& r = response_[i];
        active.held = {0.5 * (active.from.ny + r.axes.ny), 0.5 * (active.from.nz + r.axes.nz)};
      }
  }
  return false;
}

/// Residual f - Phi(xf + W f) at the forces there are. Returns its square.
double ConservingContacts::respond(const Setting& s) {
  ++evaluations_;
  double merit = 0.0;
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const ActiveContact& active = active_[i];
    double place[3] = {active.free[0], active.free[1], active.free[2]};
    for (std::size_t j = 0; j < active_.size(); ++j)
      for (std::size_t a = 0; a < size_; ++a)
        for (std::size_t b = 0; b < size_; ++b)
          place[a] += mobility(s, i, a, j, b) * force_[size_ * j + b];
    double rate = active.free_rate;
    if (active.end_share > 0.0)
      for (std::size_t j = 0; j < active_.size(); ++j)
        for (std::size_t b = 0; b < size_; ++b)
          rate -= rate_mobility(s, i, j, b) * force_[size_ * j + b];
    double force[3] = {};
    std::copy_n(&force_[size_ * i], size_, force);
    respond(s, active, place, rate, force, response_[i]);
    for (std::size_t a = 0; a < size_; ++a) {
      const double r = force[a] - response_[i].force[a];
      residual_[size_ * i + a] = r;
      merit += r * r;
    }
  }
  return merit;
}

void ConservingContacts::respond(const Setting& s, const ActiveContact& active, const double* place,
                                 double rate, const double* force, Response& r) const {
  const contact::Support& support = contacts_.supports[active.contact];
  const contact::NormalLaw& law = support.normal;
  const auto g = discrete_gradient(support.obstacle, active.x0, active.from, {place[0], place[1]},
                                   active.is_held ? &active.held : nullptr);
  r = {};
  r.p0 = -active.from.gap;
  r.p1 = -g.gap;
  r.axes = {g.ny, g.nz};
  const double size = std::sqrt(g.y * g.y + g.z * g.z);
  const StepNormal found = step_normal_force(law, active.end_share, r.p0, r.p1, rate, s.h);
  const double normal = found.force;
  r.spring_force = found.spring;
  const double extent = std::abs(active.x0.y) + std::abs(active.x0.z) + std::abs(active.free[0]) +
                        std::abs(active.free[1]) + std::abs(active.free[2]) + std::abs(place[0]) +
                        std::abs(place[1]) + std::abs(place[2]);
  r.rounding = rounding * (std::abs(normal) + active.stiffness * extent);
  if (!(normal > 0.0 && size > 0.0))
    return;
  r.normal_of_gap = normal;
  r.normal = normal * size;
  r.axes = {g.y / size, g.z / size};
  r.force[0] = normal * g.y;
  r.force[1] = normal * g.z;
  const double by_y = -found.by_end * g.ny, by_z = -found.by_end * g.nz; // of the normal force
  r.by_place[0][0] = by_y * g.y + normal * g.yy;
  r.by_place[0][1] = by_z * g.y + normal * g.yz;
  r.by_place[1][0] = by_y * g.z + normal * g.zy;
  r.by_place[1][1] = by_z * g.z + normal * g.zz;
  r.by_rate[0] = found.by_rate * g.y;
  r.by_rate[1] = found.by_rate * g.z;
  if (!support.friction.active())
    return;
  r.closed = {contact::closed_share(r.p0, r.p1), !(r.p0 > 0.0)};
  // of the share by p1, where the step is partly closed
  const double by_p1 = r.closed.share < 1.0 ? std::abs(r.p0) / ((r.p1 - r.p0) * (r.p1 - r.p0)) : 0.0;
  find_friction(
      s, active, place, force,
      {{r.axes.tangent(g.yy, g.zy) / size, r.axes.tangent(g.yz, g.zz) / size},
       {size * by_y + normal * r.axes.normal(g.yy, g.zy), size * by_z + normal * r.axes.normal(g.yz, g.zz)},
       {-by_p1 * g.ny, -by_p1 * g.nz},
       size * found.by_rate},
      r);
}

/// Adds the friction. With n turning by theta, dn = t theta and dt = -n theta.
void ConservingContacts::find_friction(const Setting& s, const ActiveContact& active, const double* place,
                                       const double* force, const Turning& turning, Response& r) const {
  contact::FrictionLaw law = contacts_.supports[active.contact].friction;
  if (!active.in_plane)
    law.along.x = 0.0;
  const double n[2] = {r.axes.ny, r.axes.nz}, t[2] = {r.axes.nz, -r.axes.ny};
  const double d[2] = {place[0] - active.x0.y, place[1] - active.x0.z};
  r.displacement = {law.along.x * place[2], law.along.t * r.axes.tangent(d[0], d[1])};
  const contact::FrictionMemory past = s.memory.at(active.contact, r.axes);
  const bool reference = law.kind == contact::FrictionMemoryKind::reference;
  r.closed.slides_at_touch = r.closed.starts_open && active.slides_at_touch;
  const bool dynamic = active.broken || past.sliding || r.closed.slides_at_touch;
  const StepFriction f = reference && active.broken ? opposing(law, active.rho, r.normal, r.displacement,
                                                               {force[2], r.axes.tangent(force[0], force[1])})
                                                    : along_trial(law, past.spring, law.coefficient(dynamic),
                                                                  r.normal, r.displacement, s.h, r.closed);
  r.friction = f.force;
  r.slides = f.slides;
  r.breaks = f.slides && !active.broken && (reference || (!dynamic && law.mu_static > law.mu_dynamic));
  const double along_n = r.axes.normal(d[0], d[1]), force_n = r.axes.normal(force[0], force[1]);
  r.force[0] += f.force.t * t[0];
  r.force[1] += f.force.t * t[1];
  r.force[2] = f.force.x;
  const double by_rate_t = f.by_normal.t * turning.by_rate;
  r.by_rate[0] += by_rate_t * t[0];
  r.by_rate[1] += by_rate_t * t[1];
  r.by_rate[2] = f.by_normal.x * turning.by_rate;
  for (int k = 0; k < 2; ++k) { // by y, by z
    const double turn = turning.turn[k], moved = t[k] - turn * along_n, given = -turn * force_n;
    const double by_t = f.by_displacement.tt * moved + f.by_normal.t * turning.normal[k] +
                        f.by_share.t * turning.share[k] + f.by_force.tt * given;
    const double by_x = f.by_displacement.xt * moved + f.by_normal.x * turning.normal[k] +
                        f.by_share.x * turning.share[k] + f.by_force.xt * given;
    for (int a = 0; a < 2; ++a) {
      r.by_place[a][k] += by_t * t[a] - f.force.t * turn * n[a];
      r.by_force[a][k] = t[a] * f.by_force.tt * t[k];
    }
    r.by_place[2][k] = by_x;
    r.by_place[k][2] = f.by_displacement.xt * t[k];
    r.by_force[2][k] = r.by_force[k][2] = f.by_force.xt * t[k];
  }
  r.by_place[2][2] = f.by_displacement.xx;
  r.by_force[2][2] = f.by_force.xx;
}

/// Never where a force is no number.
bool ConservingContacts::converged(double slack) const {
  for (std::size_t i = 0; i < active_.size(); ++i)
    for (std::size_t a = 0; a < size_; ++a)
      if (const double r = residual_[size_ * i + a];
          !std::isfinite(r) || !(std::abs(r) <= slack * response_[i].rounding))
        return false;
  return true;
}

/// (I - dPhi/df - dPhi/dx W) step = -residual.
bool ConservingContacts::direction(const Setting& s) {
  const std::size_t n = size_ * active_.size();
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const Response& r = response_[i];
    for (std::size_t j = 0; j < active_.size(); ++j)
      for (std::size_t b = 0; b < size_; ++b) {
        const double moved[3] = {mobility(s, i, 0, j, b), mobility(s, i, 1, j, b),
                                 size_ == 3 ? mobility(s, i, 2, j, b) : 0.0};
        const double rate = active_[i].end_share > 0.0 ? -rate_mobility(s, i, j, b) : 0.0;
        for (std::size_t a = 0; a < size_; ++a) {
          double x =
              -(r.by_place[a][0] * moved[0] + r.by_place[a][1] * moved[1] + r.by_place[a][2] * moved[2]) -
              r.by_rate[a] * rate;
          if (i == j)
            x += (a == b ? 1.0 : 0.0) - r.by_force[a][b];
          matrix_[(size_ * i + a) * n + size_ * j + b] = x;
        }
      }
  }
  for (std::size_t k = 0; k < n; ++k)
    step_[k] = -residual_[k];
  return eliminate(n, matrix_.data(), step_.data());
}

/// Forces found: what the contacts do over the step.
void ConservingContacts::close(const ContactMotion& start, ContactTrial& trial) {
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const Response& r = response_[i];
    const int c = active_[i].contact;
    trial.springs += contacts_.supports[c].normal.spring_energy(r.p1);
    const double loss = (r.normal_of_gap - r.spring_force) * (r.p1 - r.p0);
    if (!(r.normal > 0.0)) {
      trial.cut += loss;
      continue;
    }
    ContactState& state = trial.states[c];
    state.normal_force = r.normal;
    state.axes = r.axes;
    state.friction = r.friction;
    state.displacement = r.displacement;
    state.approach = start.penetration_rate(c, r.axes);
    state.damper_work = loss;
    state.slides = r.slides;
    parts_.push_back({c, r.closed, r.p1});
  }
  std::sort(parts_.begin(), parts_.end(),
            [](const ContactPart& a, const ContactPart& b) { return a.contact < b.contact; });
  for (const ContactPart& part : parts_)
    trial.active.push_back(part.contact);
}

} // namespace fretwork::transient
