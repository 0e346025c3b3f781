// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Spans: runs of elements that nothing holds across, and what their number of elements means for the digits
/// of modes.
///
/// Round-off of K disturbs the lowest eigenvalue of a span of n elements by about 2e-18 n^4 of itself: 2e-6 at
/// 1000 elements, 2e-4 at 3000. The strain energy regains the digits of the frequency, the shape keeps the
/// error.
#pragma once
#include "fem/model.hpp"
#include <string>
#include <vector>

namespace fretwork::modal {

inline constexpr int many_elements = 1000;     ///< of a span: beyond, shapes have less than 6 digits
inline constexpr int too_many_elements = 3000; ///< beyond, 3 digits at best: refused

struct Span {
  core::Index first = -1; ///< model node where it starts
  int elements = 0;
};

/// The span of most elements. A span ends at a node with other than two neighbours, and where the restraints,
/// springs and ties of a node leave it no translation across the tube.
[[nodiscard]] Span longest_span(const fem::Model& model, const fem::Structure& structure);

/// Length of the span that each node is on, m, along its nodes; where spans end, of the shortest that begins there; 0 where no beam is.
/// @param nodes  of the structure
[[nodiscard]] std::vector<double> span_lengths(const fem::Model& model, const fem::Structure& structure,
                                               const std::vector<core::Index>& nodes);

/// Warnings of the spans of all structures: one, of the longest, where it has more than many_elements.
/// @throws core::Error where one has more than too_many_elements
[[nodiscard]] std::vector<std::string> check_spans(const fem::Model& model,
                                                   const std::vector<fem::Structure>& structures);

} // namespace fretwork::modal
