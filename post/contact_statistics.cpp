// SPDX-License-Identifier: GPL-3.0-or-later
#include "post/contact_statistics.hpp"
#include "kernels/vector_lanes.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace fretwork::post {
namespace {

using namespace kernels;

/// Sums of a contact whose batches are kept: row of BatchEnds, contact after contact. Those of y and z are about their first values.
enum Kept : std::size_t {
  impacts,
  slid,
  friction,
  normal1,
  normal2,
  y1,
  y2,
  z1,
  z2,
  contact_time,
  slid_at,
  contact_sums = slid_at + contact::most_sides
};

// No array overlaps another: the compiler takes as many contacts at once as a vector has numbers.

template <class>
FRETWORK_INLINE void watch_coordinate_on(std::size_t n, double h, const double* __restrict u,
                                         const double* __restrict about, double* __restrict sum,
                                         double* __restrict square) {
  for (std::size_t c = 0; c < n; ++c) {
    const double d = u[c] - about[c];
    sum[c] += h * d;
    square[c] += h * d * d;
  }
}
FRETWORK_KERNEL(void, watch_coordinate,
                (std::size_t n, double h, const double* u, const double* about, double* sum, double* square),
                (n, h, u, about, sum, square))

template <class>
FRETWORK_INLINE void watch_radius_on(std::size_t n, double h, const double* __restrict y0,
                                     const double* __restrict z0, const double* __restrict uy,
                                     const double* __restrict uz, double* __restrict radius,
                                     double* __restrict sum) {
  for (std::size_t c = 0; c < n; ++c) {
    const double y = y0[c] + uy[c], z = z0[c] + uz[c];
    const double r2 = y * y + z * z;
    radius[c] = std::sqrt(r2);
    sum[c] += h * r2;
  }
}
FRETWORK_KERNEL(void, watch_radius,
                (std::size_t n, double h, const double* y0, const double* z0, const double* uy,
                 const double* uz, double* radius, double* sum),
                (n, h, y0, z0, uy, uz, radius, sum))

} // namespace

ContactStatistics::ContactStatistics(const std::vector<transient::ContactPoint>& contacts, double from)
    : from_(from), sums_(contacts.size()), motion_(contacts.size()), ends_(contact_sums * contacts.size()),
      maxima_(contacts.size()) {
  for (const transient::ContactPoint& contact : contacts) {
    supports_.push_back(contact.support);
    side_of_.emplace_back(contact.support.obstacle);
    rest_y_.push_back(contact.rest.y());
    rest_z_.push_back(contact.rest.z());
  }
}

void ContactStatistics::step(const transient::Record& record) {
  const bool inside = record.time >= from_;
  for (const int c : record.active) {
    const transient::ContactState& state = record.states[static_cast<std::size_t>(c)];
    Sums& s = sums_[static_cast<std::size_t>(c)];
    if (state.touches > 0) { // an impact starts
      s.duration = 0.0;
      s.counted = inside;
      if (inside) {
        s.impacts += state.touches;
        s.speed += state.touches * state.approach;
        s.speed2 += state.touches * state.approach * state.approach;
        s.speed_max = std::max(s.speed_max, state.approach);
      }
    }
    const double closed = state.closed * record.step;
    s.duration += closed;
    if (s.counted) {
      s.impact_time += closed;
      s.longest = std::max(s.longest, s.duration);
    }
    if (inside) {
      const contact::SideFinder& side_of = side_of_[static_cast<std::size_t>(c)];
      s.add(state, record.step, side_of);
      if (state.wear_work > 0.0 && side_of.at_corner(rest_y_[static_cast<std::size_t>(c)] + record.uy[c],
                                                     rest_z_[static_cast<std::size_t>(c)] + record.uz[c]))
        s.slid_at_corners += state.wear_work;
      maxima_.watch(static_cast<std::size_t>(c), state.peak);
      watch_penetration(record, static_cast<std::size_t>(c));
    }
  }
  for (const int c : record.opened) {
    Sums& s = sums_[static_cast<std::size_t>(c)];
    if (!s.counted)
      continue;
    const double speed = record.states[static_cast<std::size_t>(c)].departure;
    s.leaving_max = s.departures == 0 ? speed : std::max(s.leaving_max, speed);
    s.leaving += speed;
    ++s.departures;
  }
  if (!inside)
    return;
  watch_motion(record);
  time_ += record.step;
  ends_.watch(time_, [this](double* row) {
    write_sums(row);
    maxima_.end_batch();
  });
}

