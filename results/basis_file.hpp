// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Parts that results.h5 and modes.h5 have in common.
///     /mesh/nodes [n, 3] m, /mesh/lines [m, 2]
///     /modes (one structure) or /modes/0, /modes/1 ...: frequency [k] Hz, angular_frequency [k] rad/s,
///     damping [k], mass [k] kg,
///         residuals [k], shapes [k, nodes, 6] (ux uy uz rx ry rz), nodes [nodes], damping_matrix [k, k] 1/s
///         where it is not diagonal; attributes orthogonality, complete (there are no more), distributed, static_modes (so many
///         last ones)
#pragma once
#include "results/hdf5.hpp"
#include "results/run_results.hpp"

namespace fretwork::results {

/// Rows one after the other in memory, as HDF5 has them.
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

void write_vector(const h5::Group& group, const std::string& name, const Eigen::VectorXd& values,
                  const std::string& units);
void write_matrix(const h5::Group& group, const std::string& name, const Eigen::MatrixXd& values,
                  const std::string& units);
/// @throws h5::Failure if the dataset is missing or is not of this kind
[[nodiscard]] Eigen::VectorXd read_vector(const h5::Group& group, const std::string& name);
[[nodiscard]] Eigen::MatrixXd read_matrix(const h5::Group& group, const std::string& name);

/// Whether all are numbers of one of `count` things.
[[nodiscard]] bool all_below(std::span<const core::Index> numbers, std::size_t count);

void write_mesh(const h5::Group& root, const std::vector<core::Vec3>& nodes,
                const std::vector<std::array<core::Index, 2>>& lines);
/// Nothing where the file has no mesh.
/// @throws h5::Failure if sizes do not fit together, or a line has a node that is not there
void read_mesh(const h5::Group& root, std::vector<core::Vec3>& nodes,
               std::vector<std::array<core::Index, 2>>& lines);

void write_modes(const h5::Group& root, const std::vector<modal::Basis>& bases);
/// @throws h5::Failure if something is missing or sizes do not fit together
[[nodiscard]] std::vector<modal::Basis> read_modes(const h5::Group& root);

/// Version, title, study, input_sha256, seeds and libraries. Not the number of ranks nor the processor, which
/// change no result.
void write_record(const h5::Group& root, const RunRecord& record);
[[nodiscard]] RunRecord read_record(const h5::Group& root);

} // namespace fretwork::results
