// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/tapers.hpp"
#include "core/error.hpp"
#include "fem/beam_axis.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace fretwork::app {
namespace {

using core::Index;

/// The curves of one group.
class Curves {
public:
  Curves(const study::Beams& entry, std::string what, const mesh::LineMesh& mesh, fem::Model& model)
      : entry_(entry), what_(std::move(what)), model_(model),
        lines_(mesh::group_lines(mesh, entry.group, what_)),
        starts_(mesh::group_nodes(mesh, entry.taper->from, what_)) {
    for (const Index line : lines_)
      for (const Index node : {beam(line).a, beam(line).b})
        at_[node].push_back(line);
  }

  void place() {
    std::size_t placed = 0;
    for (const Index start : starts_)
      placed += place_from(start);
    if (placed < lines_.size())
      fail(fmt::format(
          "{} of its {} lines are on curves without a node of \"{}\"; each curve of the group needs "
          "one at one of its ends",
          lines_.size() - placed, lines_.size(), entry_.taper->from));
  }

private:
  fem::Beam& beam(Index line) { return model_.beams[static_cast<std::size_t>(line)]; }
  [[nodiscard]] std::string place_of(Index node) const {
    return fem::place(model_.nodes[static_cast<std::size_t>(node)]);
  }
  [[nodiscard]] const std::vector<Index>& lines_at(Index node) const {
    static const std::vector<Index> none;
    const auto found = at_.find(node);
    return found == at_.end() ? none : found->second;
  }
  double length(Index line) {
    const fem::Beam& b = beam(line);
    return fem::BeamAxis(model_.nodes[static_cast<std::size_t>(b.a)],
                         model_.nodes[static_cast<std::size_t>(b.b)], b.middle)
        .length();
  }

  /// @return how many lines the curve has
  std::size_t place_from(Index start) {
    const std::vector<Index> curve = walk(start);
    double whole = 0.0, travelled = 0.0;
    for (const Index line : curve)
      whole += length(line);
    Index node = start;
    for (const Index line : curve) {
      fem::Beam& b = beam(line);
      const double from = travelled / whole;
      travelled += length(line);
      const double to = line == curve.back() ? 1.0 : travelled / whole;
      const bool forward = b.a == node;
      b.along = forward ? std::array{from, to} : std::array{to, from};
      node = forward ? b.b : b.a;
    }
    return curve.size();
  }

  /// The lines from one end to the other.
  std::vector<Index> walk(Index start) {
    if (lines_at(start).size() != 1)
      fail(fmt::format("the node of \"{}\" at {} is no end of its curve; name a physical point at one end",
                       entry_.taper->from, place_of(start)));
    std::vector<Index> curve;
    Index node = start;
    for (const std::vector<Index>* next = &lines_at(start); curve.empty() || next->size() > 1;
         next = &lines_at(node)) {
      if (next->size() > 2)
        fail(fmt::format("it branches at {}; give each branch its own entry", place_of(node)));
      const Index line = curve.empty() || next->front() != curve.back() ? next->front() : next->back();
      curve.push_back(line);
      node = beam(line).a == node ? beam(line).b : beam(line).a;
    }
    if (std::find(starts_.begin(), starts_.end(), node) != starts_.end())
      fail(fmt::format(
          "the curve from {} to {} has nodes of \"{}\" at both ends; name a physical point at one end",
          place_of(start), place_of(node), entry_.taper->from));
    return curve;
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw core::Error(
        fmt::format("{}: what changes along group \"{}\" has no place: {}", what_, entry_.group, problem));
  }

  const study::Beams& entry_;
  std::string what_;
  fem::Model& model_;
  std::vector<Index> lines_, starts_;
  std::map<Index, std::vector<Index>> at_; ///< lines at a node
};

} // namespace

void place_tapers(const study::Study& study, const mesh::LineMesh& mesh, fem::Model& model) {
  for (std::size_t e = 0; e < study.beams.size(); ++e)
    if (study.beams[e].taper)
      Curves(study.beams[e], fmt::format("[[beams]] entry {}", e + 1), mesh, model).place();
}

} // namespace fretwork::app
