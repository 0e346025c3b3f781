// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Child groups that carry their name and their place among their like: HDF5 lists groups by name, with "/" as a separator.
#pragma once
#include "results/hdf5.hpp"

namespace fretwork::results {

/// @throws h5::Failure
[[nodiscard]] h5::Group create_named(const h5::Group& parent, const std::string& name, std::size_t index);

/// The children in the order in which they were written.
/// @throws h5::Failure
[[nodiscard]] std::vector<h5::Group> in_order(const h5::Group& parent);

} // namespace fretwork::results
