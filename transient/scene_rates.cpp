// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/scene_rates.hpp"
#include "core/symmetric.hpp"
#include "signals/record.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fretwork::transient {
namespace {

/// A table whose points are closer than this share of the run does not rule the step: its mean over steps is taken.
constexpr double finest_table = 1e-6;

/// Of the fastest contact by itself: the frequency of one that a step of w_c h = 3 at that resolves to 1.5, whatever the structure does.
constexpr double slow_beside_fastest = 0.5;

/// A row of a contact times the root of its weight.
struct WeightedRow {
  const ContactPoint* point;
  int along;
  double root_weight;
};

/// Largest eigenvalue of D B B^T D, B the rows, D the square roots of their weights: that of the smaller of the two products.
double largest_of_dense(const std::vector<WeightedRow>& rows, Eigen::Index modes) {
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), modes);
  for (Eigen::Index i = 0; i < b.rows(); ++i) {
    const auto& [point, along, root] = rows[static_cast<std::size_t>(i)];
    point->for_ranges([&, along = along, root = root](Eigen::Index first, const auto& part) {
      b.row(i).segment(first, part.cols()) = root * part.row(along);
    });
  }
  const Eigen::MatrixXd product =
      b.rows() <= b.cols() ? Eigen::MatrixXd(b * b.transpose()) : Eigen::MatrixXd(b.transpose() * b);
  return std::max(0.0, core::symmetric_eigenvalues(product).maxCoeff());
}

/// The same of rows over the modes of some structures each: by the Lanczos iteration (G. Golub, C. Van Loan, Matrix Computations, 4th edition,
/// section 10.1), which takes the rows' own columns alone. Eigenvalues that it finds again for want of orthogonality are no larger ones.
double largest_by_lanczos(const std::vector<WeightedRow>& rows, Eigen::Index modes) {
  constexpr int most = 400, looks = 10;
  constexpr double converged = 1e-13; // change of the value in so many iterations
  const auto count = static_cast<Eigen::Index>(rows.size());
  Eigen::VectorXd on_modes(modes), last = Eigen::VectorXd::Zero(count), next(count), now(count);
  for (Eigen::Index i = 0; i < count; ++i)
    now(i) = 1.0 + 0.5 * std::sin(static_cast<double>(i)); // no eigenvector is orthogonal to it but by chance
  now.normalize();
  Eigen::MatrixXd tridiagonal = Eigen::MatrixXd::Zero(most, most);
  double largest = 0.0;
  for (int k = 0; k < most; ++k) {
    on_modes.setZero();
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto& [point, along, root] = rows[static_cast<std::size_t>(i)];
      point->for_ranges([&, along = along, root = root](Eigen::Index first, const auto& part) {
        on_modes.segment(first, part.cols()) += root * now(i) * part.row(along).transpose();
      });
    }
    next.setZero();
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto& [point, along, root] = rows[static_cast<std::size_t>(i)];
      point->for_ranges([&, along = along, root = root](Eigen::Index first, const auto& part) {
        next(i) += root * part.row(along).dot(on_modes.segment(first, part.cols()));
      });
    }
    const double diagonal = now.dot(next);
    tridiagonal(k, k) = diagonal;
    next -= diagonal * now;
    if (k > 0)
      next -= tridiagonal(k, k - 1) * last;
    const double beside = next.norm();
    const bool ends = !(beside > 1e-14 * std::abs(diagonal)) || k + 1 == most || k + 1 == count;
    if (ends || k % looks == looks - 1) {
      const double before = largest;
      largest = core::symmetric_eigenvalues(tridiagonal.topLeftCorner(k + 1, k + 1)).maxCoeff();
      if (ends || largest - before <= converged * largest)
        break;
    }
    tridiagonal(k, k + 1) = tridiagonal(k + 1, k) = beside;
    last = now;
    now = next / beside;
  }
  return std::max(0.0, largest);
}

/// Of the rows of contacts along `directions`, the largest eigenvalue.
template <class Weight, class Directions>
double largest_of(const Scene& scene, Weight weight, Directions directions) {
  std::vector<WeightedRow> rows;
  for (const ContactPoint& point : scene.contacts) {
    const double w = weight(point);
    const std::array<bool, 3> along = directions(point.support);
    for (int k = 0; k < 3; ++k)
      if (along[static_cast<std::size_t>(k)] && w > 0.0)
        rows.push_back({&point, k, std::sqrt(w)});
  }
  if (rows.empty())
    return 0.0;
  const bool by_structure = std::all_of(scene.contacts.begin(), scene.contacts.end(),
                                        [](const ContactPoint& point) { return !point.modes.empty(); });
  return (by_structure ? largest_by_lanczos : largest_of_dense)(rows, scene.system.size());
}

std::array<bool, 3> normal_rows(const contact::Support& support) {
  const auto [y, z] = contact::normal_directions(support.obstacle);
  return {false, y, z};
}

std::array<bool, 3> friction_rows(const contact::Support& support) {
  return contact::friction_directions(support.obstacle, support.friction.along);
}

/// What a contact has along one direction by itself.
struct OwnRates {
  double contact; ///< rad2/s2, of its stiffness
  double
      structure; ///< rad2/s2, mean of the squares of the modes' frequencies by their shares of its mobility
};

