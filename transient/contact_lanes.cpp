// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contact_lanes.hpp"
#include "transient/vector_lanes.hpp"

namespace fretwork::transient::kernels {
namespace {

// Flags are packs of 1 and 0, and choices are made by one comparison each: compilers turn these into a vector operation, and masks that
// are joined into many scalar ones.
FRETWORK_INLINE Pack clipped(const Pack& p) { return p > 0.0 ? p : Pack{}; }
FRETWORK_INLINE Pack with_sign_of(const Pack& sign, const Pack& size) { return sign < 0.0 ? -size : size; }
/// 1 where the surface is not the opposite face, which is another one.
FRETWORK_INLINE Pack same_face(const MemoryLanes& m, int i, const Pack& ny, const Pack& nz) {
  return at(&m.normal_y[i]) * ny + at(&m.normal_z[i]) * nz < 0.0 ? Pack{} : Pack{} + 1.0;
}

} // namespace

LawLanes::LawLanes(const PackedContacts& contacts, double step) {
  for (Array* a : {&stiffness, &damping, &dissipation, &yy, &yz, &zz, &tangential, &compliance, &gradient,
                   &relaxation, &mu_static, &mu_dynamic, &along})
    a->assign(static_cast<std::size_t>(contacts.width), 0.0);
  for (int c = 0; c < contacts.count; ++c) {
    const contact::Support& support = contacts.supports[c];
    stiffness[c] = support.normal.stiffness;
    damping[c] = support.normal.damping;
    dissipation[c] = support.normal.stiffness * support.normal.dissipation;
    yy[c] = 0.5 * step * contacts.own_mobility(c, 0, 0);
    yz[c] = 0.5 * step * contacts.own_mobility(c, 0, 1);
    zz[c] = 0.5 * step * contacts.own_mobility(c, 1, 1);
    const contact::FrictionLaw& friction = support.friction;
    if (!friction.active())
      continue;
    const auto table = contact::friction_table(friction, step);
    along[c] = friction.along.t;
    tangential[c] = friction.stiffness;
    compliance[c] = table.compliance;
    gradient[c] = friction.along.t * table.gradient;
    relaxation[c] = table.relaxation;
    mu_static[c] = friction.mu_static;
    mu_dynamic[c] = friction.mu_dynamic;
  }
}

StepLanes::StepLanes(int width) {
  for (Array* a : {&shut, &spring, &damping, &share, &nn, &nt, &tt, &bound, &share_t, &tangential,
                   &per_normal, &per_friction, &normal, &friction, &slides, &before_n, &before_t, &v_n, &v_t})
    a->assign(static_cast<std::size_t>(width), 0.0);
}

CommitLanes::CommitLanes(int width) {
  for (Array* a :
       {&closed, &normal_y, &normal_z, &force, &displacement, &slides, &friction_work, &damper_work})
    a->assign(static_cast<std::size_t>(width), 0.0);
}

FRETWORK_WIDTHS double prepare(int width, const LawLanes& law, const MemoryLanes& memory, const double* gap,
                               const double* ny, const double* nz, const double* wy, const double* wz,
                               double half_window, StepLanes& s) {
  const Pack one = Pack{} + 1.0;
  Pack energy{};
  for (int i = 0; i < width; i += lanes) {
    const Pack g = at(gap + i), my = at(ny + i), mz = at(nz + i), y = at(wy + i), z = at(wz + i);
    const Pack k = at(&law.stiffness[i]), p = clipped(-g);
    energy += k * p * p;
    const Pack v_n = my * y + mz * z, v_t = mz * y - my * z;
    // the mean of the penetration over the window, its open part counted as 0
    const Pack reach = half_window * magnitude(v_n), low = -g - reach, high = reach - g;
    const Pack part = 0.5 * high * high / (high > low ? high - low : one);
    const Pack mean = low > 0.0 ? 0.5 * (low + high) : high > 0.0 ? part : Pack{};
    const Pack spring = k * mean, damping = at(&law.damping[i]) + at(&law.dissipation[i]) * mean;
    const Pack yy = at(&law.yy[i]), yz = at(&law.yz[i]), zz = at(&law.zz[i]);
    const Pack by_n_y = my * yy + mz * yz, by_n_z = my * yz + mz * zz; // of y and z by a force along n
    const Pack by_t_y = mz * yy - my * yz, by_t_z = mz * yz - my * zz; // along t
    const Pack nn = my * by_n_y + mz * by_n_z, tt = mz * by_t_y - my * by_t_z;
    const Pack share = 1.0 / (1.0 + damping * nn);
    const Pack normal = mean > 0.0 ? clipped(spring - damping * v_n) * share : Pack{};
    const Pack keeps = same_face(memory, i, my, mz);
    const Pack mu = at(&law.mu_dynamic[i]), most = mu * normal;
    const Pack last = at(&memory.left[i]) == 1.0 ? keeps * at(&memory.force[i]) : Pack{};
    const Pack per_normal = mean > 0.0 ? 1.0 / (mean > 0.0 ? spring : one) : Pack{};
    const Pack mu_static = at(&law.mu_static[i]);
    at(&s.shut[i]) = mean > 0.0 ? one : Pack{};
    at(&s.spring[i]) = spring;
    at(&s.damping[i]) = damping;
    at(&s.share[i]) = mean > 0.0 ? share : Pack{};
    at(&s.nn[i]) = nn;
    at(&s.nt[i]) = mz * by_n_y - my * by_n_z;
    at(&s.tt[i]) = tt;
    at(&s.tangential[i]) = keeps * at(&memory.spring[i]);
    at(&s.bound[i]) = keeps * at(&memory.sliding[i]) > 0.0 ? mu : mu_static;
    at(&s.share_t[i]) = mu_static > 0.0 ? 1.0 / (1.0 + at(&law.gradient[i]) * tt) : Pack{};
    at(&s.per_normal[i]) = per_normal;
    at(&s.per_friction[i]) = mu_static > 0.0 ? per_normal / (mu_static > 0.0 ? mu_static : one) : Pack{};
    at(&s.normal[i]) = normal;
    at(&s.friction[i]) = magnitude(last) > most ? with_sign_of(last, most) : last;
    at(&s.before_n[i]) = at(&s.v_n[i]) = v_n;
    at(&s.before_t[i]) = at(&s.v_t[i]) = v_t;
  }
  return 0.5 * sum(energy);
}

FRETWORK_WIDTHS double improve(int width, const LawLanes& law, StepLanes& s, double* by_n, double* by_t) {
  const Pack one = Pack{} + 1.0;
  Pack worst{};
  for (int i = 0; i < width; i += lanes) {
    const Pack n0 = at(&s.normal[i]), t0 = at(&s.friction[i]);
    const Pack rate = at(&s.nn[i]) * n0 - at(&s.v_n[i]); // without this contact's normal force
    const Pack n = clipped(at(&s.spring[i]) + at(&s.damping[i]) * rate) * at(&s.share[i]); // 0 if not shut
    const Pack dn = n - n0;
    const Pack free = at(&s.v_t[i]) + at(&s.nt[i]) * dn - at(&s.tt[i]) * t0;
    const Pack stick = (at(&s.tangential[i]) - at(&law.gradient[i]) * free) * at(&s.share_t[i]);
    const Pack most = at(&law.mu_dynamic[i]) * n;
    const Pack slides = magnitude(stick) > at(&s.bound[i]) * n ? one : Pack{};
    const Pack t = slides > 0.0 ? with_sign_of(stick, most) : stick;
    const Pack dt = t - t0;
    at(by_n + i) = dn;
    at(by_t + i) = dt;
    at(&s.normal[i]) = n;
    at(&s.friction[i]) = t;
    at(&s.slides[i]) = slides;
    const Pack change_n = at(&s.per_normal[i]) * magnitude(dn),
               change_t = at(&s.per_friction[i]) * magnitude(dt);
    worst = worst > change_n ? worst : change_n;
    worst = worst > change_t ? worst : change_t;
  }
  return largest(worst);
}

FRETWORK_WIDTHS void answer(int width, int count, const int* contacts, const double* a, const double* by_n,
                            const double* by_t, double* v_n, double* v_t) {
  for (int i = 0; i < width; i += lanes) {
    Pack n = at(v_n + i), t = at(v_t + i);
    for (int k = 0; k < count; ++k) {
      const double* block = a + static_cast<std::ptrdiff_t>(k) * 4 * width + i;
      const double fn = by_n[contacts[k]], ft = by_t[contacts[k]];
      n += fn * at(block) + ft * at(block + 2 * width);
      t += fn * at(block + width) + ft * at(block + 3 * width);
    }
    at(v_n + i) = n;
    at(v_t + i) = t;
  }
}

FRETWORK_WIDTHS CommitSums commit(int width, const LawLanes& law, CommitLanes& s, MemoryLanes& m) {
  const Pack one = Pack{} + 1.0;
  Pack sliders{}, damping{}, stored{}, left{};
  for (int i = 0; i < width; i += lanes) {
    const Pack my = at(&s.normal_y[i]), mz = at(&s.normal_z[i]), half = 0.5 * at(&law.compliance[i]);
    const Pack compliance = at(&law.compliance[i]), e = at(&law.relaxation[i]);
    const Pack closed = at(&law.mu_static[i]) > 0.0 ? at(&s.closed[i]) : Pack{}, open = one - closed;
    const Pack held = at(&m.spring[i]), held_energy = half * held * held;
    // closed: the slider takes what the spring and damper do not, unless it would move with the force
    const Pack before = same_face(m, i, my, mz) * held, before_energy = half * before * before;
    const Pack force = at(&s.force[i]), dx = at(&law.along[i]) * at(&s.displacement[i]);
    const Pack relaxed = force + e * (before - force), relaxed_stretch = compliance * (before - relaxed);
    const Pack against = force * (dx - relaxed_stretch) < 0.0 ? one : Pack{};
    const Pack slips = at(&s.slides[i]) * (against + (force == 0.0 ? one : Pack{}));
    const Pack after_closed = slips > 0.0 ? relaxed : before - at(&law.tangential[i]) * dx;
    const Pack stretch = slips > 0.0 ? relaxed_stretch : dx;
    const Pack slider = closed * -force * (dx - stretch);
    const Pack damper = closed * (-force * stretch - (half * after_closed * after_closed - before_energy));
    // open: the spring dies out and is forgotten
    const Pack fading = at(&m.left[i]) * e, faded = fading < forgotten ? Pack{} : fading;
    const Pack after_open = faded > 0.0 ? e * held : Pack{};
    const Pack after = closed > 0.0 ? after_closed : after_open, after_energy = half * after * after;
    sliders += slider;
    damping += damper + closed * (held_energy - before_energy) + open * (held_energy - after_energy);
    stored += after_energy - held_energy;
    at(&s.friction_work[i]) = slider;
    at(&s.damper_work[i]) = damper;
    at(&m.spring[i]) = after;
    at(&m.sliding[i]) = closed * at(&s.slides[i]);
    at(&m.force[i]) = closed * force;
    at(&m.normal_y[i]) = closed > 0.0 ? my : at(&m.normal_y[i]);
    at(&m.normal_z[i]) = closed > 0.0 ? mz : at(&m.normal_z[i]);
    const Pack share = closed > 0.0 ? one : faded;
    at(&m.left[i]) = share;
    left += share;
  }
  return {sum(sliders), sum(damping), sum(stored), sum(left) > 0.0};
}

} // namespace fretwork::transient::kernels