void ContactStatistics::Sums::add(const transient::ContactState& state, double step,
                                  const contact::SideFinder& side_of) {
  closed_time += state.closed * step;
  impulse += state.normal_force * step;
  normal2 += state.normal_square * step;
  normal_max = std::max(normal_max, state.peak);
  tangential2 += state.friction_square * step;
  tangential_max = std::max({tangential_max, norm(state.friction), state.friction_peak});
  slid += state.wear_work;
  if (state.wear_work > 0.0)
    slid_at[side_of(state.axes)] += state.wear_work;
  distance += state.slid;
  sliding_time += state.sliding * step;
  friction += state.friction_work;
  damping += state.damper_work;
}

void ContactStatistics::watch_motion(const transient::Record& record) {
  const std::size_t n = sums_.size();
  const double h = record.step;
  Motion& m = motion_;
  if (!(time_ > 0.0)) // the first of the window
    for (std::size_t c = 0; c < n; ++c) {
      m.y0[c] = record.uy[c];
      m.z0[c] = record.uz[c];
    }
  watch_coordinate(n, h, record.uy, m.y0.data(), m.y.data(), m.y2.data());
  watch_coordinate(n, h, record.uz, m.z0.data(), m.z.data(), m.z2.data());
  watch_radius(n, h, rest_y_.data(), rest_z_.data(), record.uy, record.uz, m.radius.data(), m.r2.data());
  m.of_y.watch(record.uy, record.time);
  m.of_z.watch(record.uz, record.time);
  m.of_radius.watch(m.radius.data(), record.time);
}

void ContactStatistics::watch_penetration(const transient::Record& record, std::size_t contact) {
  const contact::Support& support = supports_[contact];
  if (!support.normal.damps())
    return; // the force has it
  const double gap = contact::locate(support.obstacle, rest_y_[contact] + record.uy[contact],
                                     rest_z_[contact] + record.uz[contact])
                         .gap;
  sums_[contact].deepest = std::max({sums_[contact].deepest, -gap, record.states[contact].deepest});
}

void ContactStatistics::write_sums(double* row) const {
  for (std::size_t c = 0; c < sums_.size(); ++c, row += contact_sums) {
    const Sums& s = sums_[c];
    row[impacts] = static_cast<double>(s.impacts);
    row[slid] = s.slid;
    row[friction] = s.friction;
    row[normal1] = s.impulse;
    row[normal2] = s.normal2;
    row[y1] = motion_.y[c];
    row[y2] = motion_.y2[c];
    row[z1] = motion_.z[c];
    row[z2] = motion_.z2[c];
    row[contact_time] = s.closed_time;
    std::copy(s.slid_at.begin(), s.slid_at.end(), row + slid_at);
  }
}

BatchSums ContactStatistics::batch_sums() const {
  BatchSums out = ends_.batches(time_, [this](double* row) { write_sums(row); });
  for (std::size_t c = 0; c < sums_.size(); ++c)
    if (!slides(c))
      for (const Kept which : {slid, friction})
        std::fill(out.sums[contact_sums * c + which].begin(), out.sums[contact_sums * c + which].end(), 0.0);
  return out;
}

/// Whether a contact slides by more than round-off of its displacement, as one does across a plane motion.
bool ContactStatistics::slides(std::size_t contact) const {
  constexpr double round_off = 1e-9;
  const auto variance = [this](double sum, double squares) {
    return std::max(0.0, squares / time_ - (sum / time_) * (sum / time_));
  };
  const double y = variance(motion_.y[contact], motion_.y2[contact]),
               z = variance(motion_.z[contact], motion_.z2[contact]);
  return sums_[contact].distance > round_off * std::sqrt(y + z);
}

StandardErrors ContactStatistics::errors_of(const BatchSums& batches, std::size_t contact,
                                            const ContactSummary& o) const {
  StandardErrors out;
  out.batches = std::numeric_limits<double>::infinity();
  const auto* sums = batches.sums.data() + contact_sums * contact;
  const auto take = [&](const BatchEstimate& estimate) {
    out.batches = std::min(out.batches, estimate.batches);
    return estimate.error;
  };
  const auto of_mean = [&](Kept which) { return take(batch_means(batches.lengths, sums[which])); };
  const auto of_deviation = [&](Kept first, Kept squares, double shift, double deviation) {
    return take(batch_deviation(batches.lengths, sums[first], sums[squares], shift, deviation));
  };
  out.work_rate = of_mean(slid);
  out.work_rate_batches = out.batches;
  out.friction_power = of_mean(friction);
  out.impact_rate = of_mean(impacts);
  out.contact_time_ratio = of_mean(contact_time);
  out.normal_max = maxima_.error(contact);
  out.normal_mean = of_mean(normal1);
  out.normal_rms = of_deviation(normal2, normal2, 0.0, o.normal_rms); // about 0
  out.y_std = of_deviation(y1, y2, motion_.y[contact] / time_, o.y.std);
  out.z_std = of_deviation(z1, z2, motion_.z[contact] / time_, o.z.std);
  return out;
}

