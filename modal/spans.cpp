// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/spans.hpp"
#include "core/error.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace fretwork::modal {
namespace {

using core::Index;
using core::Vec3;

/// Cosine between an axis and the tube from which on a translation along the axis is one along the tube (8
/// degrees: it moves the tube across by a seventh).
constexpr double along_the_tube = 0.99;

/// Each node's neighbours, and which of its translations restraints, springs and ties leave.
class Net {
public:
  Net(const fem::Model& model, const fem::Structure& structure)
      : model_(model), structure_(structure), neighbours_(structure.nodes.size()),
        held_(structure.nodes.size()) {
    for (const Index i : structure.beams) {
      const fem::Beam& beam = model.beams[static_cast<std::size_t>(i)];
      const Index a = fem::position_of(structure, beam.a), b = fem::position_of(structure, beam.b);
      neighbours(a).push_back(b);
      neighbours(b).push_back(a);
    }
    for (std::size_t i = 0; i < held_.size(); ++i)
      held_[i] = model.fixed[static_cast<std::size_t>(structure.nodes[i])];
    for (const Index i : structure.springs) {
      const fem::Spring& spring = model.springs[static_cast<std::size_t>(i)];
      for (const Index node : {spring.node, spring.other})
        for (int d = 0; node >= 0 && d < 3; ++d)
          if (spring.stiffness[static_cast<std::size_t>(d)] > 0.0)
            held_[static_cast<std::size_t>(fem::position_of(structure, node))] |=
                static_cast<std::uint8_t>(1 << d);
    }
    for (const Index i : structure.ties) {
      const fem::Tie& tie = model.ties[static_cast<std::size_t>(i)];
      for (const Index node : {tie.node, tie.other})
        held_[static_cast<std::size_t>(fem::position_of(structure, node))] |= tie.dofs;
    }
  }

  [[nodiscard]] const std::vector<Index>& neighbours(Index position) const {
    return neighbours_[static_cast<std::size_t>(position)];
  }

  [[nodiscard]] bool ends_span(Index position) const {
    const std::vector<Index>& beside = neighbours(position);
    if (beside.size() != 2)
      return true;
    const Vec3 tangent = (place(beside[1]) - place(beside[0])).normalized();
    for (int d = 0; d < 3; ++d) {
      const bool held = (held_[static_cast<std::size_t>(position)] >> d) & 1u;
      if (!held && !(std::abs(tangent[d]) > along_the_tube))
        return false;
    }
    return true;
  }

  struct Run {
    int elements;
    double length; ///< m
    Index end;     ///< position
  };

  /// From a node over a neighbour to where the span ends, or once round a ring.
  [[nodiscard]] Run follow(Index from, Index next) const {
    Run run{1, distance(from, next), next};
    for (Index last = from; run.end != from && !ends_span(run.end); ++run.elements) {
      const std::vector<Index>& beside = neighbours(run.end);
      const Index on = beside[0] == last ? beside[1] : beside[0];
      run.length += distance(run.end, on);
      last = run.end;
      run.end = on;
    }
    return run;
  }

private:
  std::vector<Index>& neighbours(Index position) { return neighbours_[static_cast<std::size_t>(position)]; }

  [[nodiscard]] const Vec3& place(Index position) const {
    return model_.nodes[static_cast<std::size_t>(structure_.nodes[static_cast<std::size_t>(position)])];
  }

  [[nodiscard]] double distance(Index a, Index b) const { return (place(b) - place(a)).norm(); }

  const fem::Model& model_;
  const fem::Structure& structure_;
  std::vector<std::vector<Index>> neighbours_;
  std::vector<std::uint8_t> held_; ///< bit d: translation d
};

} // namespace

Span longest_span(const fem::Model& model, const fem::Structure& structure) {
  const Net net(model, structure);
  const auto count = static_cast<Index>(structure.nodes.size());
  Span longest;
  std::vector<bool> ends(structure.nodes.size());
  for (Index i = 0; i < count; ++i)
    ends[static_cast<std::size_t>(i)] = net.ends_span(i);
  if (std::none_of(ends.begin(), ends.end(), [](bool end) { return end; })) // a ring
    return {structure.nodes.front(), static_cast<int>(structure.beams.size())};
  for (Index from = 0; from < count; ++from) {
    if (!ends[static_cast<std::size_t>(from)])
      continue;
    for (const Index next : net.neighbours(from))
      if (const int elements = net.follow(from, next).elements; elements > longest.elements)
        longest = {structure.nodes[static_cast<std::size_t>(from)], elements};
  }
  return longest;
}

std::vector<double> span_lengths(const fem::Model& model, const fem::Structure& structure,
                                 const std::vector<Index>& nodes) {
  const Net net(model, structure);
  std::vector<double> lengths;
  for (const Index node : nodes) {
    const Index at = fem::position_of(structure, node);
    double shortest = 0.0, sum = 0.0;
    for (const Index next : net.neighbours(at)) {
      const Net::Run run = net.follow(at, next);
      shortest = shortest > 0.0 ? std::min(shortest, run.length) : run.length;
      sum += run.end == at ? 0.5 * run.length : run.length; // a ring is met from both sides
    }
    lengths.push_back(net.ends_span(at) ? shortest : sum);
  }
  return lengths;
}

std::vector<std::string> check_spans(const fem::Model& model, const std::vector<fem::Structure>& structures) {
  Span longest;
  for (const fem::Structure& structure : structures)
    if (const Span span = longest_span(model, structure); span.elements > longest.elements)
      longest = span;
  if (longest.elements <= many_elements)
    return {};
  const std::string what =
      fmt::format("the span that starts at {} has {} elements between supports or branches",
                  fem::place(model.nodes[static_cast<std::size_t>(longest.first)]), longest.elements);
  if (longest.elements > too_many_elements)
    throw core::Error(fmt::format("{}: round-off spoils the modes of more than {}; mesh it more coarsely (20 "
                                  "to 50 elements a span give 5 to 8 digits)",
                                  what, too_many_elements));
  return {fmt::format("{}: above {} round-off takes digits from the shapes of modes (2e-18 n^4); 20 to 50 "
                      "elements a span give 5 to 8 digits of the frequencies",
                      what, many_elements)};
}

} // namespace fretwork::modal