template <class Weight, class Directions>
void add_own_rates(const Scene& scene, Weight weight, Directions directions, std::vector<OwnRates>& out) {
  for (const ContactPoint& point : scene.contacts) {
    const std::array<bool, 3> along = directions(point.support);
    for (int k = 0; k < 3; ++k) {
      if (!along[static_cast<std::size_t>(k)])
        continue;
      double mobility = 0.0, held = 0.0;
      point.for_ranges([&](Eigen::Index first, const auto& part) {
        mobility += part.row(k).squaredNorm();
        held += part.row(k).cwiseAbs2().dot(scene.system.stiffness.segment(first, part.cols()));
      });
      if (weight(point) * mobility > 0.0)
        out.push_back({weight(point) * mobility, held / mobility});
    }
  }
}

/// SceneRates::structure_frequency.
double structure_frequency(const std::vector<OwnRates>& rates) {
  double fastest = 0.0, largest = 0.0;
  for (const OwnRates& own : rates)
    fastest = std::max(fastest, own.contact);
  for (const OwnRates& own : rates)
    if (own.contact >= slow_beside_fastest * slow_beside_fastest * fastest)
      largest = std::max(largest, own.structure);
  return std::sqrt(largest);
}

/// Largest rate of the structure's own damping, 1/s.
double structure_rate(const vibration::System& system) {
  if (system.size() == 0)
    return 0.0;
  if (system.damping_matrix.size() == 0)
    return system.damping.maxCoeff();
  return core::symmetric_eigenvalues(system.damping_matrix).maxCoeff();
}

/// Penetration of a contact at t = 0, m, 0 where it is open.
double initial_overlap(const Scene& scene, const ContactPoint& point) {
  return std::max(0.0, -scene.location_at_start(point).gap);
}

/// Whether a load has to do with the scene: it moves its modes, or may be that of a motion that carries its
/// obstacles.
bool acts(const vibration::Load& load, const Scene& scene) {
  return !load.modal_force.isZero(0.0) ||
         std::any_of(scene.contacts.begin(), scene.contacts.end(),
                     [](const ContactPoint& contact) { return contact.imposed.size() > 0; });
}

/// Shortest interval between the points of a table, s, those left out that are too fine to rule; infinite without any.
double shortest_interval(const signals::Table& table, double duration) {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < table.time.size(); ++i)
    if (const double interval = table.time[i] - table.time[i - 1]; interval > finest_table * duration)
      shortest = std::min(shortest, interval);
  return shortest;
}

void add_tables(const Scene& scene, SceneRates& out) {
  const double highest = std::max({out.highest_mode, out.contact_frequency, out.stick_frequency});
  const auto shorten = [](double& interval, double other) {
    if (std::isfinite(other) && (interval == 0.0 || other < interval))
      interval = other;
  };
  for (const vibration::Load& load : scene.loads) {
    const auto* table = std::get_if<signals::Table>(&load.function);
    if (!table || !acts(load, scene))
      continue;
    if (!(highest > 0.0 && signals::is_record(*table))) {
      shorten(out.table_interval, shortest_interval(*table, scene.duration));
      continue;
    }
    out.record_rate = std::max(out.record_rate, signals::rate_of_record(*table, highest, scene.duration));
    shorten(out.record_interval, signals::mean_interval(*table));
  }
}

} // namespace

SceneRates rates_of(const Scene& scene) {
  const auto stiffness_n = [](const ContactPoint& point) { return point.support.normal.stiffness; };
  const auto stiffness_t = [](const ContactPoint& point) {
    return point.support.friction.active() ? point.support.friction.stiffness : 0.0;
  };
  const auto damping_t = [](const ContactPoint& point) {
    return point.support.friction.active() ? point.support.friction.damping : 0.0;
  };
  SceneRates out;
  out.contact_frequency = std::sqrt(largest_of(scene, stiffness_n, normal_rows));
  out.stick_frequency = std::sqrt(largest_of(scene, stiffness_t, friction_rows));
  std::vector<OwnRates> own;
  add_own_rates(scene, stiffness_n, normal_rows, own);
  add_own_rates(scene, stiffness_t, friction_rows, own);
  out.structure_frequency = structure_frequency(own);
  out.damper_rate = largest_of(scene, damping_t, friction_rows);
  out.normal_damper_rate = largest_of(
      scene, [](const ContactPoint& point) { return point.support.normal.damping; }, normal_rows);
  out.hunt_crossley =
      std::any_of(scene.contacts.begin(), scene.contacts.end(),
                  [](const ContactPoint& point) { return point.support.normal.dissipation > 0.0; });
  if (scene.system.size() > 0)
    out.highest_mode = std::sqrt(scene.system.stiffness.maxCoeff());
  for (const vibration::Load& load : scene.loads)
    if (acts(load, scene)) {
      const double highest = signals::highest_frequency(load.function);
      out.excitation = std::max(out.excitation, highest);
      if (std::holds_alternative<signals::Integral>(load.function))
        out.sampled_excitation = std::max(out.sampled_excitation, highest);
    }
  for (const signals::SampledLoad& load : scene.sampled_loads)
    if (load.acts()) {
      out.excitation = std::max(out.excitation, load.highest);
      out.sampled_excitation = std::max(out.sampled_excitation, load.highest);
    }
  add_tables(scene, out);
  return out;
}

double explicit_damper_rate(const Scene& scene) {
  const auto damping_n = [&scene](const ContactPoint& point) {
    return point.support.normal.damping_at(initial_overlap(scene, point));
  };
  return std::max(structure_rate(scene.system), largest_of(scene, damping_n, normal_rows));
}

double relaxation_rate(const Scene& scene) {
  double rate = 0.0;
  for (const ContactPoint& point : scene.contacts)
    if (const auto& law = point.support.friction;
        law.active() && law.kind == contact::FrictionMemoryKind::return_map && law.damping > 0.0)
      rate = std::max(rate, law.stiffness / law.damping);
  return rate;
}

} // namespace fretwork::transient
