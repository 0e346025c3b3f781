// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/facet_cells.hpp"
#include "contact/facet_cells_builder.hpp"

namespace fretwork::contact {

namespace {

constexpr double surround = 1.5; // how far the cells reach, of the outermost vertex

} // namespace

FacetCells::FacetCells(std::span<const FacetPair> pairs, double outermost)
    : per_metre_(1.0 / (surround * outermost)) {
  Builder(pairs, *this).build();
  cells_.shrink_to_fit();
  lists_.shrink_to_fit();
}

} // namespace fretwork::contact
