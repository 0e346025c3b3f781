// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// CSV files of the flow along tubes and of the spectra of a run.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace fretwork::results {

/// The flow at a place of a tube.
struct FlowRow {
  std::string tube, zone;
  double s; ///< m
  double velocity, density, void_fraction,
      inner_density; ///< m/s in the gaps, across the tube; kg/m3; 1; kg/m3
  double mass;       ///< kg/m, of tube and fluids, transverse
};
/// flow.csv: one place a row.
/// @throws core::Error if it cannot be written
void write_flow_csv(const std::filesystem::path& file, const std::vector<FlowRow>& rows);

/// A power spectrum, one-sided in Hz.
struct Spectrum {
  std::string name;                       ///< of the node, the contact or the zone
  std::string quantity;                   ///< "displacement y", "normal force", "force per length"
  std::string unit;                       ///< of the density
  std::vector<double> frequency, density; ///< Hz
  double lower = 1.0,
         upper = 1.0; ///< the true density lies between these times `density`, with 95 %; 1: exact
};
/// spectra.csv: one frequency of one spectrum a row.
/// @throws core::Error if it cannot be written
void write_spectra_csv(const std::filesystem::path& file, const std::vector<Spectrum>& spectra);

} // namespace fretwork::results