SideWorks ContactStatistics::sides_of(const BatchSums& batches, std::size_t contact) const {
  SideWorks out;
  for (std::size_t side = 0; side < out.size(); ++side) {
    const double work = sums_[contact].slid_at[side];
    if (!(work > 0.0) || !slides(contact))
      continue;
    const BatchEstimate estimate =
        batch_means(batches.lengths, batches.sums[contact_sums * contact + slid_at + side]);
    out[side] = {work / time_, estimate.error, estimate.batches};
  }
  return out;
}

StandardErrors ContactStatistics::errors_of_sums() const {
  StandardErrors out;
  if (!(time_ > 0.0))
    return out;
  const BatchSums batches = batch_sums();
  out.batches = std::numeric_limits<double>::infinity();
  const auto error = [&](Kept which) {
    std::vector<double> sum(batches.lengths.size(), 0.0);
    for (std::size_t c = 0; c < sums_.size(); ++c)
      for (std::size_t b = 0; b < sum.size(); ++b)
        sum[b] += batches.sums[contact_sums * c + which][b];
    const BatchEstimate estimate = batch_means(batches.lengths, sum);
    out.batches = std::min(out.batches, estimate.batches);
    return estimate.error;
  };
  out.work_rate = error(slid);
  out.work_rate_batches = out.batches;
  out.friction_power = error(friction);
  out.impact_rate = error(impacts);
  return out;
}

std::vector<ContactSummary> ContactStatistics::summaries() const {
  std::vector<ContactSummary> out(sums_.size());
  if (!(time_ > 0.0))
    return out;
  const auto moments = [&](double first, double sum, double squares, double low, double high) {
    const double shift = sum / time_;
    return Moments{first + shift, std::sqrt(std::max(0.0, squares / time_ - shift * shift)), low, high};
  };
  const BatchSums batches = batch_sums();
  for (std::size_t c = 0; c < out.size(); ++c) {
    const Sums& s = sums_[c];
    const Motion& m = motion_;
    ContactSummary& o = out[c];
    o.impacts = s.impacts;
    o.contact_time_ratio = s.closed_time / time_;
    o.normal_mean = s.impulse / time_;
    o.normal_rms = std::sqrt(s.normal2 / time_);
    o.normal_max = s.normal_max;
    if (s.closed_time > 0.0) {
      o.normal_in_contact_mean = s.impulse / s.closed_time;
      o.normal_in_contact_rms = std::sqrt(s.normal2 / s.closed_time);
      o.sticking_ratio = 1.0 - s.sliding_time / s.closed_time;
    }
    o.tangential_rms = std::sqrt(s.tangential2 / time_);
    o.tangential_max = s.tangential_max;
    o.y = moments(m.y0[c], m.y[c], m.y2[c], m.of_y.min(c), m.of_y.max(c));
    o.z = moments(m.z0[c], m.z[c], m.z2[c], m.of_z.min(c), m.of_z.max(c));
    o.radial_rms = std::sqrt(m.r2[c] / time_);
    o.radial_max = m.of_radius.max(c);
    const contact::NormalLaw& law = supports_[c].normal;
    o.penetration_max = law.damps() ? s.deepest : s.normal_max / law.stiffness;
    const bool slides = this->slides(c);
    o.work_rate = slides ? s.slid / time_ : 0.0;
    o.corner_work_rate = slides ? s.slid_at_corners / time_ : 0.0;
    o.friction_power = slides ? s.friction / time_ : 0.0;
    o.impulse = s.impulse;
    o.sliding_distance = slides ? s.distance : 0.0;
    o.damping_work = s.damping;
    o.friction_work = slides ? s.friction : 0.0;
    if (s.impacts > 0) {
      o.impact_velocity_mean = s.speed / static_cast<double>(s.impacts);
      o.impact_velocity_rms = std::sqrt(s.speed2 / static_cast<double>(s.impacts));
      o.impact_velocity_max = s.speed_max;
      o.contact_duration_mean = s.impact_time / static_cast<double>(s.impacts);
      o.contact_duration_max = s.longest;
    }
    if (s.departures > 0) {
      o.departure_velocity_mean = s.leaving / static_cast<double>(s.departures);
      o.departure_velocity_max = s.leaving_max;
    }
    o.impact_rate = static_cast<double>(s.impacts) / time_;
    o.error = errors_of(batches, c, o);
    o.sides = sides_of(batches, c);
  }
  return out;
}

} // namespace fretwork::post
