// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// K and M of a structure as 6 x 6 blocks between its nodes: what dense and sparse matrices are filled from.
#pragma once
#include "fem/lumped.hpp"
#include "fem/model.hpp"
#include <vector>

namespace fretwork::fem {

/// Block rows of the node positions [first, first + rows) (positions in structure.nodes).
struct NodeBlocks {
  Index first = 0;
  std::vector<std::size_t> start;       ///< rows + 1: the blocks of row i are start[i] .. start[i + 1]
  std::vector<Index> column;            ///< node position of each block, ascending within a row
  std::vector<Matrix6> stiffness, mass; ///< restrained dofs included
};

/// @param first, last positions in structure.nodes; only elements that touch them are computed
[[nodiscard]] NodeBlocks node_blocks(const Model& model, const Structure& structure, Index first, Index last);

/// True where no node has more than two neighbours: then the elimination of nodes in their order (that of the
/// chain) fills least.
[[nodiscard]] bool is_chain(const Model& model, const Structure& structure);

} // namespace fretwork::fem
