// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How much a run writes, and what of it the study leaves out.
#pragma once
#include "app/build_scene.hpp"
#include "results/run_results.hpp"
#include <mpi.h>

namespace fretwork::app {

/// Bytes of the time series in results.h5 and of the tables of impacts at most, before the run.
struct SizeOfResults {
  double series = 0.0, impacts = 0.0;
  [[nodiscard]] double all() const { return series + impacts; }
};
/// @param outputs  instants   @param rows  of the table of impacts of one contact, at most
[[nodiscard]] SizeOfResults size_of_results(const study::Study& study, const std::vector<BuiltScene>& scenes,
                                            const std::vector<PlacedContact>& placed, double outputs,
                                            const std::vector<double>& rows);

/// 950 kB, 26 MB, 1.04 GB
[[nodiscard]] std::string size_text(double bytes);

/// Collective. How long a run would be and how much it would write, for `check`; warnings of its steps go to `out`.
/// @throws core::Error  what a run would refuse before its first step
[[nodiscard]] std::string forecast_text(MPI_Comm comm, const study::Study& study,
                                        const std::vector<BuiltScene>& scenes,
                                        const std::vector<PlacedContact>& placed, results::RunResults& out);

/// Takes the series that the study does not want (output.modal, series of [[contacts]]) out of the results.
void leave_out_series(const study::Study& study, const std::vector<PlacedContact>& placed,
                      results::RunResults& out);

} // namespace fretwork::app
