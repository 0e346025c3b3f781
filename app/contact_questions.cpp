// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/contact_questions.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <unordered_set>

namespace fretwork::app {
namespace {

/// A support, all points of its thickness together.
struct SupportPlace {
  const PlacedContact* first;
  core::Vec3 middle; ///< m
  double half;       ///< m, of its thickness
};

std::vector<SupportPlace> supports_of(const study::Study& study, const fem::Model& model,
                                      const std::vector<PlacedContact>& placed) {
  std::vector<SupportPlace> out;
  std::unordered_set<std::string> known;
  for (const PlacedContact& contact : placed)
    if (contact.other < 0 && known.insert(contact.support).second)
      out.push_back({&contact, model.nodes[static_cast<std::size_t>(contact.node)],
                     0.5 * study.contacts[contact.entry].thickness});
  return out;
}

/// m, along the tube from one support to the other; infinite where the other is beside it, as on another tube, or at the same node.
double along_tube(const SupportPlace& from, const SupportPlace& to) {
  constexpr double beside = 0.3; // of the way: a bend, or another tube
  const core::Vec3 way = to.middle - from.middle;
  const double along = std::abs(way.dot(from.first->frame.x));
  const bool same_tube = from.first->node != to.first->node && way.norm() <= along * std::hypot(1.0, beside);
  return same_tube ? along : std::numeric_limits<double>::infinity();
}

/// By entries; empty of those without a question.
std::vector<std::string> overlapping_supports(const study::Study& study, const fem::Model& model,
                                              const std::vector<PlacedContact>& placed) {
  constexpr double round_off = 1e-9;
  std::vector<std::string> out(study.contacts.size());
  const std::vector<SupportPlace> supports = supports_of(study, model, placed);
  for (const SupportPlace& one : supports) {
    std::string& question = out[one.first->entry];
    if (one.half == 0.0 || !question.empty())
      continue;
    for (const SupportPlace& other : supports)
      if (const double apart = along_tube(one, other); apart < (one.half + other.half) * (1.0 - round_off)) {
        question = fmt::format(
            "contact \"{}\": a thickness of {:g} m reaches \"{}\", which is {:.4g} m away along the tube{}; "
            "thickness is the length of one support: is it that of a span, or in another unit?",
            one.first->support, 2.0 * one.half, other.first->support, apart,
            other.half > 0.0 ? fmt::format(" and {:g} m thick", 2.0 * other.half) : "");
        break;
      }
  }
  return out;
}

} // namespace

std::vector<std::string> contact_questions(const study::Study& study, const fem::Model& model,
                                           const std::vector<PlacedContact>& placed) {
  constexpr double hardly_meant = 10.0;
  std::vector<std::string> out = overlapping_supports(study, model, placed);
  std::vector<bool> asked(study.contacts.size(), false);
  for (const PlacedContact& contact : placed) {
    const study::Contact& entry = study.contacts[contact.entry];
    const double ratio = entry.tangential_stiffness / contact.normal_stiffness;
    if (asked[contact.entry] || entry.friction_static == 0.0 || !(ratio > hardly_meant))
      continue;
    asked[contact.entry] = true;
    out.push_back(fmt::format("contact \"{}\": its tangential stiffness of {:g} N/m is {:.3g} times the "
                              "normal one, {:g} N/m, and of "
                              "elastic bodies 0.7 to 1 times it: are they exchanged?",
                              entry.name, entry.tangential_stiffness, ratio, contact.normal_stiffness));
  }
  std::erase(out, std::string());
  return out;
}

std::string few_outputs(const study::Study& study) {
  constexpr double fewest = 20.0;
  if (!study.transient || !study.output.every || study.transient->duration / *study.output.every >= fewest)
    return {};
  const double every = *study.output.every, duration = study.transient->duration;
  return fmt::format(
      "output.every = {:g} s keeps {:.0f} output{} of a run of {:g} s: orbits, spectra and pictures need "
      "some "
      "thousand, as the default, {:g} s, keeps; statistics and tables of impacts use every step",
      every, std::floor(duration / every), duration / every < 2.0 ? "" : "s", duration, duration / 5000.0);
}

} // namespace fretwork::app
