// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/mode_notes.hpp"
#include "modal/canonical.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace fretwork::app {
namespace {

/// Share of a frequency that the mesh may add before the user is told.
constexpr double told_mesh_error = 0.01;

/// Modes that the mesh is too coarse for.
void note_mesh_error(results::RunResults& out) {
  std::size_t coarse = 0, all = 0;
  double lowest = std::numeric_limits<double>::infinity(), worst = 0.0;
  for (const auto& basis : out.bases)
    for (Eigen::Index i = 0; i < basis.size(); ++i, ++all)
      if (basis.error(i) > told_mesh_error) {
        ++coarse;
        lowest = std::min(lowest, basis.omega(i) / (2.0 * std::numbers::pi));
        worst = std::max(worst, basis.error(i));
      }
  if (coarse > 0)
    out.warnings.push_back(
        fmt::format("the mesh is coarse for {} of {} modes, from {:.4g} Hz on: it adds more than 1 % to "
                    "their frequencies, up to "
                    "about {:.2g} % (too few elements a half wave); mesh more finely, or ask for fewer modes",
                    coarse, all, lowest, 100.0 * worst));
}

/// Of ratios given as per cent, most often.
std::string overdamped_note(const std::vector<modal::Basis>& bases) {
  double lowest = std::numeric_limits<double>::infinity(), ratio = 0.0;
  for (const modal::Basis& basis : bases)
    for (Eigen::Index i = 0; i < basis.true_modes(); ++i)
      if (basis.omega(i) > 0.0 && basis.omega(i) < lowest) {
        lowest = basis.omega(i);
        ratio = basis.damping(i);
      }
  return ratio >= 1.0 ? fmt::format("the lowest mode has a damping ratio of {:.3g} and does not oscillate; "
                                    "modes.damping = 0.02 "
                                    "is 2 % of the critical damping",
                                    ratio)
                      : std::string();
}

/// Of structures that nothing but contacts holds; empty where all are held.
std::string free_note(const std::vector<modal::Basis>& bases) {
  std::size_t structures = 0;
  Eigen::Index ways = 0;
  for (const modal::Basis& basis : bases)
    if (const Eigen::Index free = (basis.omega.array() == 0.0).count(); free > 0) {
      ++structures;
      ways += free;
    }
  if (structures == 0)
    return {};
  const std::string what = bases.size() == 1
                               ? "the structure has"
                               : fmt::format("{} of {} structures have", structures, bases.size());
  return fmt::format("{} {} rigid-body mode{} (0 Hz): no restraint or spring holds {}, contacts may", what,
                     ways, ways == 1 ? "" : "s", bases.size() == 1 || structures == 1 ? "it" : "them");
}

/// Of a list of ratios that differ between modes of equal frequency; else empty. Such modes have the directions of modal/canonical.hpp, in which their
/// ratios then differ.
std::string unequal_ratios_warning(const study::Study& study, const std::vector<modal::Basis>& bases) {
  if (study.modes.flow_damping || !std::holds_alternative<std::vector<double>>(study.modes.damping))
    return {};
  std::string first;
  int pairs = 0;
  for (std::size_t s = 0; s < bases.size(); ++s)
    for (Eigen::Index i = 0; i + 1 < bases[s].true_modes(); ++i) {
      const modal::Basis& basis = bases[s];
      const double lambda = basis.omega(i) * basis.omega(i), next = basis.omega(i + 1) * basis.omega(i + 1);
      if (lambda == 0.0 || next - lambda > modal::cluster_gap * next ||
          basis.damping(i) == basis.damping(i + 1) || pairs++ > 0)
        continue;
      first =
          fmt::format("{:g} to mode {} and {:g} to mode {}{}, both at {:.5g} Hz", basis.damping(i), i + 1,
                      basis.damping(i + 1), i + 2, bases.size() > 1 ? fmt::format(" of structure {}", s) : "",
                      basis.omega(i) / (2.0 * std::numbers::pi));
    }
  return pairs == 0
             ? std::string()
             : fmt::format(
                   "modes.damping: the list gives {}{}: modes of equal frequency lie along fixed axes (of a "
                   "straight tube along x along y, then z), and a ratio is that of its direction; look at "
                   "the "
                   "effective masses of the modes, or give them one ratio, or ratios by frequency (table)",
                   first,
                   pairs > 1 ? fmt::format(" (and {} more such pair{})", pairs - 1, pairs > 2 ? "s" : "")
                             : "");
}

} // namespace

void note_modes(const study::Study& study, results::RunResults& out) {
  std::size_t split = 0, short_of = 0;
  for (const auto& basis : out.bases) {
    split += basis.splits_group ? 1 : 0;
    short_of += study.modes.number_given && study.modes.count && basis.size() < *study.modes.count ? 1 : 0;
  }
  if (split > 0)
    out.warnings.push_back(fmt::format("modes.count = {} cuts a group of equal frequencies{}: the two planes "
                                       "of a tube are not treated alike; take "
                                       "one more or one less",
                                       *study.modes.count,
                                       split > 1 ? fmt::format(" of {} structures", split) : ""));
  note_mesh_error(out);
  if (std::string unequal = unequal_ratios_warning(study, out.bases); !unequal.empty())
    out.warnings.push_back(std::move(unequal));
  if (const std::string note = free_note(out.bases); !note.empty())
    out.notes.push_back(note);
  if (const std::string note = overdamped_note(out.bases); !note.empty())
    out.notes.push_back(note);
  if (const auto all = static_cast<std::int64_t>(out.bases.size()); out.model.different_structures < all)
    out.notes.push_back(
        fmt::format("{} structures, {} different ones: the others are copies and take their modes", all,
                    out.model.different_structures));
  if (short_of > 0)
    out.notes.push_back(out.bases.size() == 1
                            ? fmt::format("modes.count = {} is more than the {} that the structure has",
                                          *study.modes.count, out.bases[0].size())
                            : fmt::format("{} of {} structures have fewer modes than modes.count = {}",
                                          short_of, out.bases.size(), *study.modes.count));
}

void note_coincident_nodes(const mesh::LineMesh& mesh, results::RunResults& out) {
  if (!mesh.coincident.empty())
    out.notes.push_back(
        fmt::format("{} of nodes at the same place {} not joined (mesh.merge_tolerance would join them)",
                    mesh.coincident.size() == 1 ? "1 pair" : fmt::format("{} pairs", mesh.coincident.size()),
                    mesh.coincident.size() == 1 ? "is" : "are"));
}

} // namespace fretwork::app
