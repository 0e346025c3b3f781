// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Wear in results.h5: /wear/<support>, attributes for single figures, datasets against time and by sector; read back bit for bit.
#pragma once
#include "results/hdf5.hpp"
#include "results/wear_results.hpp"

namespace fretwork::results {

/// @throws h5::Failure
void write_wear(const h5::Group& root, const Wear& wear);
/// @throws h5::Failure
[[nodiscard]] Wear read_wear(const h5::Group& root);

} // namespace fretwork::results
