// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Ties: chosen components (global axes) of two nodes that stay equal.
///
/// Dofs tied to each other, directly or through others, share one unknown: u = T x with a 1 in each row of a
/// free dof. The structure's equations are T^T K T and T^T M T (rows and columns of tied dofs add up), its
/// loads T^T F, and shapes T x fulfil the ties exactly: no penalty, no multiplier. What is said twice, or closes
/// a ring of ties, changes nothing. A tie of translations between nodes at different places holds the components
/// equal too, so that rotations about the other axes are held with them. A dof tied to a restrained one does not
/// move either: it must be restrained as well.
#pragma once
#include "fem/model.hpp"
#include <Eigen/Core>

namespace fretwork::fem {

/// For each dof (6 * node + d) the first of those it is tied to; itself where it is tied to none before it.
[[nodiscard]] std::vector<Index> first_tied(const Model& model);

/// Restrains what is tied to a restrained dof.
void restrain_tied(Model& model);

/// Of a field (6 values a node) given at some dofs: those tied to one that is given take its value.
/// @param given  by dof, whether it is given; of those that are not the value is not looked at
/// @throws core::Error where two that are given are tied and differ by more than 1e-9 of the larger, naming both nodes
void follow_ties(const Model& model, const std::vector<bool>& given, Eigen::VectorXd& field);

} // namespace fretwork::fem
