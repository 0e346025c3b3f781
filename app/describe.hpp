// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the results say of a run and its model besides its figures.
#pragma once
#include "app/stages.hpp"

namespace fretwork::app {

/// Version, study, seeds, libraries and machine.
[[nodiscard]] results::RunRecord make_record(const Inputs& inputs, int ranks);

/// Nodes, groups, lines, what the beams are made of, and the size of the model.
void describe_model(const mesh::LineMesh& mesh, const fem::Model& model,
                    const std::vector<fem::Structure>& structures, results::RunResults& out);

/// Lines of the warnings that are printed before modes are computed: of values that may be slips, with which that can take long.
[[nodiscard]] std::string early_warnings(const results::RunResults& out);

/// Lines of all warnings and notes as a run tells them, equal ones grouped, for `check`. @param early  the warnings told early have been told
[[nodiscard]] std::string check_messages(const results::RunResults& out, bool early);

} // namespace fretwork::app
